#include "io/gltf_parse.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

// Compiled here under a name of its own: libdraco brings another tinygltf, whose symbols would take the place of these.
#define tinygltf halfsilver_tinygltf
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

// The only file that uses tinygltf. It converts the parser's model into a Document and does nothing else with it.
namespace halfsilver::gltf {
namespace {

std::string firstLine(const std::string& text) {
  constexpr std::size_t kMaxLength = 300;
  return text.substr(0, std::min(text.find('\n'), kMaxLength));
}

// The parser sees neither buffers nor images: they are in the document already.
tinygltf::Model parsed(const nlohmann::json& root, const Diagnostics& diagnostics) {
  const std::string text = root.dump();
  if (text.size() > std::numeric_limits<std::uint32_t>::max()) diagnostics.fail("has more than 4 GiB of JSON", "");
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), ""))
    diagnostics.fail(error.empty() ? "cannot be parsed" : firstLine(error), "");
  return model;
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number(const tinygltf::Value& object, const char* key, double absent) {
  const tinygltf::Value& value = object.Get(key);
  return value.IsNumber() ? value.GetNumberAsDouble() : absent;
}

int whole(const tinygltf::Value& object, const char* key, int absent) {
  const tinygltf::Value& value = object.Get(key);
  return value.IsInt() ? value.GetNumberAsInt() : absent;
}

// Missing components keep their value.
template <class Vector>
Vector vector(const tinygltf::Value& object, const char* key, Vector absent) {
  const tinygltf::Value& value = object.Get(key);
  if (value.IsArray() && value.ArrayLen() == static_cast<std::size_t>(Vector::length()))
    for (int c = 0; c < Vector::length(); ++c)
      if (value.Get(c).IsNumber())
        absent[c] = static_cast<typename Vector::value_type>(value.Get(c).GetNumberAsDouble());
  return absent;
}

void transformTexture(const tinygltf::ExtensionMap& extensions, TextureInfo& info) {
  if (const auto* transform = extension(extensions, "KHR_texture_transform")) {
    info.offset = vector(*transform, "offset", info.offset);
    info.scale = vector(*transform, "scale", info.scale);
    info.rotation = number(*transform, "rotation", 0);
    info.texCoord = whole(*transform, "texCoord", info.texCoord);
  }
}

template <class Info>
TextureInfo textureInfo(const Info& source) {
  TextureInfo info;
  info.texture = source.index;
  info.texCoord = source.texCoord;
  transformTexture(source.extensions, info);
  return info;
}

// A texture named inside an extension, which the parser leaves as JSON.
TextureInfo textureInfo(const tinygltf::Value& object, const char* key) {
  TextureInfo info;
  const tinygltf::Value& source = object.Get(key);
  if (!source.IsObject()) return info;
  info.texture = whole(source, "index", -1);
  info.texCoord = whole(source, "texCoord", 0);
  const tinygltf::Value& extensions = source.Get("extensions");
  if (extensions.IsObject()) transformTexture(extensions.Get<tinygltf::Value::Object>(), info);
  return info;
}

glm::vec4 factors(const std::vector<double>& source) {
  glm::vec4 result(1);
  for (std::size_t c = 0; c < std::min<std::size_t>(source.size(), 4); ++c)
    result[static_cast<int>(c)] = static_cast<float>(source[c]);
  return result;
}

void addTransmission(const tinygltf::ExtensionMap& extensions, MaterialInfo& info) {
  Material& material = info.material;
  if (const auto* transmission = extension(extensions, "KHR_materials_transmission")) {
    material.transmission = static_cast<float>(number(*transmission, "transmissionFactor", 0));
    info.transmission = textureInfo(*transmission, "transmissionTexture");
  }
  if (const auto* volume = extension(extensions, "KHR_materials_volume")) {
    material.thickness = static_cast<float>(number(*volume, "thicknessFactor", 0));
    material.attenuationDistance =
        static_cast<float>(number(*volume, "attenuationDistance", std::numeric_limits<double>::infinity()));
    material.attenuationColor = vector(*volume, "attenuationColor", material.attenuationColor);
    info.thickness = textureInfo(*volume, "thicknessTexture");
  }
  if (const auto* dispersion = extension(extensions, "KHR_materials_dispersion"))
    material.dispersion = static_cast<float>(number(*dispersion, "dispersion", 0));
}

