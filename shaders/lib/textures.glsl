// Material textures: 2D arrays of equal size ("buckets"). Samplers repeat, filter linearly and use mipmaps; the other
// wrap and filter modes of a use are made here from coordinates and gradients.
#include "lib/texture_use.glsl"

// The scene's buckets: a program is made for their number, since software rasterizers sample every case of a switch.
#ifndef BUCKETS
#define BUCKETS TEXTURE_BUCKETS
#endif
layout(binding = UNIT_MATERIAL_TEXTURES) uniform sampler2DArray materialTextures[BUCKETS];

ivec2 textureExtent(GpuTexture use) {
  switch (use.location >> 16) {
#if BUCKETS > 1
    case 0u: return textureSize(materialTextures[0], 0).xy;
#endif
#if BUCKETS > 2
    case 1u: return textureSize(materialTextures[1], 0).xy;
#endif
#if BUCKETS > 3
    case 2u: return textureSize(materialTextures[2], 0).xy;
#endif
#if BUCKETS > 4
    case 3u: return textureSize(materialTextures[3], 0).xy;
#endif
#if BUCKETS > 5
    case 4u: return textureSize(materialTextures[4], 0).xy;
#endif
#if BUCKETS > 6
    case 5u: return textureSize(materialTextures[5], 0).xy;
#endif
#if BUCKETS > 7
    case 6u: return textureSize(materialTextures[6], 0).xy;
#endif
    default: return textureSize(materialTextures[BUCKETS - 1], 0).xy;
  }
}

// Sampler arrays take constant indices only, if the index differs between neighbors.
vec4 sampleBucket(uint bucket, vec3 coordinates, vec2 ddx, vec2 ddy) {
  switch (bucket) {
#if BUCKETS > 1
    case 0u: return textureGrad(materialTextures[0], coordinates, ddx, ddy);
#endif
#if BUCKETS > 2
    case 1u: return textureGrad(materialTextures[1], coordinates, ddx, ddy);
#endif
#if BUCKETS > 3
    case 2u: return textureGrad(materialTextures[2], coordinates, ddx, ddy);
#endif
#if BUCKETS > 4
    case 3u: return textureGrad(materialTextures[3], coordinates, ddx, ddy);
#endif
#if BUCKETS > 5
    case 4u: return textureGrad(materialTextures[4], coordinates, ddx, ddy);
#endif
#if BUCKETS > 6
    case 5u: return textureGrad(materialTextures[5], coordinates, ddx, ddy);
#endif
#if BUCKETS > 7
    case 6u: return textureGrad(materialTextures[6], coordinates, ddx, ddy);
#endif
    default: return textureGrad(materialTextures[BUCKETS - 1], coordinates, ddx, ddy);
  }
}

// Into 0..1; clamped and mirrored coordinates stay `margin` away from the borders, where the repeating sampler would
// blend in the opposite side.
float wrapCoordinate(float coordinate, uint wrap, float margin) {
  if (wrap == SAMPLING_CLAMP) return clamp(coordinate, margin, 1.0 - margin);
  if (wrap == SAMPLING_MIRROR) {
    float inPeriod = coordinate - 2.0 * floor(0.5 * coordinate);
    return clamp(inPeriod > 1.0 ? 2.0 - inPeriod : inPeriod, margin, 1.0 - margin);
  }
  return fract(coordinate);
}

// uv, ddx, ddy: before the use's transform, of the use's uv set.
vec4 sampleTexture(GpuTexture use, vec2 uv, vec2 ddx, vec2 ddy) {
  mat2 linearPart = mat2(use.transform[0], use.transform[3], use.transform[1], use.transform[4]);
  uv = linearPart * uv + vec2(use.transform[2], use.transform[5]);
  ddx = linearPart * ddx;
  ddy = linearPart * ddy;
  vec2 size = vec2(textureExtent(use));
  float footprint = max(length(ddx * size), length(ddy * size));  // texels
  bool minified = footprint > 1.0;
  bool nearest = (use.sampling & (minified ? SAMPLING_MINIFY_NEAREST : SAMPLING_MAGNIFY_NEAREST)) != 0u;
  bool mipmapped = minified && (use.sampling & SAMPLING_NO_MIPMAPS) == 0u;
  float level = mipmapped ? log2(footprint) : 0.0;
  level = nearest ? round(level) : level;
  vec2 texel = min(exp2(nearest ? level : ceil(level)) / size, vec2(1.0));
  vec2 wrapped = vec2(wrapCoordinate(uv.x, use.sampling & 3u, 0.5 * texel.x),
                      wrapCoordinate(uv.y, (use.sampling >> 2) & 3u, 0.5 * texel.y));
  // Gradients of a quarter of a texel name a level to the sampler; zero would be a division by zero to some.
  if (nearest) {
    // The center of the nearest texel of one level: the linear filter then gives that texel alone.
    vec2 levelSize = max(floor(size * exp2(-level)), vec2(1.0));
    wrapped = (min(floor(wrapped * levelSize), levelSize - 1.0) + 0.5) / levelSize;
  }
  if (nearest || !mipmapped) {
    float extent = mipmapped ? exp2(level) : 0.25;
    ddx = vec2(extent / size.x, 0.0);
    ddy = vec2(0.0, extent / size.y);
  }
  return sampleBucket(use.location >> 16, vec3(wrapped, float(use.location & 0xffffu)), ddx, ddy);
}
