// A unit vector as a place on an octahedron that is folded flat, -1..1 (Meyer, Suessmuth, Sussner, Stamminger, Greiner,
// "On Floating-Point Normal Vectors", 2010).
vec2 folded(vec2 place) {
  return (1.0 - abs(place.yx)) * vec2(place.x < 0.0 ? -1.0 : 1.0, place.y < 0.0 ? -1.0 : 1.0);
}

vec2 octahedral(vec3 direction) {
  vec2 place = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  return direction.z < 0.0 ? folded(place) : place;
}

vec3 fromOctahedral(vec2 place) {
  float z = 1.0 - abs(place.x) - abs(place.y);
  return normalize(vec3(z < 0.0 ? folded(place) : place, z));
}