void addCoat(const tinygltf::ExtensionMap& extensions, MaterialInfo& info) {
  const auto* coat = extension(extensions, "KHR_materials_clearcoat");
  if (!coat) return;
  info.material.coat = static_cast<float>(number(*coat, "clearcoatFactor", 0));
  info.material.coatRoughness = static_cast<float>(number(*coat, "clearcoatRoughnessFactor", 0));
  info.coat = textureInfo(*coat, "clearcoatTexture");
  info.coatRoughness = textureInfo(*coat, "clearcoatRoughnessTexture");
  info.coatNormal = textureInfo(*coat, "clearcoatNormalTexture");
  const tinygltf::Value& normal = coat->Get("clearcoatNormalTexture");
  if (normal.IsObject()) info.material.coatNormalScale = static_cast<float>(number(normal, "scale", 1));
}

void addLobes(const tinygltf::ExtensionMap& extensions, MaterialInfo& info) {
  Material& material = info.material;
  if (const auto* sheen = extension(extensions, "KHR_materials_sheen")) {
    material.sheenColor = vector(*sheen, "sheenColorFactor", material.sheenColor);
    material.sheenRoughness = static_cast<float>(number(*sheen, "sheenRoughnessFactor", 0));
    info.sheenColor = textureInfo(*sheen, "sheenColorTexture");
    info.sheenRoughness = textureInfo(*sheen, "sheenRoughnessTexture");
  }
  if (const auto* anisotropy = extension(extensions, "KHR_materials_anisotropy")) {
    material.anisotropy = static_cast<float>(number(*anisotropy, "anisotropyStrength", 0));
    material.anisotropyRotation = static_cast<float>(number(*anisotropy, "anisotropyRotation", 0));
    info.anisotropy = textureInfo(*anisotropy, "anisotropyTexture");
  }
}

MaterialInfo convert(const tinygltf::Material& source) {
  MaterialInfo info;
  const auto& base = source.pbrMetallicRoughness;
  Material& material = info.material;
  material.name = source.name;
  material.baseColor = factors(base.baseColorFactor);
  material.emissive = glm::vec3(factors(source.emissiveFactor));
  material.metallic = static_cast<float>(base.metallicFactor);
  material.roughness = static_cast<float>(base.roughnessFactor);
  material.normalScale = static_cast<float>(source.normalTexture.scale);
  material.occlusionStrength = static_cast<float>(source.occlusionTexture.strength);
  material.alphaCutoff = static_cast<float>(source.alphaCutoff);
  material.doubleSided = source.doubleSided;
  info.alphaMode = source.alphaMode;
  info.baseColor = textureInfo(base.baseColorTexture);
  info.metallicRoughness = textureInfo(base.metallicRoughnessTexture);
  info.normal = textureInfo(source.normalTexture);
  info.occlusion = textureInfo(source.occlusionTexture);
  info.emissive = textureInfo(source.emissiveTexture);
  material.unlit = extension(source.extensions, "KHR_materials_unlit") != nullptr;
  if (const auto* strength = extension(source.extensions, "KHR_materials_emissive_strength"))
    material.emissive *= static_cast<float>(number(*strength, "emissiveStrength", 1));
  if (const auto* ior = extension(source.extensions, "KHR_materials_ior"))
    material.ior = static_cast<float>(number(*ior, "ior", 1.5));
  if (const auto* specular = extension(source.extensions, "KHR_materials_specular")) {
    material.specular = static_cast<float>(number(*specular, "specularFactor", 1));
    material.specularColor = vector(*specular, "specularColorFactor", material.specularColor);
    info.specular = textureInfo(*specular, "specularTexture");
    info.specularColor = textureInfo(*specular, "specularColorTexture");
  }
  addTransmission(source.extensions, info);
  addCoat(source.extensions, info);
  addLobes(source.extensions, info);
  return info;
}

