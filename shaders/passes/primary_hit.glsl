// Which triangle the ray of a pixel meets, by tests of those that rasterization found there and around (Robert et al.
// 2007, sections 2.1 and 3.1). With TEST_HITS they are tested at all, with LAZY or FULL those of the neighborhood, too.
#include "lib/alpha.glsl"
#include "lib/triangle_point.glsl"
#include "shared/passes/gbuffer.h"

layout(binding = UNIT_VISIBILITY) uniform usampler2D visibility;
layout(r32ui, binding = IMAGE_TESTED) uniform writeonly uimage2D testedImage;
layout(std430, binding = SSBO_PRIMARY_COUNTS) buffer PrimaryCountBlock { uint primaryCounts[2]; };

uniform int reach;   // pixels from the middle of the neighborhood
uniform uint every;  // one pixel in so many has a ray

// Number + 1 of the triangle, or 0; `known`: that is what the ray meets.
struct PrimaryHit {
  uint visible;
  bool known;
};

#ifdef TEST_HITS
// Whether the pixel's ray passes through the triangle (Moller & Trumbore 1997), and how far along the view axis.
bool meets(uint triangle, ivec2 pixel, out float depth) {
  vec3 a, b, c, origin = pixelOrigin(pixel), ray = pixelRay(pixel);
  trianglePositions(triangle, a, b, c);
  vec3 edge1 = b - a, edge2 = c - a;
  vec2 uv = solveBarycentrics(a - origin, edge1, edge2, ray);
  depth = dot(a - origin + uv.x * edge1 + uv.y * edge2, frame.forward);
  return uv.x >= 0.0 && uv.y >= 0.0 && uv.x + uv.y <= 1.0 && depth > 0.0 && !cutAway(triangle, uv);
}

// Of the neighborhood's triangles the nearest that the ray passes through, the lowest number of equal ones.
uint nearestAround(ivec2 pixel) {
  uint found = 0u;
  float nearest = 0.0, depth;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(frame.width, frame.height) - 1);
      uint candidate = texelFetch(visibility, other, 0).x;
      if (candidate == 0u || candidate == found || !meets(candidate - 1u, pixel, depth)) continue;
      if (found != 0u && (depth > nearest || depth == nearest && candidate > found)) continue;
      found = candidate;
      nearest = depth;
    }
  return found;
}

PrimaryHit testedHit(ivec2 pixel, uint own) {
  float depth;
#ifdef FULL
  uint found = nearestAround(pixel);
#else
  uint found = own != 0u && meets(own - 1u, pixel, depth) ? own : 0u;
#endif
#ifdef LAZY
  if (own != 0u && found == 0u) found = nearestAround(pixel);
#endif
  if (found != own && found != 0u) atomicAdd(primaryCounts[0], 1u);
  return PrimaryHit(found, found != 0u || own == 0u);
}
#endif

// Stores the number.
PrimaryHit primaryHit(ivec2 pixel) {
  PrimaryHit hit = PrimaryHit(texelFetch(visibility, pixel, 0).x, true);
#ifdef TEST_HITS
  hit = testedHit(pixel, hit.visible);
#endif
  // Slanted rows, so that each pixel that is left out has rays beside it.
  if ((uint(pixel.x) + (every + 1u) / 2u * uint(pixel.y)) % every != 0u) hit = PrimaryHit(0u, false);
  if (!hit.known) atomicAdd(primaryCounts[1], 1u);
  imageStore(testedImage, pixel, uvec4(hit.visible));
  return hit;
}
