// Fragments of a texel, which of them a ray may hit, and which texel a point of a ray lies in.
#include "lib/scene.glsl"
#include "lib/triangles.glsl"
#include "tracing/attributes/entry.glsl"
#include "tracing/attributes/page_cursor.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/walk.glsl"

const uint noFragment = 0xffffffffu;

struct Slab {
  int axis;
  vec2 depths;  // fragments outside are not of this voxel
};

ivec2 texelAt(TraceRay ray, int axis, float t) {
  vec2 p = permute(ray.gridOrigin + ray.gridDirection * t, axis).xy;
  return clamp(ivec2(floor(p * float(bufferResolution))), ivec2(0), ivec2(bufferResolution - 1));
}

uint triangleOf(uint fragment) { return uint(imageLoad(pool, int(fragment) * ENTRY_TEXELS + 1).w); }

vec3 normalOf(uint fragment) {
  return unpackNormalReflectivity(imageLoad(pool, int(fragment) * ENTRY_TEXELS + 1)).xyz;
}
