// The point of a triangle on a ray, as exact as floats allow. `precise`: every program must see the same point.
#include "lib/triangles.glsl"

struct TrianglePoint {
  vec2 barycentrics;  // inside the triangle
  vec3 relative;      // from the ray's origin
  vec3 position;
};

// Solves a + u edge1 + v edge2 = t ray for (u, v) (Moller & Trumbore 1997).
vec2 solveBarycentrics(vec3 a, vec3 edge1, vec3 edge2, vec3 ray) {
  precise vec3 p = cross(ray, edge2);
  precise float determinant = dot(edge1, p);
  precise vec2 uv = vec2(dot(-a, p), dot(ray, cross(-a, edge1))) / determinant;
  return uv;
}

// ray: of any length.
TrianglePoint pointOnTriangle(vec3 a, vec3 b, vec3 c, vec3 origin, vec3 ray) {
  precise vec3 edge1 = b - a, edge2 = c - a;
  precise vec3 fromOrigin = a - origin;
  precise vec2 uv = solveBarycentrics(fromOrigin, edge1, edge2, ray);
  // A triangle seen edge-on has no answer; pixel centers on an edge are a rounding error outside.
  if (any(isnan(uv)) || any(isinf(uv))) uv = vec2(1.0 / 3.0);
  uv = clamp(uv, vec2(0.0), vec2(1.0));
  if (uv.x + uv.y > 1.0) uv /= uv.x + uv.y;

  precise vec3 relative = fromOrigin + uv.x * edge1 + uv.y * edge2, position = a + uv.x * edge1 + uv.y * edge2;
  // On a triangle that is large against its distance, a barycentric's last bit is many bits of the position: solve
  // again from the point that was found, where the numbers are small.
  precise vec2 change = solveBarycentrics(relative, edge1, edge2, ray);
  precise vec3 correction = change.x * edge1 + change.y * edge2;
  if (dot(correction, correction) < 1e-8 * dot(relative, relative)) {
    relative += correction;
    position += correction;
  }
  return TrianglePoint(uv, relative, position);
}

TrianglePoint pointOnTriangle(uint triangle, vec3 origin, vec3 ray) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  return pointOnTriangle(a, b, c, origin, ray);
}
