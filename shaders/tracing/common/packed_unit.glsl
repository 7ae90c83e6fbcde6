// A unit vector in 32 bits.
#include "lib/octahedral.glsl"

uint packUnit(vec3 direction) { return packSnorm2x16(octahedral(direction)); }
vec3 unpackUnit(uint bits) { return fromOctahedral(unpackSnorm2x16(bits)); }
