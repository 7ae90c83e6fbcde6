#include "scene/alpha.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace halfsilver {
namespace {

using std::floor;
using uint = std::uint32_t;
#include "shared/alpha_math.h"

uint wrapNumber(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return ALPHA_WRAP_REPEAT;
    case Wrap::mirror:
      return ALPHA_WRAP_MIRROR;
    case Wrap::clamp:
      break;
  }
  return ALPHA_WRAP_CLAMP;
}

float texelAlpha(const Texture& texture, int x, int y) {
  const std::size_t texel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(x);
  return static_cast<float>(texture.texels[4 * texel + 3]);
}

float textureAlpha(const Texture& texture, const TextureUse& use, float u, float v) {
  const bool nearest = use.magnify == Filter::nearest;
  const glm::vec3& row0 = use.transform[0];
  const glm::vec3& row1 = use.transform[1];
  const AlphaAxis x =
      alphaAxis(alphaTransform(row0.x, row0.y, row0.z, u, v), texture.width, wrapNumber(use.wrapU), nearest);
  const AlphaAxis y =
      alphaAxis(alphaTransform(row1.x, row1.y, row1.z, u, v), texture.height, wrapNumber(use.wrapV), nearest);
  return alphaBlend(texelAlpha(texture, x.first, y.first), texelAlpha(texture, x.second, y.first),
                    texelAlpha(texture, x.first, y.second), texelAlpha(texture, x.second, y.second), x.weight,
                    y.weight);
}

// What alpha is multiplied by and what it is tested against.
struct Limits {
  float factor, cutoff;
};

Limits limitsOf(const Material& material, bool blends) {
  if (material.alphaMode != AlphaMode::blend) return {material.baseColor.a, material.alphaCutoff};
  return blends ? Limits{material.baseColor.a, ALPHA_CLEAR} : Limits{1.0f, 0.5f};
}

float leastAlpha(const Texture& texture) {
  std::uint8_t least = 255;
  for (std::size_t i = 3; i < texture.texels.size(); i += 4) least = std::min(least, texture.texels[i]);
  return static_cast<float>(least) / 255.0f;
}

// By material, the least alpha of its texture and vertices, without its factor.
std::vector<float> leastAlphas(const Scene& scene) {
  std::vector<float> least(scene.materials.size(), std::numeric_limits<float>::max());  // of vertices
  for (const Triangle& triangle : scene.triangles)
    if (scene.materials[triangle.material].alphaMode != AlphaMode::opaque)
      for (const std::uint32_t vertex : triangle.vertices)
        least[triangle.material] = std::min(least[triangle.material], scene.vertices[vertex].color.a);

  std::map<int, float> textures;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const int texture = scene.materials[m].baseColorTexture.texture;
    if (scene.materials[m].alphaMode == AlphaMode::opaque || texture < 0) continue;
    const auto [place, isNew] = textures.try_emplace(texture, 0.0f);
    if (isNew) place->second = leastAlpha(*scene.textures[static_cast<std::size_t>(texture)]);
    least[m] *= place->second;
  }
  return least;
}

}  // namespace

bool cutAway(const Scene& scene, std::uint32_t triangle, glm::vec2 barycentrics, bool blends) {
  const Triangle& corners = scene.triangles[triangle];
  const Material& material = scene.materials[corners.material];
  if (material.alphaMode == AlphaMode::opaque) return false;
  const Vertex& a = scene.vertices[corners.vertices[0]];
  const Vertex& b = scene.vertices[corners.vertices[1]];
  const Vertex& c = scene.vertices[corners.vertices[2]];
  const float vertexAlpha = alphaInterpolate(a.color.a, b.color.a, c.color.a, barycentrics.x, barycentrics.y);
  float texel = 1.0f;
  const TextureUse& use = material.baseColorTexture;
  if (use.texture >= 0) {
    const std::size_t set = use.uvSet == 1 ? 1 : 0;
    const float u = alphaInterpolate(a.uv[set].x, b.uv[set].x, c.uv[set].x, barycentrics.x, barycentrics.y);
    const float v = alphaInterpolate(a.uv[set].y, b.uv[set].y, c.uv[set].y, barycentrics.x, barycentrics.y);
    texel = textureAlpha(*scene.textures[static_cast<std::size_t>(use.texture)], use, u, v);
  }
  const Limits limits = limitsOf(material, blends);
  return alphaBelow(texel, vertexAlpha, limits.factor, limits.cutoff);
}

Translucency translucencyOf(const Scene& scene) {
  const std::vector<float> least = leastAlphas(scene);
  Translucency result{std::vector<bool>(scene.materials.size(), false), 0};
  // Interpolation may round to slightly less than the smallest value.
  constexpr float kRoundingSlack = 1e-5f;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (material.alphaMode == AlphaMode::opaque) continue;
    for (const bool blends : {false, true}) {
      const Limits limits = limitsOf(material, blends);
      if (!(least[m] * limits.factor >= limits.cutoff + kRoundingSlack)) result.holes[m] = true;
    }
    result.blending += material.alphaMode == AlphaMode::blend && least[m] * material.baseColor.a < 1;
  }
  return result;
}

}  // namespace halfsilver
