// Where a curved mirror shows what a flat one in its place would show elsewhere.
#include "lib/scene.glsl"

// How the normal turns along a surface, per meter: linear in the barycentrics.
struct Curvature {
  bool any;
  vec3 alongU, alongV;  // change of the unit normal per barycentric
  vec3 edge1, edge2;
};

// `normal`: the shading normal, which the vertices' normals may point away from.
Curvature curvatureOf(uint triangle, vec2 barycentrics, vec3 normal) {
  uvec4 corners = triangleAt(triangle);
  vec3 a = attributes[corners.x].normal, u = attributes[corners.y].normal - a, v = attributes[corners.z].normal - a;
  vec3 smoothed = a + barycentrics.x * u + barycentrics.y * v;
  float unit = (dot(smoothed, normal) < 0.0 ? -1.0 : 1.0) / max(length(smoothed), 1e-6);
  vec3 origin = vertexPosition(corners.x);
  return Curvature(dot(u, u) + dot(v, v) > 1e-12, unit * u, unit * v, vertexPosition(corners.y) - origin,
                   vertexPosition(corners.z) - origin);
}

vec3 normalChange(Curvature c, vec3 along) {
  vec3 area = cross(c.edge1, c.edge2);
  vec2 change = vec2(dot(cross(along, c.edge2), area), dot(cross(c.edge1, along), area)) / max(dot(area, area), 1e-37);
  return change.x * c.alongU + change.y * c.alongV;
}

// A point in a mirror is seen where the normal halves the angle between eye and point. Both directions turn with the
// place by 1 / distance; `eyeAndHit` is the sum of the two. In a flat mirror that alone must make up for a move of eye
// or point, in a curved one the normal turns as well: the place moves less on a convex one, more on a concave one.
// `flatMove`: from the place to where a flat mirror would show the point; `view` goes there from the eye.
vec3 onCurvedMirror(vec3 flatMove, vec3 view, vec3 normal, float eyeAndHit, Curvature curvature) {
  float cosine = -dot(view, normal);
  vec3 tilted = view + cosine * normal;
  if (dot(tilted, tilted) < 1e-6) tilted = cross(normal, abs(normal.x) < 0.7 ? vec3(1, 0, 0) : vec3(0, 1, 0));
  vec3 along = normalize(tilted), across = cross(normal, along);
  mat2 directions = mat2(cosine * cosine * eyeAndHit, 0.0, 0.0, eyeAndHit);
  vec3 turnAlong = normalChange(curvature, along), turnAcross = normalChange(curvature, across);
  mat2 turning = 2.0 * cosine * mat2(dot(turnAlong, along), dot(turnAlong, across), dot(turnAcross, along),
                                     dot(turnAcross, across));
  vec2 flatAxes = vec2(dot(flatMove, along), dot(flatMove, across));
  mat2 both = directions + turning;
  // Near a concave mirror's focus, a point is seen everywhere at once.
  if (determinant(both) < 0.1 * determinant(directions)) return flatMove;
  vec2 axes = inverse(both) * (directions * flatAxes);
  return axes.x * along + axes.y * across;
}
