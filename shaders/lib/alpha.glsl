// The alpha test, one rule for all raster passes and rays: level 0, bilinear by hand (or nearest), as in
// renderer/scene/alpha.cpp, which gives the same answer to the bit.
#include "lib/textures.glsl"
#include "shared/alpha_math.h"

// The four texels' alpha, 0..255: (x0, y0), (x1, y0), (x0, y1), (x1, y1).
#define FETCH_ALPHA(bucket)                                              \
  vec4(texelFetch(materialTextures[bucket], ivec3(x.x, y.x, layer), 0).a, \
       texelFetch(materialTextures[bucket], ivec3(x.y, y.x, layer), 0).a, \
       texelFetch(materialTextures[bucket], ivec3(x.x, y.y, layer), 0).a, \
       texelFetch(materialTextures[bucket], ivec3(x.y, y.y, layer), 0).a)
vec4 fetchAlpha(uint bucket, ivec2 x, ivec2 y, int layer) {
  vec4 texels;
  switch (bucket) {
    case 0u: texels = FETCH_ALPHA(0); break;
    case 1u: texels = FETCH_ALPHA(1); break;
    case 2u: texels = FETCH_ALPHA(2); break;
    case 3u: texels = FETCH_ALPHA(3); break;
    case 4u: texels = FETCH_ALPHA(4); break;
    case 5u: texels = FETCH_ALPHA(5); break;
    case 6u: texels = FETCH_ALPHA(6); break;
    default: texels = FETCH_ALPHA(7); break;
  }
  return floor(texels * 255.0 + 0.5);
}

// Whether the surface has a hole at this point.
bool cutAway(uint triangle, vec2 barycentrics) {
  uvec4 corners = triangles[triangle];
  uint flags = materials[corners.w].flags;
  if ((flags & MATERIAL_CUT) == 0u) return false;
  float vertexAlpha = alphaInterpolate(attributes[corners.x].color.a, attributes[corners.y].color.a,
                                       attributes[corners.z].color.a, barycentrics.x, barycentrics.y);
  float texel = 1.0;
  GpuTexture use = materials[corners.w].textures[TEXTURE_BASE_COLOR];
  if (hasTexture(use)) {
    bool second = (use.sampling & SAMPLING_UV_SET) != 0u;
    vec2 a = second ? attributes[corners.x].uv1 : attributes[corners.x].uv0;
    vec2 b = second ? attributes[corners.y].uv1 : attributes[corners.y].uv0;
    vec2 c = second ? attributes[corners.z].uv1 : attributes[corners.z].uv0;
    float u = alphaInterpolate(a.x, b.x, c.x, barycentrics.x, barycentrics.y);
    float v = alphaInterpolate(a.y, b.y, c.y, barycentrics.x, barycentrics.y);
    ivec2 size = textureExtent(use);
    bool nearest = (use.sampling & SAMPLING_MAGNIFY_NEAREST) != 0u;
    AlphaAxis x = alphaAxis(alphaTransform(use.transform[0], use.transform[1], use.transform[2], u, v), size.x,
                            use.sampling & 3u, nearest);
    AlphaAxis y = alphaAxis(alphaTransform(use.transform[3], use.transform[4], use.transform[5], u, v), size.y,
                            (use.sampling >> 2) & 3u, nearest);
    vec4 texels = fetchAlpha(use.location >> 16, ivec2(x.first, x.second), ivec2(y.first, y.second),
                             int(use.location & 0xffffu));
    texel = alphaBlend(texels.x, texels.y, texels.z, texels.w, x.weight, y.weight);
  }
  float factor = (flags & MATERIAL_BLEND) != 0u ? 1.0 : materials[corners.w].baseColor.a;
  return alphaBelow(texel, vertexAlpha, factor, materials[corners.w].alphaCutoff);
}
