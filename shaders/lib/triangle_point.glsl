// The point of a triangle on a ray, as exact as floats allow.
#include "lib/triangles.glsl"

struct TrianglePoint {
  vec2 barycentrics;  // inside the triangle
  vec3 relative;      // from the ray's origin
  vec3 position;
};

// Solves a + u edge1 + v edge2 = t ray for (u, v) (Moller & Trumbore 1997).
vec2 solveBarycentrics(vec3 a, vec3 edge1, vec3 edge2, vec3 ray) {
  vec3 p = cross(ray, edge2);
  float determinant = dot(edge1, p);
  return vec2(dot(-a, p), dot(ray, cross(-a, edge1))) / determinant;
}

// ray: of any length.
TrianglePoint pointOnTriangle(uint triangle, vec3 origin, vec3 ray) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 edge1 = b - a, edge2 = c - a;
  vec3 fromOrigin = a - origin;
  vec2 uv = solveBarycentrics(fromOrigin, edge1, edge2, ray);
  // A triangle seen edge-on has no answer; pixel centers on an edge are a rounding error outside.
  if (any(isnan(uv)) || any(isinf(uv))) uv = vec2(1.0 / 3.0);
  uv = clamp(uv, vec2(0.0), vec2(1.0));
  if (uv.x + uv.y > 1.0) uv /= uv.x + uv.y;

  TrianglePoint point;
  point.barycentrics = uv;
  point.relative = fromOrigin + uv.x * edge1 + uv.y * edge2;
  point.position = a + uv.x * edge1 + uv.y * edge2;
  // On a triangle that is large against its distance, a barycentric's last bit is many bits of the position: solve
  // again from the point that was found, where the numbers are small.
  vec2 change = solveBarycentrics(point.relative, edge1, edge2, ray);
  vec3 correction = change.x * edge1 + change.y * edge2;
  if (dot(correction, correction) < 1e-8 * dot(point.relative, point.relative)) {
    point.relative += correction;
    point.position += correction;
  }
  return point;
}
