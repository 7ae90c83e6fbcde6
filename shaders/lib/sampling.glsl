// From two numbers in [0, 1) to directions.

// Two unit vectors that make a right-handed frame with n (Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin,
// "Building an Orthonormal Basis, Revisited", JCGT 2017).
void frameAround(vec3 n, out vec3 x, out vec3 y) {
  float s = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (s + n.z), b = n.x * n.y * a;
  x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
  y = vec3(b, s + n.y * n.y * a, -n.y);
}

// Around n, as often as the cosine says: density cosine / pi.
vec3 cosineDirection(vec3 n, vec2 numbers) {
  float radius = sqrt(numbers.x), angle = 6.28318530717959 * numbers.y;
  vec3 x, y;
  frameAround(n, x, y);
  return normalize(radius * (cos(angle) * x + sin(angle) * y) + sqrt(max(0.0, 1.0 - numbers.x)) * n);
}
