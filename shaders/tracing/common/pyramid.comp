// The pyramid of nearest depths, a level per dispatch. Level 0 takes the least of a pixel and its neighbors, since a
// surface is nearer at a pixel's edge than at its center. Nothing is as far as can be.
//
// Where the camera looks through the back of a single-sided material, something that rays may hit lies before what is
// seen. If such backs count, level 0 has its depth, negative if one of the nine pixels is such a place.
#include "lib/surface_point.glsl"
#include "shared/passes/screen.h"
#include "shared/rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_SCREEN_DEPTHS) uniform sampler2D depths;
layout(binding = UNIT_BACK_DEPTHS) uniform sampler2D backDepths;  // as GBuffer::depth, of all surfaces
layout(binding = IMAGE_SCREEN_DEPTHS, r32f) uniform writeonly image2D level;

uniform int number;  // of the level
uniform int backsCount;

// More than rounding.
const float BEFORE = 0.999;

// The pixels of a group and their neighbors.
const int TILE = 8 + 2;
shared float tile[TILE * TILE];

float depthOf(ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return FAR_AWAY;
  if (isInterpolated(pixel)) return 0.0;  // a surface that nobody knows: nothing is certain
  float depth = surfacePoint(pixel).w;
  if (depth <= 0.0) depth = FAR_AWAY;
  if (backsCount == 0) return depth;
  float nearest = metersOf(texelFetch(backDepths, pixel, 0).r);
  return nearest < BEFORE * depth ? -nearest : depth;
}

void main() {
  ivec2 cell = ivec2(gl_GlobalInvocationID.xy), place = ivec2(gl_LocalInvocationID.xy);
  if (number == 0) {
    ivec2 corner = cell - place - 1;
    for (int i = int(gl_LocalInvocationIndex); i < TILE * TILE; i += 64)
      tile[i] = depthOf(corner + ivec2(i % TILE, i / TILE));
  }
  barrier();
  if (any(greaterThanEqual(cell, imageSize(level)))) return;
  float least = FAR_AWAY, sign = 1.0;
  if (number == 0) {
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        float depth = tile[(place.y + y) * TILE + place.x + x];
        least = min(least, abs(depth));
        if (depth < 0.0) sign = -1.0;
      }
  } else {
    for (int i = 0; i < 4; ++i)
      least = min(least, abs(texelFetch(depths, 2 * cell + ivec2(i & 1, i >> 1), number - 1).r));
  }
  imageStore(level, cell, vec4(sign * least));
}
