// Where a texture is read for the alpha test, and how its texels are blended: the same operations in the same order
// on the GPU and the CPU, so that rasterization, GPU rays and CPU rays cut the same holes. Compiles as GLSL and, with
// glm's types in scope, as C++.
#ifndef HALFSILVER_ALPHA_MATH_H
#define HALFSILVER_ALPHA_MATH_H

#ifdef __cplusplus
#define ALPHA_FUNCTION inline
#define ALPHA_PRECISE
#else
#define ALPHA_FUNCTION
#define ALPHA_PRECISE precise
#endif

#define ALPHA_CLEAR 0.0009765625f  // what has less blends with nothing that can be seen

#define ALPHA_WRAP_REPEAT 0u
#define ALPHA_WRAP_MIRROR 1u
#define ALPHA_WRAP_CLAMP 2u

// Two neighboring texels along one axis and the weight of the second.
struct AlphaAxis {
  int first;
  int second;
  float weight;
};

// (1 - u - v) a + u b + v c.
ALPHA_FUNCTION float alphaInterpolate(float a, float b, float c, float u, float v) {
  ALPHA_PRECISE float first = 1.0f - u;
  ALPHA_PRECISE float weight = first - v;
  ALPHA_PRECISE float fromA = weight * a;
  ALPHA_PRECISE float fromB = u * b;
  ALPHA_PRECISE float fromC = v * c;
  ALPHA_PRECISE float sum = fromA + fromB;
  ALPHA_PRECISE float result = sum + fromC;
  return result;
}

// One row of a texture transform.
ALPHA_FUNCTION float alphaTransform(float x, float y, float z, float u, float v) {
  ALPHA_PRECISE float fromU = x * u;
  ALPHA_PRECISE float fromV = y * v;
  ALPHA_PRECISE float sum = fromU + fromV;
  ALPHA_PRECISE float result = sum + z;
  return result;
}

// Into 0..1 (repeat, clamp) or 0..2 (mirror), so that the texel number fits an int; anything not finite gives 0.
ALPHA_FUNCTION float alphaReduce(float coordinate, uint wrap) {
  ALPHA_PRECISE float reduced = coordinate;
  if (wrap == ALPHA_WRAP_REPEAT) {
    reduced = coordinate - floor(coordinate);
  } else if (wrap == ALPHA_WRAP_MIRROR) {
    ALPHA_PRECISE float periods = floor(coordinate * 0.5f);
    ALPHA_PRECISE float start = periods * 2.0f;
    reduced = coordinate - start;
  } else {
    if (coordinate < 0.0f) reduced = 0.0f;
    if (coordinate > 1.0f) reduced = 1.0f;
  }
  return reduced >= 0.0f && reduced <= 2.0f ? reduced : 0.0f;
}

// A texel number in -1 .. 2 size, into 0 .. size - 1.
ALPHA_FUNCTION int alphaWrapTexel(int texel, int size, uint wrap) {
  if (wrap == ALPHA_WRAP_REPEAT) return texel < 0 ? texel + size : (texel >= size ? texel - size : texel);
  if (wrap == ALPHA_WRAP_MIRROR) {
    int inPeriod = texel < 0 ? -1 - texel : (texel >= 2 * size ? texel - 2 * size : texel);
    return inPeriod >= size ? 2 * size - 1 - inPeriod : inPeriod;
  }
  return texel < 0 ? 0 : (texel >= size ? size - 1 : texel);
}

ALPHA_FUNCTION AlphaAxis alphaAxis(float coordinate, int size, uint wrap, bool nearest) {
  ALPHA_PRECISE float reduced = alphaReduce(coordinate, wrap);
  ALPHA_PRECISE float scaled = reduced * float(size);
  AlphaAxis axis;
  if (nearest) {
    axis.first = alphaWrapTexel(int(floor(scaled)), size, wrap);
    axis.second = axis.first;
    axis.weight = 0.0f;
  } else {
    ALPHA_PRECISE float shifted = scaled - 0.5f;
    ALPHA_PRECISE float low = floor(shifted);
    ALPHA_PRECISE float weight = shifted - low;
    axis.first = alphaWrapTexel(int(low), size, wrap);
    axis.second = alphaWrapTexel(int(low) + 1, size, wrap);
    axis.weight = weight;
  }
  return axis;
}

// Texels are whole numbers 0..255, as stored; the result is 0..1.
ALPHA_FUNCTION float alphaBlend(float low0, float high0, float low1, float high1, float weightX, float weightY) {
  ALPHA_PRECISE float stepX0 = high0 - low0;
  ALPHA_PRECISE float partX0 = stepX0 * weightX;
  ALPHA_PRECISE float row0 = low0 + partX0;
  ALPHA_PRECISE float stepX1 = high1 - low1;
  ALPHA_PRECISE float partX1 = stepX1 * weightX;
  ALPHA_PRECISE float row1 = low1 + partX1;
  ALPHA_PRECISE float stepY = row1 - row0;
  ALPHA_PRECISE float partY = stepY * weightY;
  ALPHA_PRECISE float blended = row0 + partY;
  ALPHA_PRECISE float result = blended * 0.00392156862745098f;
  return result;
}

// Product of the texture's, the vertex color's and the factor's alpha against the cutoff.
ALPHA_FUNCTION bool alphaBelow(float texel, float vertexAlpha, float factor, float cutoff) {
  ALPHA_PRECISE float colored = texel * vertexAlpha;
  ALPHA_PRECISE float alpha = colored * factor;
  return alpha < cutoff;
}

#endif
