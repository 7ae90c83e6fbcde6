#include "io/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/gltf_accessors.h"
#include "io/gltf_images.h"
#include "io/small_codecs.h"

namespace halfsilver::gltf {
namespace {

constexpr float kLargest = 1e9f;  // of a factor
constexpr unsigned kLargestSide = 16384;
constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 30;  // of all textures together

class Builder {
 public:
  Builder(const Document& document, Diagnostics& diagnostics, Scene& scene)
      : document_(document), diagnostics_(diagnostics), scene_(scene) {}

  void run() {
    for (std::size_t m = 0; m < document_.materials.size(); ++m)
      scene_.materials.push_back(material(document_.materials[m], item("materials", m)));
  }

 private:
  float clamped(float value, float low, float high, const char* what, const std::string& where) {
    if (value >= low && value <= high) return value;
    diagnostics_.warn(std::string(what) + " is out of range and was clamped: " + where);
    return std::isnan(value) ? low : std::clamp(value, low, high);
  }

  Material material(const MaterialInfo& info, const std::string& where) {
    Material result = info.material;
    for (int c = 0; c < 4; ++c) result.baseColor[c] = clamped(result.baseColor[c], 0, 1, "baseColorFactor", where);
    for (int c = 0; c < 3; ++c) {
      result.emissive[c] = clamped(result.emissive[c], 0, kLargest, "emissive", where);
      result.specularColor[c] = clamped(result.specularColor[c], 0, kLargest, "specularColorFactor", where);
    }
    result.metallic = clamped(result.metallic, 0, 1, "metallicFactor", where);
    result.roughness = clamped(result.roughness, 0, 1, "roughnessFactor", where);
    result.normalScale = clamped(result.normalScale, -kLargest, kLargest, "normalTexture.scale", where);
    result.occlusionStrength = clamped(result.occlusionStrength, 0, 1, "occlusionTexture.strength", where);
    result.specular = clamped(result.specular, 0, 1, "specularFactor", where);
    result.alphaCutoff = clamped(result.alphaCutoff, 0, kLargest, "alphaCutoff", where);
    // KHR_materials_ior: 0 means an infinite index, whose reflectance is 1 at every angle.
    result.ior = result.ior == 0 ? kLargest : clamped(result.ior, 1, kLargest, "ior", where);
    limitLayers(result, where);
    if (info.alphaMode == "MASK")
      result.alphaMode = AlphaMode::mask;
    else if (info.alphaMode == "BLEND")
      result.alphaMode = AlphaMode::blend;
    else if (info.alphaMode != "OPAQUE")
      diagnostics_.warn("an unknown alphaMode is treated as OPAQUE: " + where);

    result.baseColorTexture = use(info.baseColor, true, where + ".baseColorTexture");
    result.metallicRoughnessTexture = use(info.metallicRoughness, false, where + ".metallicRoughnessTexture");
    result.normalTexture = use(info.normal, false, where + ".normalTexture");
    result.occlusionTexture = use(info.occlusion, false, where + ".occlusionTexture");
    result.emissiveTexture = use(info.emissive, true, where + ".emissiveTexture");
    result.specularTexture = use(info.specular, false, where + ".specularTexture");
    result.specularColorTexture = use(info.specularColor, true, where + ".specularColorTexture");
    result.transmissionTexture = use(info.transmission, false, where + ".transmissionTexture");
    result.thicknessTexture = use(info.thickness, false, where + ".thicknessTexture");
    result.coatTexture = use(info.coat, false, where + ".clearcoatTexture");
    result.coatRoughnessTexture = use(info.coatRoughness, false, where + ".clearcoatRoughnessTexture");
    result.coatNormalTexture = use(info.coatNormal, false, where + ".clearcoatNormalTexture");
    result.sheenColorTexture = use(info.sheenColor, true, where + ".sheenColorTexture");
    result.sheenRoughnessTexture = use(info.sheenRoughness, false, where + ".sheenRoughnessTexture");
    result.anisotropyTexture = use(info.anisotropy, false, where + ".anisotropyTexture");
    return result;
  }

  void limitLayers(Material& material, const std::string& where) {
    constexpr float kShortest = 1e-30f;  // meters
    material.transmission = clamped(material.transmission, 0, 1, "transmissionFactor", where);
    material.thickness = clamped(material.thickness, 0, kLargest, "thicknessFactor", where);
    for (int c = 0; c < 3; ++c)
      material.attenuationColor[c] = clamped(material.attenuationColor[c], 0, 1, "attenuationColor", where);
    material.attenuationDistance = clamped(material.attenuationDistance, kShortest,
                                           std::numeric_limits<float>::infinity(), "attenuationDistance", where);
    material.dispersion = clamped(material.dispersion, 0, kLargest, "dispersion", where);
    material.coat = clamped(material.coat, 0, 1, "clearcoatFactor", where);
    material.coatRoughness = clamped(material.coatRoughness, 0, 1, "clearcoatRoughnessFactor", where);
    material.coatNormalScale =
        clamped(material.coatNormalScale, -kLargest, kLargest, "clearcoatNormalTexture.scale", where);
    for (int c = 0; c < 3; ++c)
      material.sheenColor[c] = clamped(material.sheenColor[c], 0, 1, "sheenColorFactor", where);
    material.sheenRoughness = clamped(material.sheenRoughness, 0, 1, "sheenRoughnessFactor", where);
    material.anisotropy = clamped(material.anisotropy, 0, 1, "anisotropyStrength", where);
    material.anisotropyRotation =
        clamped(material.anisotropyRotation, -kLargest, kLargest, "anisotropyRotation", where);
  }

