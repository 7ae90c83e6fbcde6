// Rays of what is too rough to be traced as a whole: each such pixel of a band sends frame.glossySamples of them, which
// the screen answers. Those of a pixel lie side by side.
#include "effects/reflection/lobe.glsl"
#include "lib/blend.glsl"
#include "lib/display.glsl"
#include "lib/random.glsl"
#include "lib/surface_point.glsl"
#include "shared/passes/look.h"
#include "shared/passes/screen.h"
#include "shared/rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = SSBO_NEXT_RAYS) writeonly buffer NextRayBlock { Ray nextRays[]; };
layout(std430, binding = SSBO_NEXT_PATHS) writeonly buffer NextPathBlock { RayPath nextPaths[]; };
layout(std430, binding = SSBO_NEXT_COUNT) buffer NextCountBlock { RayCount nextCount; };

uniform int firstRow;  // of the band
uniform int rows;

// Whether something as bright as white adds more to the display than what select.min_contribution leaves out.
bool isWorthIt(ivec2 pixel, vec4 normal, vec3 share) {
  if (all(lessThanEqual(share, vec3(0.0)))) return false;
  if (frame.minContribution <= 0.0) return true;
  vec3 base = blendOf(pixel, normal).base;
  vec3 added = displayed(base + share / frame.exposure) - displayed(base);
  return max(max(added.r, added.g), added.b) > frame.minContribution;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow);
  if (pixel.x >= int(frame.width) || pixel.y >= firstRow + rows) return;
  vec4 normal = facingAt(pixel);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  if (!isSurface(normal) || material.a < 0.0 || goesOn(normal)) return;
  vec3 position = surfacePoint(pixel).xyz, fromEye = fromCamera(position), toEye = -normalize(fromEye);
  Mirror mirror = mirrorOf(pixel, material, normal.xyz, toEye);
  if (!isWorthIt(pixel, normal, mirror.reflectance * (1.0 - roughnessFade(material.a)))) return;
  Lobe lobe = lobeOf(mirror.f0, material.a, normal.xyz, toEye);

  uint first = atomicAdd(nextCount.count, frame.glossySamples);
  atomicAdd(nextCount.byKind[COUNT_ANSWERED_FIRST], frame.glossySamples);
  uint number = uint(pixel.y) * frame.width + uint(pixel.x), triangle = texelFetch(gVisibility, pixel, 0).x - 1u;
  for (uint i = 0u; i < frame.glossySamples; ++i) {
    vec3 direction;
    vec3 weight = sampleLobe(lobe, sample2(number, frame.firstPass * frame.glossySamples + i, 1u), direction);
    nextRays[first + i] = Ray(position, FAR_AWAY, direction, triangle);
    nextPaths[first + i] = RayPath(weight, length(fromEye), number, RAY_REFLECTION | COUNTED_REFLECTION, first + i, 0u);
  }
}
