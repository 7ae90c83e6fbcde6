#include <halfsilver/io.h>

#include <tiny_gltf.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <new>

#include <halfsilver/error.h>
#include "io/gltf_build.h"
#include "io/gltf_check.h"
#include "io/gltf_document.h"

// The only file that uses tinygltf. It converts the parser's model into a Document and does nothing else with it.
namespace halfsilver {
namespace gltf {
namespace {

std::vector<std::uint8_t> readFile(const std::filesystem::path& path, const Diagnostics& diagnostics) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) diagnostics.fail("there is no such file", "");
  if (!std::filesystem::is_regular_file(status)) diagnostics.fail("is not a file", "");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) diagnostics.fail("cannot be read", error.message());
  if (size == 0) diagnostics.fail("is empty", "");
  if (size > std::numeric_limits<std::int32_t>::max()) diagnostics.fail("is larger than 2 GiB", "");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    diagnostics.fail("cannot be read", "");
  return bytes;
}

// Keeps images encoded: only those that a material uses are decoded, once their bytes are known to exist.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

// How the parser reads files.
struct Files {
  std::string folder;                      // of the scene
  std::vector<std::size_t> bufferLengths;  // what external buffers declare; the parser reads them first, in order
  std::size_t buffersRead = 0;
};

// The parser also looks in the working directory; only files beside the scene count.
bool isBeside(const std::string& path, void* user) {
  std::error_code error;
  return path.starts_with(static_cast<const Files*>(user)->folder) && std::filesystem::is_regular_file(path, error);
}

// A buffer's file may be longer than the buffer, but the parser rejects that.
bool readExternal(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void* user) {
  if (!tinygltf::ReadWholeFile(bytes, error, path, nullptr)) return false;
  Files& files = *static_cast<Files*>(user);
  if (files.buffersRead < files.bufferLengths.size())
    bytes->resize(std::min(bytes->size(), files.bufferLengths[files.buffersRead++]));
  return true;
}

std::string firstLine(const std::string& text) {
  constexpr std::size_t kMaxLength = 300;
  return text.substr(0, std::min(text.find('\n'), kMaxLength));
}

tinygltf::Model parse(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const std::vector<std::uint8_t> bytes = readFile(path, diagnostics);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool binary = text.starts_with("glTF");
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (!binary && (first == std::string_view::npos || text[first] != '{'))
    diagnostics.fail("is not a glTF file", "it begins with neither 'glTF' nor '{'");
  Files files;
  files.bufferLengths = checkJson(binary ? checkBinary(bytes, diagnostics) : text, binary, diagnostics);
  files.folder = std::filesystem::absolute(path).parent_path().string();
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keepEncoded, nullptr);
  loader.SetFsCallbacks({isBeside, tinygltf::ExpandFilePath, readExternal, tinygltf::WriteWholeFile, &files});
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const bool read = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, files.folder)
                           : loader.LoadASCIIFromString(&model, &error, &warning, text.data(), size, files.folder);
  if (!read) diagnostics.fail(error.empty() ? "cannot be parsed" : firstLine(error), "");
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

Mesh convert(tinygltf::Mesh& source) {
  Mesh mesh{source.name, {}, std::move(source.weights)};
  for (auto& primitive : source.primitives)
    mesh.primitives.push_back({std::move(primitive.attributes), std::move(primitive.targets), primitive.indices,
                               primitive.material, primitive.mode});
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
  return {source.name, source.type == "perspective", source.perspective.yfov, source.perspective.znear,
          source.perspective.zfar};
}

LightInfo convert(const tinygltf::Light& source) {
  return {source.type,
          source.color,
          source.intensity,
          source.range,
          source.spot.innerConeAngle,
          source.spot.outerConeAngle};
}

Document convert(tinygltf::Model&& model, const Diagnostics& diagnostics) {
  Document document;
  for (auto& buffer : model.buffers) document.buffers.push_back(std::move(buffer.data));
  for (const auto& view : model.bufferViews)
    document.views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride});
  for (const auto& accessor : model.accessors) document.accessors.push_back(convert(accessor));
  for (auto& mesh : model.meshes) document.meshes.push_back(convert(mesh));
  for (auto& node : model.nodes) document.nodes.push_back(convert(node));
  for (const auto& material : model.materials) document.materials.push_back(convert(material));
  for (const auto& sampler : model.samplers)
    document.samplers.push_back({sampler.magFilter, sampler.minFilter, sampler.wrapS, sampler.wrapT});
  for (const auto& texture : model.textures) document.textures.push_back({texture.sampler, texture.source});
  for (auto& image : model.images)
    document.images.push_back({image.name.empty() ? image.uri : image.name, image.bufferView, std::move(image.image)});
  for (auto& skin : model.skins) document.skins.push_back({std::move(skin.joints), skin.inverseBindMatrices});
  for (const auto& animation : model.animations) document.animations.push_back(convert(animation));
  for (const auto& camera : model.cameras) document.cameras.push_back(convert(camera));
  for (const auto& light : model.lights) document.lights.push_back(convert(light));
  if (model.defaultScene >= 0 || !model.scenes.empty()) {
    const auto& scene = get(model.scenes, std::max(0, model.defaultScene), "scenes", diagnostics, "scene");
    document.sceneName = scene.name;
    document.sceneNodes = scene.nodes;
  }
  return document;
}

}  // namespace

bool decodeImage(std::span<const std::uint8_t> bytes, Texture& texture) {
  tinygltf::Image image;
  std::string error, warning;
  if (bytes.size() > std::numeric_limits<int>::max() ||
      !tinygltf::LoadImageData(&image, 0, &error, &warning, 0, 0, bytes.data(), static_cast<int>(bytes.size()),
                               nullptr))
    return false;
  texture.width = image.width;
  texture.height = image.height;
  if (image.bits == 16) {
    const std::size_t count = image.image.size() / 2;
    texture.texels.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint16_t value = 0;
      std::copy_n(image.image.data() + 2 * i, 2, reinterpret_cast<unsigned char*>(&value));
      texture.texels[i] = static_cast<std::uint8_t>((value + 128u) / 257u);
    }
  } else {
    texture.texels = std::move(image.image);
  }
  return texture.texels.size() ==
         std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
}

}  // namespace gltf

Model loadGltf(const std::filesystem::path& file) {
  gltf::Diagnostics diagnostics;
  diagnostics.file = file.string();
  try {
    const gltf::Document document = gltf::convert(gltf::parse(file, diagnostics), diagnostics);
    Model model = gltf::build(document, diagnostics);
    if (model.scene.name.empty()) model.scene.name = file.stem().string();
    return model;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    diagnostics.fail("needs more memory than is available", "");
  } catch (const std::exception& error) {
    diagnostics.fail("cannot be read", error.what());
  }
}

}  // namespace halfsilver
