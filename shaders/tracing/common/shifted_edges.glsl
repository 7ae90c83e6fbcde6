// Conservative rasterization by shifted edges (Hasselgren et al. 2005, the second of its algorithms; Kastrati & Goswami
// 2017, section 3.1.1): each edge moves outwards until it has passed half a texel, and the triangle between the moved
// edges is drawn. At acute corners that reaches far beyond the triangle, so fragments outside its box, grown by half a
// texel, are dropped. What is left are the texels that the projection touches. A fragment has one depth, that of the
// triangle's plane in the texel's center, so a steep triangle may miss a voxel that it touches.
#include "tracing/common/projections.glsl"

// The line through two points of a counterclockwise outline, moved outwards: dot(line.xy, p) + line.z = 0.
vec3 shiftedLine(vec2 from, vec2 to) {
  vec2 inwards = vec2(from.y - to.y, to.x - from.x);
  return vec3(inwards, 0.5 * (abs(inwards.x) + abs(inwards.y)) - dot(inwards, from));
}

// In clip space. Where two lines are nearly parallel w is nearly 0, which the clipper takes care of. A triangle that is
// seen edge-on covers nothing.
vec4 shiftedCorner(ProjectedTriangle t, int corner, float resolution) {
  // Relative to the first corner, so that large coordinates cost no precision.
  vec2 a = t.a.xy * resolution;
  vec2 p[3] = vec2[3](vec2(0.0), t.b.xy * resolution - a, t.c.xy * resolution - a);
  float area = p[1].x * p[2].y - p[1].y * p[2].x;
  if (area == 0.0) return vec4(0.0, 0.0, 0.0, 1.0);
  if (area < 0.0) {
    vec2 other = p[1];
    p[1] = p[2];
    p[2] = other;
  }
  int before = (corner + 2) % 3, behind = (corner + 1) % 3;
  vec3 meeting = cross(shiftedLine(p[before], p[corner]), shiftedLine(p[corner], p[behind]));
  return vec4((meeting.xy + a * meeting.z) * 2.0 / resolution - meeting.z, 0.0, meeting.z);
}

bool inGrownBox(ProjectedTriangle t, ivec2 texel, float resolution) {
  vec2 low = min(t.a.xy, min(t.b.xy, t.c.xy)) * resolution, high = max(t.a.xy, max(t.b.xy, t.c.xy)) * resolution;
  vec2 center = vec2(texel) + 0.5;
  return all(greaterThanEqual(center, low - 0.5)) && all(lessThanEqual(center, high + 0.5));
}

// Of the triangle's plane, not interpolated: the drawn triangle's corners may be far away.
float depthInTexel(ProjectedTriangle t, ivec2 texel, float resolution) {
  vec3 ab = t.b - t.a, ac = t.c - t.a;
  vec2 at = (vec2(texel) + 0.5) / resolution - t.a.xy;
  float area = ab.x * ac.y - ab.y * ac.x;
  float v = (at.x * ac.y - at.y * ac.x) / area, w = (ab.x * at.y - ab.y * at.x) / area;
  return t.a.z + v * ab.z + w * ac.z;
}
