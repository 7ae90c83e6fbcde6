// The alpha test, one rule for all raster passes and rays: level 0, bilinear by hand (or nearest), as in
// renderer/scene/alpha.cpp, which gives the same answer to the bit.
#include "lib/texture_use.glsl"
#include "shared/alpha_math.h"

layout(binding = UNIT_ALPHA) uniform usamplerBuffer alphaTexels;

// Four alphas share a word.
uint fetchAlpha(int number) {
  return bitfieldExtract(texelFetch(alphaTexels, number >> 2).r, 8 * (number & 3), 8);
}

// The four texels' alpha, 0..255: (x0, y0), (x1, y0), (x0, y1), (x1, y1). `first`: of the texture.
vec4 fetchAlpha(int first, int width, ivec2 x, ivec2 y) {
  ivec2 rows = first + width * y;
  return vec4(fetchAlpha(rows.x + x.x), fetchAlpha(rows.x + x.y), fetchAlpha(rows.y + x.x), fetchAlpha(rows.y + x.y));
}

// What the test of one triangle needs, at every point of it.
struct CutTriangle {
  vec2 uvA;  // of the texture, before its transform
  vec2 uvB;
  vec2 uvC;
  vec3 vertexAlpha;
  vec3 transformU;
  vec3 transformV;
  uvec4 texture;  // sampling, first texel, width, height; width 0: none
  vec2 limits;    // the factor's alpha, the cutoff
};

// blends: FrameConstants::blends.
CutTriangle cutTriangle(uvec4 corners, bool blends) {
  CutTriangle cut;
  GpuTexture use = materials[corners.w].textures[TEXTURE_BASE_COLOR];
  bool second = (use.sampling & SAMPLING_UV_SET) != 0u;
  cut.uvA = second ? attributes[corners.x].uv1 : attributes[corners.x].uv0;
  cut.uvB = second ? attributes[corners.y].uv1 : attributes[corners.y].uv0;
  cut.uvC = second ? attributes[corners.z].uv1 : attributes[corners.z].uv0;
  cut.vertexAlpha = vec3(attributes[corners.x].color.a, attributes[corners.y].color.a, attributes[corners.z].color.a);
  cut.transformU = vec3(use.transform[0], use.transform[1], use.transform[2]);
  cut.transformV = vec3(use.transform[3], use.transform[4], use.transform[5]);
  cut.texture = uvec4(use.sampling, materials[corners.w].alphaFirst, materials[corners.w].alphaWidth,
                      materials[corners.w].alphaHeight);
  bool blend = (materials[corners.w].flags & MATERIAL_BLEND) != 0u;
  cut.limits = vec2(blend && !blends ? 1.0 : materials[corners.w].baseColor.a,
                    blend && blends ? ALPHA_CLEAR : materials[corners.w].alphaCutoff);
  return cut;
}

// Whether the triangle has a hole at this point.
bool cutAway(CutTriangle cut, vec2 barycentrics) {
  float u = alphaInterpolate(cut.uvA.x, cut.uvB.x, cut.uvC.x, barycentrics.x, barycentrics.y);
  float v = alphaInterpolate(cut.uvA.y, cut.uvB.y, cut.uvC.y, barycentrics.x, barycentrics.y);
  uint sampling = cut.texture.x;
  ivec2 size = ivec2(cut.texture.zw);
  bool nearest = (sampling & SAMPLING_MAGNIFY_NEAREST) != 0u;
  AlphaAxis x = alphaAxis(alphaTransform(cut.transformU.x, cut.transformU.y, cut.transformU.z, u, v), size.x,
                          sampling & 3u, nearest);
  AlphaAxis y = alphaAxis(alphaTransform(cut.transformV.x, cut.transformV.y, cut.transformV.z, u, v), size.y,
                          (sampling >> 2) & 3u, nearest);
  vec4 texels = fetchAlpha(int(cut.texture.y), size.x, ivec2(x.first, x.second), ivec2(y.first, y.second));
  float texel = size.x == 0 ? 1.0 : alphaBlend(texels.x, texels.y, texels.z, texels.w, x.weight, y.weight);
  float vertexAlpha =
      alphaInterpolate(cut.vertexAlpha.x, cut.vertexAlpha.y, cut.vertexAlpha.z, barycentrics.x, barycentrics.y);
  return alphaBelow(texel, vertexAlpha, cut.limits.x, cut.limits.y);
}

bool cutAway(uint triangle, vec2 barycentrics) {
  uvec4 corners = triangles[triangle];
  return (materials[corners.w].flags & MATERIAL_CUT) != 0u &&
         cutAway(cutTriangle(corners, frame.blends != 0u), barycentrics);
}
