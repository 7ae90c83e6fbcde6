// The alpha test, one rule for all raster passes and rays: level 0, bilinear by hand (or nearest), as in
// renderer/scene/alpha.cpp, which gives the same answer to the bit.
#include "lib/texture_use.glsl"
#include "shared/alpha_math.h"

layout(binding = UNIT_ALPHA) uniform usamplerBuffer alphaTexels;

// The four texels' alpha, 0..255: (x0, y0), (x1, y0), (x0, y1), (x1, y1). `first`: of the texture.
vec4 fetchAlpha(int first, int width, ivec2 x, ivec2 y) {
  ivec2 rows = first + width * y;
  return vec4(texelFetch(alphaTexels, rows.x + x.x).r, texelFetch(alphaTexels, rows.x + x.y).r,
              texelFetch(alphaTexels, rows.y + x.x).r, texelFetch(alphaTexels, rows.y + x.y).r);
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
    ivec2 size = ivec2(materials[corners.w].alphaWidth, materials[corners.w].alphaHeight);
    bool nearest = (use.sampling & SAMPLING_MAGNIFY_NEAREST) != 0u;
    AlphaAxis x = alphaAxis(alphaTransform(use.transform[0], use.transform[1], use.transform[2], u, v), size.x,
                            use.sampling & 3u, nearest);
    AlphaAxis y = alphaAxis(alphaTransform(use.transform[3], use.transform[4], use.transform[5], u, v), size.y,
                            (use.sampling >> 2) & 3u, nearest);
    vec4 texels = fetchAlpha(int(materials[corners.w].alphaFirst), size.x, ivec2(x.first, x.second),
                             ivec2(y.first, y.second));
    texel = alphaBlend(texels.x, texels.y, texels.z, texels.w, x.weight, y.weight);
  }
  float factor = (flags & MATERIAL_BLEND) != 0u ? 1.0 : materials[corners.w].baseColor.a;
  return alphaBelow(texel, vertexAlpha, factor, materials[corners.w].alphaCutoff);
}
