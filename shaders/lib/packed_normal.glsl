// A unit vector and a number of -1..1 in 64 bits: 24 bits for each coordinate of its place on the octahedron, so that
// axes and diagonals are exact and others off by about 1e-7, and 16 bits for the number, which keeps its sign. All zero is no
// vector.
#include "lib/octahedral.glsl"

const float PLACE_STEPS = 8388606.0, PLACE_ZERO = 8388608.0, NUMBER_STEPS = 32767.0;

uvec2 packNormal(vec4 normal) {
  uvec2 place = uvec2(round(PLACE_STEPS * octahedral(normal.xyz)) + PLACE_ZERO);
  int number = int(NUMBER_STEPS * clamp(normal.w, -1.0, 1.0));  // rounded down: it is held against thresholds
  if (number == 0) number = int(sign(normal.w));
  return place << 8 | uvec2(number & 255, number >> 8 & 255);
}

vec4 unpackNormal(uvec2 stored) {
  if (stored == uvec2(0u)) return vec4(0.0);
  int number = bitfieldExtract(int(stored.y), 0, 8) << 8 | int(stored.x & 255u);
  return vec4(fromOctahedral(vec2(stored >> 8) - PLACE_ZERO, PLACE_STEPS), float(number) / NUMBER_STEPS);
}
