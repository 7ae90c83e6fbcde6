// A unit vector as a place on an octahedron that is folded flat, -1..1 (Meyer, Suessmuth, Sussner, Stamminger, Greiner,
// "On Floating-Point Normal Vectors", 2010). `size`: of the octahedron, if it is not 1.
vec2 folded(vec2 place, float size) {
  return (size - abs(place.yx)) * vec2(place.x < 0.0 ? -1.0 : 1.0, place.y < 0.0 ? -1.0 : 1.0);
}

vec2 octahedral(vec3 direction) {
  vec2 place = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  return direction.z < 0.0 ? folded(place, 1.0) : place;
}

// `precise`: every program must see the same vector.
vec3 fromOctahedral(vec2 place, float size) {
  precise float z = size - abs(place.x) - abs(place.y);
  precise vec3 direction = normalize(vec3(z < 0.0 ? folded(place, size) : place, z));
  return direction;
}

vec3 fromOctahedral(vec2 place) { return fromOctahedral(place, 1.0); }
