// A unit vector in 32 bits: the octahedron's two coordinates (Meyer et al. 2010).
uint packUnit(vec3 v) {
  v /= abs(v.x) + abs(v.y) + abs(v.z);
  vec2 folded = (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v.xy, vec2(0.0)));
  return packSnorm2x16(v.z >= 0.0 ? v.xy : folded);
}

vec3 unpackUnit(uint bits) {
  vec2 p = unpackSnorm2x16(bits);
  vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  vec2 folded = (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v.xy, vec2(0.0)));
  if (v.z < 0.0) v.xy = folded;
  return normalize(v);
}
