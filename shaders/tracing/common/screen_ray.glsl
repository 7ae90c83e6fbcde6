// A ray's way over the screen, exact in perspective, and the depth pyramid that it goes by.
#include "lib/frame.glsl"
#include "shared/passes/screen.h"
#include "shared/rays.h"
#include "tracing/common/walk.glsl"

layout(binding = UNIT_SCREEN_DEPTHS) uniform sampler2D screenDepths;

// A ray in clip space and its depth along the view axis, both linear in t.
struct ScreenRay {
  vec4 start;
  vec4 step;
  float depth;
  float depthStep;
  ivec2 way;  // -1, 0 or 1: it keeps to it all the time
};

ScreenRay onScreen(TraceRay ray) {
  ScreenRay s;
  s.start = frame.viewProjection * vec4(ray.origin, 1.0);
  s.step = frame.viewProjection * vec4(ray.direction, 0.0);
  s.depth = dot(ray.origin - frame.eye, frame.forward);
  s.depthStep = dot(ray.direction, frame.forward);
  s.way = ivec2(sign(s.step.xy * s.start.w - s.start.xy * s.step.w));
  return s;
}

// Cuts the range to where start + t * step is at least 0.
void cutRange(float start, float step, inout vec2 range) {
  float t = -start / step;
  if (step > 0.0) range.x = max(range.x, t);
  if (step < 0.0) range.y = min(range.y, t);
  if (step == 0.0 && start < 0.0) range.y = -1.0;
}

// The part of the range that the camera sees.
vec2 seenRange(ScreenRay s, vec2 range) {
  cutRange(s.start.w - s.start.x, s.step.w - s.step.x, range);
  cutRange(s.start.w + s.start.x, s.step.w + s.step.x, range);
  cutRange(s.start.w - s.start.y, s.step.w - s.step.y, range);
  cutRange(s.start.w + s.start.y, s.step.w + s.step.y, range);
  cutRange(s.depth - frame.drawnNear, s.depthStep, range);
  return range;
}

ivec2 pixelAt(ScreenRay s, float t) {
  vec4 place = s.start + t * s.step;
  return ivec2(floor((0.5 * place.xy / place.w + 0.5) * vec2(frame.width, frame.height)));
}

// Where the ray leaves the columns or rows from `low` on, `size` of them. Those around its vanishing point it never
// does.
float leaves(float start, float step, float w, float wStep, int low, int size, int way, uint across) {
  float edge = 2.0 * float(way > 0 ? low + size : low) / float(across) - 1.0;
  float approach = step - edge * wStep;
  return approach * float(way) > 0.0 ? (edge * w - start) / approach : farAway;
}
