// Rays behind the clear surfaces of a band of the screen, one from each pixel. What they bring is added to the shaded
// pixels, of which the blend leaves what is not reflected.
#include "effects/common/meeting.glsl"
#include "lib/coat.glsl"
#include "lib/gbuffer.glsl"
#include "shared/passes/shade_hits.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = SSBO_NEXT_RAYS) writeonly buffer NextRayBlock { Ray nextRays[]; };
layout(std430, binding = SSBO_NEXT_PATHS) writeonly buffer NextPathBlock { RayPath nextPaths[]; };
layout(std430, binding = SSBO_NEXT_COUNT) buffer NextCountBlock { RayCount nextCount; };

uniform int firstRow;  // of the band
uniform int rows;

// Of the surface that a pixel shows.
Meeting meetingAt(ivec2 pixel, uint triangle) {
  TrianglePoint point = pointOnTriangle(triangle, pixelOrigin(pixel), pixelRay(pixel));
  Meeting m;
  m.distance = m.pathLength = length(point.relative);
  m.direction = normalize(point.relative);
  m.triangle = triangle;
  m.s = evaluateSurface(triangle, point.barycentrics, m.direction, coneWidth(m.distance), ALL_TEXTURES);
  m.s.position = point.position;
  setMedia(m, 0u);
  m.throughput = throughMedium(m.before, m.distance);
  return m;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow);
  if (pixel.x >= int(frame.width) || pixel.y >= firstRow + rows) return;
  uint visible = texelFetch(gVisibility, pixel, 0).x, triangle = visible - 1u;
  if (visible == 0u) return;
  if ((materials[triangleAt(triangle).w].flags & MATERIAL_TRANSMISSIVE) == 0u) return;

  Meeting m = meetingAt(pixel, triangle);
  float ratio = indexRatio(m, 1);
  Interface border = meetInterface(m.direction, m.s.normal, ratio);
  vec3 direction = directionBehind(m, border, ratio);
  vec3 passing = takeClear(m.s, m.direction, ratio, frame.glossySamples != 0u);
  float cosine = -dot(m.s.normal, m.direction);
  vec3 left = 1.0 - reflectionShare(m.s.f0, m.s.roughness, cosine);  // by the blend
#ifdef COATS
  if (underCoat(m)) {
    passing *= 1.0 - filmReflectance(m.s.coat, -dot(m.s.coatNormal, m.direction));
    left = vec3(1.0);
  }
#endif
  if (all(lessThanEqual(passing, vec3(0.0)))) return;

  uint index = atomicAdd(nextCount.count, 1u), slot = index * max(frame.glossySamples, 1u);
  atomicAdd(nextCount.byKind[RAY_REFRACTION], 1u);
  nextRays[index] = Ray(m.s.position, FAR_AWAY, direction, triangle);
  nextPaths[index] = RayPath(m.throughput * passing / max(left, vec3(1e-6)), m.pathLength,
                             uint(pixel.y) * frame.width + uint(pixel.x), RAY_REFRACTION | COUNTED_CLEAR, slot, m.behind);
}
