// Small triangles need no rasterizer: one invocation goes over the texels of a triangle's box, with the test of the
// fragments, and so visits the same voxels. The rasterizer's setup costs many times that.
#include "shared/passes/listed_triangles.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/texel_overlap.glsl"

struct TexelBox {
  ivec2 low, size;
};

// Texels that a triangle may touch, those included that touchesTexel() grows it into.
TexelBox texelBox(ProjectedTriangle t) {
  ivec2 texels = permutedVoxels(t.axis).xy;
  float reach = overlapSlack + coordinateError;
  precise vec2 low = min(t.a.xy, min(t.b.xy, t.c.xy)) * vec2(texels) - reach;
  precise vec2 high = max(t.a.xy, max(t.b.xy, t.c.xy)) * vec2(texels) + reach;
  ivec2 first = clamp(ivec2(floor(low)), ivec2(0), texels - 1);
  ivec2 last = clamp(ivec2(floor(high)), ivec2(0), texels - 1);
  return TexelBox(first, last - first + 1);
}

// In all of its projections. `a`, `b`, `c` in world space.
bool isSmall(vec3 a, vec3 b, vec3 c) {
  bool small = true;
  for (int i = 0; i < projectionCount(); ++i) {
    ProjectedTriangle t = projectTriangle(a, b, c, i);
    ivec2 size = texelBox(t).size;
    float depths = (max(t.a.z, max(t.b.z, t.c.z)) - min(t.a.z, min(t.b.z, t.c.z))) * float(permutedVoxels(t.axis).z);
    small = small && size.x * size.y <= SMALL_TEXELS && depths <= float(SMALL_DEPTHS);
  }
  return small;
}
