#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/model.h>

// A glTF file as plain data, free of the parser's types. Only JSON types have been checked so far: follow indices with
// get() and read buffers with gltf_accessors.
namespace halfsilver::gltf {

struct MeshoptSource {
  int buffer = -1;
  std::size_t offset = 0, length = 0, stride = 0, count = 0;
  std::string mode, filter;
};

struct BufferView {
  int buffer = -1;
  std::size_t offset = 0, length = 0, stride = 0;  // bytes; stride 0: tightly packed
  std::optional<MeshoptSource> meshopt = {};       // what the bytes above are to be decoded from
};

struct Sparse {
  std::size_t count = 0;
  int indexView = -1, indexType = 0, valueView = -1;
  std::size_t indexOffset = 0, valueOffset = 0;
};

struct Accessor {
  int view = -1;  // -1: zeros
  std::size_t offset = 0, count = 0;
  int componentType = 0;  // glTF's number, 5126 is float
  int components = 0;     // per element
  bool normalized = false;
  std::optional<Sparse> sparse;
};

struct DracoSource {
  int view = -1;
  std::map<std::string, int> attributes;  // name -> the attribute's unique id
};

struct Primitive {
  std::map<std::string, int> attributes;
  std::vector<std::map<std::string, int>> targets;
  int indices = -1, material = -1, mode = 4;
  std::map<int, int> variants = {};  // variant -> material
  std::optional<DracoSource> draco = {};
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<double> weights;
};

struct Node {
  std::string name;
  std::vector<int> children;
  int mesh = -1, skin = -1, camera = -1, light = -1;
  std::vector<double> translation, rotation, scale, matrix, weights;  // empty where absent
  std::map<std::string, int> instancing = {};                         // EXT_mesh_gpu_instancing: attribute -> accessor
};

struct TextureInfo {
  int texture = -1, texCoord = 0;
  glm::dvec2 offset{0}, scale{1};  // KHR_texture_transform
  double rotation = 0;             // radians
};

struct MaterialInfo {
  Material material;  // without its textures
  std::string alphaMode;
  TextureInfo baseColor, metallicRoughness, normal, occlusion, emissive, specular, specularColor;
  TextureInfo transmission, thickness, coat, coatRoughness, coatNormal, sheenColor, sheenRoughness, anisotropy;
};

struct Sampler {
  int magFilter = -1, minFilter = -1, wrapS = 10497, wrapT = 10497;
};

struct TextureSource {
  int sampler = -1, image = -1, webp = -1, avif = -1;  // the last two to prefer where they can be decoded
};

struct ImageSource {
  std::string name;                 // for messages
  int view = -1;                    // -1: `bytes`
  std::vector<std::uint8_t> bytes;  // encoded
  std::string problem;              // why there are none
};

struct Skin {
  std::vector<int> joints;
  int inverseBind = -1;
};
struct Channel {
  int node = -1, sampler = -1;
  std::string path;
};

struct AnimationSampler {
  int input = -1, output = -1;
  std::string interpolation;
};

struct Animation {
  std::string name;
  std::vector<Channel> channels;
  std::vector<AnimationSampler> samplers;
};

struct CameraInfo {
  std::string name;
  bool perspective = false;
  double yfov = 0, ymag = 0;   // of perspective and other ones
  double znear = 0, zfar = 0;  // zfar 0: none
};

struct LightInfo {
  std::string type;
  std::vector<double> color;
  double intensity = 1, range = 0, innerConeAngle = 0, outerConeAngle = 0;
};

struct Document {
  std::string sceneName;
  std::vector<std::vector<std::uint8_t>> buffers;
  std::vector<BufferView> views;
  std::vector<Accessor> accessors;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<MaterialInfo> materials;
  std::vector<Sampler> samplers;
  std::vector<TextureSource> textures;
  std::vector<ImageSource> images;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  std::vector<CameraInfo> cameras;
  std::vector<LightInfo> lights;
  std::vector<std::string> variants;
  std::optional<std::vector<int>> sceneNodes;  // nothing: every root
};

// Collects messages, and limits how much data a file may expand to.
struct Diagnostics {
  std::string file;
  std::vector<std::string> warnings;
  // Elements that accessors may still expand to; small files can refer to the same bytes any number of times.
  std::uint64_t budget = std::uint64_t{1} << 28;

  // Throws Error (badInput): "file: what: where".
  [[noreturn]] void fail(const std::string& what, const std::string& where) const;
  void warn(const std::string& text);  // each text once, and a limited number
  void spend(std::uint64_t elements, const std::string& where);
  void require(std::uint64_t elements, const std::string& where) const;  // throws unless so many are left
};

// "meshes[3]"
std::string item(const char* list, std::size_t index);

// The element that an index in the file refers to.
template <class T>
const T& get(const std::vector<T>& list, int index, const char* name, const Diagnostics& diagnostics,
             const std::string& where) {
  if (index < 0 || static_cast<std::size_t>(index) >= list.size())
    diagnostics.fail("refers to " + std::string(name) + "[" + std::to_string(index) + "], but there are " +
                         std::to_string(list.size()),
                     where);
  return list[static_cast<std::size_t>(index)];
}

}  // namespace halfsilver::gltf
