// Search of the cubemap method: no search at all. A ray sees what the cube shows in the direction of the point where the
// ray leaves the scene's bounds, as if all lay on that box. Its hit is the point that the texel shows, wherever that
// lies beside the ray.
#include "lib/frame.glsl"
#include "lib/triangle_point.glsl"
#include "shared/rays.h"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"
#include "tracing/cubemap/faces.glsl"

layout(binding = UNIT_CAPTURE) uniform usampler2DArray cube;

bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  countStep();
  vec3 way = ray.origin + gridRange(ray).y * ray.direction - probe.xyz;
  int face = faceOf(way), resolution = textureSize(cube, 0).x;
  vec3 p = toFace(way, face);
  ivec2 texel = clamp(ivec2(floor((0.5 * p.xy / p.z + 0.5) * float(resolution))), ivec2(0), ivec2(resolution - 1));
  uint seen = texelFetch(cube, ivec3(texel, face), 0).x;
  if (seen == 0u || seen - 1u == ray.excluded) return true;
  TrianglePoint point = pointOnTriangle(seen - 1u, probe.xyz, texelWay(texel, face, resolution));
  best = Hit(distance(point.position, ray.origin), seen - 1u, point.barycentrics.x, point.barycentrics.y);
  return true;
}

void storeSurface(uint index, Hit hit) {}
