// The exact test of one triangle: nearest hits win, equal distances go to the lower number, so that the order of tests
// has no say. Backs of single-sided materials and holes are passed through.
//
// It comes in two parts. Software rasterizers run the body of every `if` under a mask, so what few candidates need
// (exact products, materials, textures) costs all of them; a search asks mayHit() in its inner loop and testCandidate()
// behind it.
#include "lib/alpha.glsl"
#include "lib/scene.glsl"
#include "lib/triangles.glsl"
#include "shared/rays.h"
#include "shared/structs.h"
#include "tracing/common/ray_triangle.glsl"
#include "tracing/common/walk.glsl"

EdgeTest testEdges(TraceRay ray, uint triangle) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  return testEdges(ray.shear, ray.origin, a, b, c);
}

// Whether testCandidate() may find a hit no farther than `nearest`: true for all that do, and for few that do not.
bool mayHit(TraceRay ray, uint triangle, float nearest) {
  EdgeTest test = testEdges(ray, triangle);
  float t = distanceOf(test, ray.shear, determinantOf(test));
  bool met = inside(test) && t >= ray.least && t <= nearest;
  return (met || onEdge(test)) && triangle != ray.excluded;
}

// Whether the hit is near and the ray starts in the triangle's plane, as far as floats can tell. A point on an edge lies
// in both of its triangles, and seen at a slant the rounding of the one that is not excluded is a hit at some distance.
bool startsInPlane(TraceRay ray, uint triangle, float t) {
  if (t > 128.0 * max(NEAREST_SHARE * frame.diagonal, frame.minDistance)) return false;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 normal = cross(normalize(b - a), normalize(c - a));
  // What rounding of the coordinates is worth along the normal, and along the ray.
  vec3 size = max(max(abs(a), abs(b)), max(abs(c), abs(ray.origin)));
  float off = max(NEAREST_SHARE * dot(abs(normal), size), ray.least * length(normal));
  float reach = max(distance(a, ray.origin), max(distance(b, ray.origin), distance(c, ray.origin)));
  return t <= 64.0 * max(NEAREST_SHARE * reach, ray.least) && abs(dot(normal, a - ray.origin)) <= off;
}

void testCandidate(TraceRay ray, uint triangle, inout Hit best) {
  EdgeTest test = testEdges(ray, triangle);
  if (onEdge(test)) decideEdges(test);
  float determinant = determinantOf(test);
  float t = distanceOf(test, ray.shear, determinant);
  bool nearer = t >= ray.least && (t < best.t || (t == best.t && triangle < best.triangle));
  if (!inside(test) || determinant == 0.0 || !nearer || triangle == ray.excluded) return;
  if (startsInPlane(ray, triangle, t)) return;
  uint material = triangleAt(triangle).w;
  if (determinant < 0.0 && !doubleSided(material)) return;
  vec2 barycentrics = test.edges.yz / determinant;
  if ((materials[material].flags & MATERIAL_CUT) != 0u && cutAway(triangle, barycentrics)) return;
  best = Hit(t, triangle, barycentrics.x, barycentrics.y);
}
