// The pyramid of nearest depths, a level per dispatch. Level 0 takes the least of a pixel and its neighbors, since a
// surface is nearer at a pixel's edge than at its center. Nothing is as far as can be.
#include "lib/gbuffer.glsl"
#include "shared/passes/screen.h"
#include "shared/rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_SCREEN_DEPTHS) uniform sampler2D depths;
layout(binding = IMAGE_SCREEN_DEPTHS, r32f) uniform writeonly image2D level;

uniform int number;  // of the level

float depthOf(ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return FAR_AWAY;
  float depth = texelFetch(gPosition, pixel, 0).w;
  return depth > 0.0 ? depth : FAR_AWAY;
}

void main() {
  ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(cell, imageSize(level)))) return;
  float least = FAR_AWAY;
  if (number == 0) {
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) least = min(least, depthOf(cell + ivec2(x, y)));
  } else {
    for (int i = 0; i < 4; ++i)
      least = min(least, texelFetch(depths, 2 * cell + ivec2(i & 1, i >> 1), number - 1).r);
  }
  imageStore(level, cell, vec4(least));
}
