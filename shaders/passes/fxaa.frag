// Smooths edges of the tone-mapped picture: where brightness jumps, a pixel takes a share of the neighbor across the edge
// that depends on how near the ends of the edge's step are, so that stairs become ramps (the idea: Lottes 2009, "FXAA").
#include "lib/display.glsl"
#include "lib/target.glsl"
#include "shared/passes/display.h"

layout(binding = UNIT_PICTURE) uniform sampler2D picture;  // display values, filtered linearly

const float RELATIVE_CONTRAST = 0.125;  // smaller ones are no edges
const float LEAST_CONTRAST = 0.03;
const int REACH = 12;               // pixels along an edge, each way
const float SAME_STEP = 0.25;       // of the contrast: a larger change along the edge ends its step
const float SPECK_SHARE = 0.6;      // how much single pixels are softened

float brightness(vec3 display) { return dot(display, vec3(0.299, 0.587, 0.114)); }

float brightnessAt(vec2 at) { return brightness(textureLod(picture, at / vec2(frame.width, frame.height), 0.0).rgb); }

void main() {
  ivec2 pixel = targetPixel();
  vec2 center = vec2(pixel) + 0.5;
  vec3 own = texelFetch(picture, pixel, 0).rgb;
  float m = brightness(own);
  float n = brightnessAt(center + vec2(0, 1)), s = brightnessAt(center - vec2(0, 1));
  float e = brightnessAt(center + vec2(1, 0)), w = brightnessAt(center - vec2(1, 0));
  float high = max(max(max(n, s), max(e, w)), m), low = min(min(min(n, s), min(e, w)), m);
  float contrast = high - low;
  if (contrast < max(LEAST_CONTRAST, RELATIVE_CONTRAST * high)) {
    color = vec4(dithered(own, pixel), 1.0);
    return;
  }
  float ne = brightnessAt(center + vec2(1, 1)), nw = brightnessAt(center + vec2(-1, 1));
  float se = brightnessAt(center + vec2(1, -1)), sw = brightnessAt(center - vec2(1, 1));

  // Single pixels that differ from all around them.
  float around = (2.0 * (n + s + e + w) + ne + nw + se + sw) / 12.0;
  float speck = smoothstep(0.0, 1.0, clamp(abs(around - m) / contrast, 0.0, 1.0));
  float share = SPECK_SHARE * speck * speck;

  // Second differences across rows and across columns: the larger says which way the edge runs.
  float rows = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
  float columns = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
  bool horizontal = rows >= columns;
  vec2 along = horizontal ? vec2(1, 0) : vec2(0, 1), across = horizontal ? vec2(0, 1) : vec2(1, 0);
  float above = horizontal ? n : e, below = horizontal ? s : w;
  bool upper = abs(above - m) >= abs(below - m);
  vec2 towards = upper ? across : -across;
  float other = upper ? above : below;

  // Along the line between the two rows, both ways, to where their mean no longer is this edge's.
  float mean = 0.5 * (m + other), limit = SAME_STEP * abs(other - m);
  vec2 line = center + 0.5 * towards;
  vec2 reached = vec2(0.0), ends = vec2(0.0);
  for (int way = 0; way < 2; ++way) {
    vec2 stride = way == 0 ? along : -along;
    int steps = 0;
    float change = 0.0;
    do {
      ++steps;
      change = brightnessAt(line + float(steps) * stride) - mean;
    } while (abs(change) < limit && steps < REACH);
    reached[way] = float(steps);
    ends[way] = change;
  }
  bool nearerFirst = reached.x <= reached.y;
  float nearest = nearerFirst ? reached.x : reached.y, end = nearerFirst ? ends.x : ends.y;
  // The step bends over this pixel only if its nearer end turns to the other side's brightness.
  if (nearest < float(REACH) && (end < 0.0) != (m < mean))
    share = max(share, 0.5 - nearest / (reached.x + reached.y));
  vec3 blended = textureLod(picture, (center + share * towards) / vec2(frame.width, frame.height), 0.0).rgb;
  color = vec4(dithered(blended, pixel), 1.0);
}