Accessor convert(const tinygltf::Accessor& source) {
  Accessor accessor;
  accessor.view = source.bufferView;
  accessor.offset = source.byteOffset;
  accessor.count = source.count;
  accessor.componentType = source.componentType;
  accessor.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(source.type));
  accessor.normalized = source.normalized;
  if (source.sparse.isSparse)
    accessor.sparse = Sparse{static_cast<std::size_t>(std::max(0, source.sparse.count)),
                             source.sparse.indices.bufferView,
                             source.sparse.indices.componentType,
                             source.sparse.values.bufferView,
                             static_cast<std::size_t>(std::max(0, source.sparse.indices.byteOffset)),
                             static_cast<std::size_t>(std::max(0, source.sparse.values.byteOffset))};
  return accessor;
}

// Numbers by name, as attributes are.
std::map<std::string, int> indices(const tinygltf::Value& object) {
  std::map<std::string, int> result;
  if (object.IsObject())
    for (const std::string& key : object.Keys()) result[key] = whole(object, key.c_str(), -1);
  return result;
}

std::map<int, int> variants(const tinygltf::Primitive& primitive) {
  std::map<int, int> result;
  const auto* source = extension(primitive.extensions, "KHR_materials_variants");
  if (!source) return result;
  const tinygltf::Value& mappings = source->Get("mappings");
  for (std::size_t m = 0; mappings.IsArray() && m < mappings.ArrayLen(); ++m) {
    const tinygltf::Value& mapping = mappings.Get(static_cast<int>(m));
    if (!mapping.IsObject() || !mapping.Get("variants").IsArray()) continue;
    const tinygltf::Value& list = mapping.Get("variants");
    for (std::size_t v = 0; v < list.ArrayLen(); ++v)
      if (list.Get(static_cast<int>(v)).IsInt())
        result[list.Get(static_cast<int>(v)).GetNumberAsInt()] = whole(mapping, "material", -1);
  }
  return result;
}

std::optional<DracoSource> draco(const tinygltf::Primitive& primitive) {
  const auto* source = extension(primitive.extensions, "KHR_draco_mesh_compression");
  if (!source) return std::nullopt;
  return DracoSource{whole(*source, "bufferView", -1), indices(source->Get("attributes"))};
}

// Negative numbers become so large that they are found out of range.
std::optional<MeshoptSource> meshopt(const tinygltf::BufferView& view) {
  const auto* source = extension(view.extensions, "EXT_meshopt_compression");
  if (!source) return std::nullopt;
  const auto size = [&](const char* key) { return static_cast<std::size_t>(whole(*source, key, 0)); };
  const auto text = [&](const char* key) {
    return source->Get(key).IsString() ? source->Get(key).Get<std::string>() : std::string();
  };
  return MeshoptSource{whole(*source, "buffer", -1),
                       size("byteOffset"),
                       size("byteLength"),
                       size("byteStride"),
                       size("count"),
                       text("mode"),
                       text("filter")};
}

Mesh convert(tinygltf::Mesh& source) {
  Mesh mesh{source.name, {}, std::move(source.weights)};
  for (auto& primitive : source.primitives)
    mesh.primitives.push_back({std::move(primitive.attributes), std::move(primitive.targets), primitive.indices,
                               primitive.material, primitive.mode, variants(primitive), draco(primitive)});
  return mesh;
}

Node convert(tinygltf::Node& source) {
  Node node;
  node.name = source.name;
  node.children = std::move(source.children);
  node.mesh = source.mesh;
  node.skin = source.skin;
  node.camera = source.camera;
  node.translation = std::move(source.translation);
  node.rotation = std::move(source.rotation);
  node.scale = std::move(source.scale);
  node.matrix = std::move(source.matrix);
  node.weights = std::move(source.weights);
  if (const auto* instances = extension(source.extensions, "EXT_mesh_gpu_instancing"))
    node.instancing = indices(instances->Get("attributes"));
  if (const auto* light = extension(source.extensions, "KHR_lights_punctual")) node.light = whole(*light, "light", -1);
  return node;
}

