#include "frame/pack_material.h"

#include <algorithm>
#include <cmath>

namespace halfsilver {
namespace {

constexpr std::uint32_t kMagnifyNearest = 16, kMinifyNearest = 32, kNoMipmaps = 64, kSecondUvSet = 128;

std::uint32_t wrapBits(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return 0;
    case Wrap::mirror:
      return 1;
    case Wrap::clamp:
      break;
  }
  return 2;
}

shared::GpuTexture packTexture(const TextureUse& use, std::span<const std::uint32_t> locations) {
  shared::GpuTexture packed{};
  packed.location = use.texture < 0 ? NO_TEXTURE : locations[static_cast<std::size_t>(use.texture)];
  packed.sampling = wrapBits(use.wrapU) | wrapBits(use.wrapV) << 2 |
                    (use.magnify == Filter::nearest ? kMagnifyNearest : 0) |
                    (use.minify == Filter::nearest ? kMinifyNearest : 0) | (use.mipmaps ? 0 : kNoMipmaps) |
                    (use.uvSet == 1 ? kSecondUvSet : 0);
  for (int i = 0; i < 3; ++i) {
    packed.transform[i] = use.transform[0][i];
    packed.transform[3 + i] = use.transform[1][i];
  }
  return packed;
}

// The coefficient of Beer's law: what is left after d meters is exp(-d * absorption).
glm::vec3 absorption(const Material& material) {
  constexpr float kShortest = 1e-30f, kDarkest = 1e-30f;
  if (std::isinf(material.attenuationDistance)) return glm::vec3(0);
  const glm::vec3 color = glm::clamp(material.attenuationColor, kDarkest, 1.0f);
  return -glm::log(color) / std::max(material.attenuationDistance, kShortest);
}

// Transmission, coat, sheen and anisotropy.
void packLayers(const Material& material, shared::GpuMaterial& packed) {
  if (material.unlit || material.mirror) return;
  if (material.transmission > 0) {
    const bool thin = material.thickness <= 0;
    packed.flags |= MATERIAL_TRANSMISSIVE | (thin ? MATERIAL_THIN : 0);
    packed.transmission = material.transmission;
    packed.thickness = material.thickness;
    packed.dispersion = material.dispersion;
    if (!thin) packed.absorption = absorption(material);
  }
  if (material.coat > 0) {
    packed.flags |= MATERIAL_COATED;
    packed.coat = material.coat;
    packed.coatRoughness = material.coatRoughness;
    packed.coatNormalScale = material.coatNormalScale;
  }
  if (material.sheenColor != glm::vec3(0)) {
    packed.flags |= MATERIAL_SHEEN;
    packed.sheenColor = material.sheenColor;
    packed.sheenRoughness = material.sheenRoughness;
  }
  if (material.anisotropy > 0) {
    packed.flags |= MATERIAL_ANISOTROPIC;
    packed.anisotropy = material.anisotropy;
    packed.anisotropyX = std::cos(material.anisotropyRotation);
    packed.anisotropyY = std::sin(material.anisotropyRotation);
  }
}

// Textures of layers that are not there need not be read.
bool hasEffect(const shared::GpuMaterial& material, std::size_t use) {
  if (use == TEXTURE_ANISOTROPY) return (material.flags & MATERIAL_ANISOTROPIC) != 0;
  if (use >= TEXTURE_SHEEN_COLOR) return (material.flags & MATERIAL_SHEEN) != 0;
  if (use >= TEXTURE_CLEARCOAT) return (material.flags & MATERIAL_COATED) != 0;
  return use < TEXTURE_TRANSMISSION || (material.flags & MATERIAL_TRANSMISSIVE) != 0;
}

}  // namespace

TextureUses textureUses(const Material& material) {
  TextureUses uses{};
  uses[TEXTURE_BASE_COLOR] = &material.baseColorTexture;
  uses[TEXTURE_METALLIC_ROUGHNESS] = &material.metallicRoughnessTexture;
  uses[TEXTURE_NORMAL] = &material.normalTexture;
  uses[TEXTURE_OCCLUSION] = &material.occlusionTexture;
  uses[TEXTURE_EMISSIVE] = &material.emissiveTexture;
  uses[TEXTURE_SPECULAR] = &material.specularTexture;
  uses[TEXTURE_SPECULAR_COLOR] = &material.specularColorTexture;
  uses[TEXTURE_TRANSMISSION] = &material.transmissionTexture;
  uses[TEXTURE_THICKNESS] = &material.thicknessTexture;
  uses[TEXTURE_CLEARCOAT] = &material.coatTexture;
  uses[TEXTURE_CLEARCOAT_ROUGHNESS] = &material.coatRoughnessTexture;
  uses[TEXTURE_CLEARCOAT_NORMAL] = &material.coatNormalTexture;
  uses[TEXTURE_SHEEN_COLOR] = &material.sheenColorTexture;
  uses[TEXTURE_SHEEN_ROUGHNESS] = &material.sheenRoughnessTexture;
  uses[TEXTURE_ANISOTROPY] = &material.anisotropyTexture;
  return uses;
}

shared::GpuMaterial packMaterial(const Material& material, bool holes, const AlphaPlace& alpha,
                                 std::span<const std::uint32_t> locations) {
  const bool blend = material.alphaMode == AlphaMode::blend;
  const float ratio = (material.ior - 1) / (material.ior + 1);
  shared::GpuMaterial packed{};
  packed.baseColor = material.baseColor;
  packed.emissive = material.emissive;
  packed.alphaCutoff = blend ? 0.5f : material.alphaCutoff;
  packed.specularColor = material.specularColor;
  packed.specularFactor = material.specular;
  packed.metallic = material.metallic;
  packed.roughness = material.roughness;
  packed.normalScale = material.normalScale;
  packed.occlusionStrength = material.occlusionStrength;
  packed.dielectricF0 = ratio * ratio;
  packed.mirror = material.mirror.value_or(0.0f);
  packed.flags = (seenFromBehind(material) ? MATERIAL_DOUBLE_SIDED : 0) | (holes ? MATERIAL_CUT : 0) |
                 (blend ? MATERIAL_BLEND : 0) | (material.unlit ? MATERIAL_UNLIT : 0) |
                 (material.mirror ? MATERIAL_MIRROR : 0);
  packed.ior = material.ior;
  packLayers(material, packed);
  packed.alphaFirst = alpha.first;
  packed.alphaWidth = alpha.width;
  packed.alphaHeight = alpha.height;
  const TextureUses uses = textureUses(material);
  for (std::size_t use = 0; use < uses.size(); ++use) {
    packed.textures[use] = packTexture(*uses[use], locations);
    if (packed.textures[use].location != NO_TEXTURE && hasEffect(packed, use))
      packed.flags |= 1u << (MATERIAL_TEXTURES_SHIFT + use);
  }
  return packed;
}

}  // namespace halfsilver
