// A fragment with its surface attributes in two RGBA32F texels (Kastrati & Goswami 2017, figure 2): base color and
// depth; reflectivity, whose sign bit is the sign of normal.x, normal.y, normal.z and the triangle's number. The number
// is kept as a float's value, which is exact up to 2^24.
// Programs that write define ENTRY_ACCESS before anything else.
#include "shared/passes/attributes.h"

#define ENTRY_TEXELS 2
#ifndef ENTRY_ACCESS
#define ENTRY_ACCESS readonly
#endif

layout(rgba32f, binding = IMAGE_ENTRIES) ENTRY_ACCESS uniform imageBuffer pool;

vec4 packNormal(vec3 normal, float reflectivity, uint triangle) {
  uint bits = floatBitsToUint(abs(reflectivity)) | (normal.x < 0.0 ? 0x80000000u : 0u);
  return vec4(uintBitsToFloat(bits), normal.y, normal.z, float(triangle));
}

vec4 unpackNormalReflectivity(vec4 texel) {
  bool negative = (floatBitsToUint(texel.x) & 0x80000000u) != 0u;
  float x = sqrt(max(0.0, 1.0 - texel.y * texel.y - texel.z * texel.z));
  return vec4(negative ? -x : x, texel.y, texel.z, abs(texel.x));
}