  TextureUse use(const TextureInfo& info, bool srgb, const std::string& where) {
    TextureUse result;
    if (info.texture == -1) return result;
    const TextureSource& source = get(document_.textures, info.texture, "textures", diagnostics_, where);
    const std::string place = item("textures", static_cast<std::size_t>(info.texture));
    int image = source.image;
    if (source.webp >= 0) image = source.webp;
    if (source.avif >= 0 && (image < 0 || canDecode(ImageFormat::avif))) image = source.avif;
    if (image < 0) {
      diagnostics_.warn("a texture without a readable image was ignored: " + place);
      return result;
    }
    result.texture = texture(image, srgb, place);
    if (source.sampler >= 0)
      sample(get(document_.samplers, source.sampler, "samplers", diagnostics_, place), result, place);
    if (info.texCoord > 1)
      diagnostics_.warn("only TEXCOORD_0 and TEXCOORD_1 are supported, TEXCOORD_0 is used instead: " + where);
    result.uvSet = info.texCoord == 1 ? 1 : 0;
    // The angle turns from u to -v: v points down, and the extension's angles are counter-clockwise as seen.
    const double c = std::cos(info.rotation), s = std::sin(info.rotation);
    result.transform = {glm::vec3(glm::dvec3(c * info.scale.x, s * info.scale.y, info.offset.x)),
                        glm::vec3(glm::dvec3(-s * info.scale.x, c * info.scale.y, info.offset.y))};
    for (const glm::vec3& row : result.transform)
      if (glm::any(glm::isnan(row)) || glm::any(glm::isinf(row)))
        diagnostics_.fail("has a texture transform that is not finite", where);
    return result;
  }

  void sample(const Sampler& sampler, TextureUse& use, const std::string& where) {
    const auto wrap = [&](int mode) {
      if (mode == 33071) return Wrap::clamp;
      if (mode == 33648) return Wrap::mirror;
      if (mode != 10497) diagnostics_.warn("an unknown wrap mode is treated as repeat: " + where);
      return Wrap::repeat;
    };
    use.wrapU = wrap(sampler.wrapS);
    use.wrapV = wrap(sampler.wrapT);
    use.magnify = sampler.magFilter == 9728 ? Filter::nearest : Filter::linear;
    const int minify = sampler.minFilter;
    use.minify = minify == 9728 || minify == 9984 || minify == 9986 ? Filter::nearest : Filter::linear;
    use.mipmaps = minify != 9728 && minify != 9729;
  }

  int texture(int image, bool srgb, const std::string& where) {
    const auto [known, added] = textures_.try_emplace({image, srgb}, static_cast<int>(scene_.textures.size()));
    if (!added) return known->second;
    auto result = std::make_shared<Texture>();
    const auto twin = textures_.find({image, !srgb});
    if (twin != textures_.end()) {
      const Texture& other = *scene_.textures[static_cast<std::size_t>(twin->second)];
      reserve(glm::uvec2(other.width, other.height), where);
      *result = other;
    } else {
      decode(image, *result, where);
    }
    result->srgb = srgb;
    scene_.textures.push_back(std::move(result));
    return known->second;
  }

  void decode(int image, Texture& texture, const std::string& where) {
    const ImageSource& source = get(document_.images, image, "images", diagnostics_, where);
    std::string place = item("images", static_cast<std::size_t>(image));
    if (!source.name.empty()) place += " \"" + source.name.substr(0, 100) + "\"";
    std::span<const std::uint8_t> bytes(source.bytes);
    if (source.view >= 0) bytes = viewBytes(document_, diagnostics_, source.view, place);
    if (bytes.empty())
      diagnostics_.fail("an image cannot be read" + (source.problem.empty() ? "" : ", " + source.problem), place);
    const ImageHeader header = imageHeader(bytes);
    const glm::uvec2 size = header.size;
    if (header.format == ImageFormat::unknown)
      diagnostics_.fail("an image is neither PNG nor JPEG nor WebP nor AVIF", place);
    if (!canDecode(header.format)) diagnostics_.fail("an image is AVIF, which only OpenImageIO can read here", place);
    if (std::max(size.x, size.y) > kLargestSide)
      diagnostics_.fail("an image is " + std::to_string(size.x) + " x " + std::to_string(size.y) + ", at most " +
                            std::to_string(kLargestSide) + " per side is supported",
                        place);
    if (!canHold(bytes, double(size.x) * size.y))
      diagnostics_.fail("an image is " + std::to_string(size.x) + " x " + std::to_string(size.y) + " in " +
                            std::to_string(bytes.size()) + " bytes",
                        place);
    reserve(size, place);
    texture.name = source.name;
    if (!decodeImage(header, bytes, texture)) diagnostics_.fail("an image does not decode", place);
  }

  // Checked before anything is decoded: a few bytes can expand to gigabytes.
  void reserve(const glm::uvec2& size, const std::string& where) {
    texels_ += std::uint64_t{size.x} * size.y;
    if (texels_ > kMaxTexels) diagnostics_.fail("the images together are larger than is allowed", where);
  }

  const Document& document_;
  Diagnostics& diagnostics_;
  Scene& scene_;
  std::map<std::pair<int, bool>, int> textures_;  // image and encoding -> texture of the scene
  std::uint64_t texels_ = 0;
};

}  // namespace

void buildMaterials(const Document& document, Diagnostics& diagnostics, Scene& scene) {
  Builder(document, diagnostics, scene).run();
}

}  // namespace halfsilver::gltf