Animation convert(const tinygltf::Animation& source) {
  Animation animation;
  animation.name = source.name;
  for (const auto& channel : source.channels)
    animation.channels.push_back({channel.target_node, channel.sampler, channel.target_path});
  for (const auto& sampler : source.samplers)
    animation.samplers.push_back({sampler.input, sampler.output, sampler.interpolation});
  return animation;
}

CameraInfo convert(const tinygltf::Camera& source) {
  if (source.type != "perspective")
    return {source.name, false, 0, source.orthographic.ymag, source.orthographic.znear, source.orthographic.zfar};
  return {source.name, true, source.perspective.yfov, 0, source.perspective.znear, source.perspective.zfar};
}

LightInfo convert(const tinygltf::Light& source) {
  return {source.type,
          source.color,
          source.intensity,
          source.range,
          source.spot.innerConeAngle,
          source.spot.outerConeAngle};
}

void convert(tinygltf::Model&& model, Document& document, const Diagnostics& diagnostics) {
  for (const auto& view : model.bufferViews)
    document.views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride, meshopt(view)});
  for (const auto& accessor : model.accessors) document.accessors.push_back(convert(accessor));
  for (auto& mesh : model.meshes) document.meshes.push_back(convert(mesh));
  for (auto& node : model.nodes) document.nodes.push_back(convert(node));
  for (const auto& material : model.materials) document.materials.push_back(convert(material));
  for (const auto& sampler : model.samplers)
    document.samplers.push_back({sampler.magFilter, sampler.minFilter, sampler.wrapS, sampler.wrapT});
  for (const auto& texture : model.textures) {
    const auto preferred = [&](const char* name) {
      const auto* source = extension(texture.extensions, name);
      return source ? whole(*source, "source", -1) : -1;
    };
    document.textures.push_back(
        {texture.sampler, texture.source, preferred("EXT_texture_webp"), preferred("EXT_texture_avif")});
  }
  for (auto& skin : model.skins) document.skins.push_back({std::move(skin.joints), skin.inverseBindMatrices});
  for (const auto& animation : model.animations) document.animations.push_back(convert(animation));
  for (const auto& camera : model.cameras) document.cameras.push_back(convert(camera));
  for (const auto& light : model.lights) document.lights.push_back(convert(light));
  if (const auto* source = extension(model.extensions, "KHR_materials_variants")) {
    const tinygltf::Value& list = source->Get("variants");
    for (std::size_t v = 0; list.IsArray() && v < list.ArrayLen(); ++v) {
      const tinygltf::Value& variant = list.Get(static_cast<int>(v));
      const bool named = variant.IsObject() && variant.Get("name").IsString();
      document.variants.push_back(named ? variant.Get("name").Get<std::string>() : "");
    }
  }
  if (model.defaultScene >= 0 || !model.scenes.empty()) {
    const auto& scene = get(model.scenes, std::max(0, model.defaultScene), "scenes", diagnostics, "scene");
    document.sceneName = scene.name;
    document.sceneNodes = scene.nodes;
  }
}

}  // namespace

void parse(nlohmann::json& root, Document& document, const Diagnostics& diagnostics) {
  // The parser refuses indices without a view, as compressed ones are: they stay here.
  std::vector<std::vector<int>> indices;
  if (const auto meshes = root.find("meshes"); meshes != root.end())
    for (nlohmann::json& mesh : *meshes) {
      std::vector<int>& list = indices.emplace_back();
      if (const auto primitives = mesh.find("primitives"); primitives != mesh.end())
        for (nlohmann::json& primitive : *primitives) {
          list.push_back(primitive.value("indices", -1));
          primitive.erase("indices");
        }
    }
  convert(parsed(root, diagnostics), document, diagnostics);
  for (std::size_t m = 0; m < std::min(indices.size(), document.meshes.size()); ++m)
    for (std::size_t p = 0; p < std::min(indices[m].size(), document.meshes[m].primitives.size()); ++p)
      document.meshes[m].primitives[p].indices = indices[m][p];
}

}  // namespace halfsilver::gltf
