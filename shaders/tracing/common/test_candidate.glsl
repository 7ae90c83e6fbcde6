// The exact test of one triangle: nearest hits win, equal distances go to the lower number, so that the order of tests
// has no say. Backs of single-sided materials and holes are passed through.
#include "lib/alpha.glsl"
#include "lib/scene.glsl"
#include "lib/triangles.glsl"
#include "lib/when.glsl"
#include "shared/rays.h"
#include "shared/structs.h"
#include "tracing/common/ray_triangle.glsl"
#include "tracing/common/walk.glsl"

void testCandidate(TraceRay ray, uint triangle, inout Hit best) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 tuv;
  bool back;
  bool met = intersectTriangle(ray.shear, ray.origin, a, b, c, tuv, back);
  bool nearer = tuv.x >= ray.least && (tuv.x < best.t || (tuv.x == best.t && triangle < best.triangle));
  when (met && nearer && triangle != ray.excluded) {
    uint material = triangleAt(triangle).w;
    bool visible = !back || doubleSided(material);
    when (visible && (materials[material].flags & MATERIAL_CUT) != 0u) visible = !cutAway(triangle, tuv.yz);
    if (visible) best = Hit(tuv.x, triangle, tuv.y, tuv.z);
  }
}
