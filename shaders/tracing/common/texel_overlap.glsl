// The test of conservative rasterization: does the triangle touch the texel, and over which depths.
#include "tracing/common/grid.glsl"

// The square is grown a little, so that a ray that rounds into the neighboring texel still finds the triangle.
const float overlapSlack = 0.01;  // texels
// More than a texel coordinate can be off by rounding.
const float coordinateError = 1e-4;  // texels

bool separated(vec2 normal, vec2 onEdge, vec2 opposite, float reach) {
  precise float p = dot(normal, onEdge), q = dot(normal, opposite);
  precise float r = reach * (abs(normal.x) + abs(normal.y));
  return min(p, q) > r || max(p, q) < -r;
}

// `a`, `b`, `c`: grid space with depth last; `texel` of a raster of `resolution` texels. On true `depths` is the range
// of depth (grid units) that the triangle's plane spans over the texel, clipped to the triangle's own range.
bool touchesTexel(vec3 a, vec3 b, vec3 c, ivec2 texel, vec2 resolution, out vec2 depths) {
  vec2 center = vec2(texel) + 0.5;
  precise vec2 pa = a.xy * resolution - center, pb = b.xy * resolution - center, pc = c.xy * resolution - center;
  float reach = 0.5 + overlapSlack;
  vec2 low = min(pa, min(pb, pc)), high = max(pa, max(pb, pc));
  depths = vec2(min(a.z, min(b.z, c.z)), max(a.z, max(b.z, c.z)));
  if (any(greaterThan(low, vec2(reach))) || any(lessThan(high, vec2(-reach)))) return false;

  // Separating axes: the normals of the edges. Two-sided, so that slivers need no orientation.
  precise vec2 e0 = pb - pa, e1 = pc - pb, e2 = pa - pc;
  if (separated(vec2(-e0.y, e0.x), pa, pc, reach)) return false;
  if (separated(vec2(-e1.y, e1.x), pb, pa, reach)) return false;
  if (separated(vec2(-e2.y, e2.x), pc, pb, reach)) return false;

  // The plane's depth over the square, with room for its rounding; a sliver keeps the triangle's whole range.
  precise float area = abs(e0.x * e2.y - e0.y * e2.x);
  if (area > 0.0) {
    precise float size = dot(e0, e0) + dot(e1, e1) + dot(e2, e2);
    float z1 = b.z - a.z, z2 = c.z - a.z;
    vec2 q1 = e0, q2 = -e2;
    precise vec2 slope = vec2(z1 * q2.y - z2 * q1.y, z2 * q1.x - z1 * q2.x) / (q1.x * q2.y - q1.y * q2.x);
    precise float middle = a.z - dot(slope, pa);
    precise float error = (abs(z1) + abs(z2)) * (1e-6 * size + 2.0 * coordinateError * sqrt(size)) / area;
    precise float spread = reach * (abs(slope.x) + abs(slope.y)) + error;
    if (spread < depths.y - depths.x) depths = clamp(vec2(middle - spread, middle + spread), depths.x, depths.y);
  }
  return true;
}
