#include "io/gltf_check.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace halfsilver::gltf {
namespace {

using nlohmann::json;

constexpr int kDeepest = 128;

// Keys whose values are indices or other whole numbers in the core format.
constexpr std::array kIndexKeys = {"buffer",    "bufferView", "componentType", "indices",  "inverseBindMatrices",
                                   "input",     "material",   "mesh",          "mode",     "node",
                                   "output",    "camera",     "index",         "texCoord", "sampler",
                                   "skeleton",  "skin",       "source",        "scene",    "magFilter",
                                   "minFilter", "wrapS",      "wrapT"};
constexpr std::array kSizeKeys = {"byteLength", "byteOffset", "byteStride", "count"};
constexpr std::array kIndexLists = {"children", "joints", "attributes", "targets"};
constexpr std::array kExtensions = {
    "KHR_lights_punctual",      "KHR_texture_transform",   "KHR_materials_unlit",
    "KHR_materials_ior",        "KHR_materials_specular",  "KHR_materials_emissive_strength",
    "KHR_materials_volume",     "KHR_materials_clearcoat", "KHR_materials_transmission",
    "KHR_materials_dispersion", "KHR_mesh_quantization",   "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",  "EXT_texture_webp",        "EXT_texture_avif",
    "KHR_materials_variants",   "EXT_mesh_gpu_instancing", "KHR_materials_sheen",
    "KHR_materials_anisotropy"};
constexpr std::array kLists = {"accessors", "animations", "bufferViews", "buffers", "cameras", "images",  "materials",
                               "meshes",    "nodes",      "samplers",    "scenes",  "skins",   "textures"};

template <class Keys>
bool contains(const Keys& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// The parser recurses into nested values.
void checkNesting(std::string_view text, const Diagnostics& diagnostics) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) diagnostics.fail("JSON is nested too deeply", "byte " + std::to_string(i));
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

void checkWhole(const json& value, std::int64_t max, const Diagnostics& diagnostics, const std::string& where) {
  if (!value.is_number_integer()) diagnostics.fail("is not a whole number", where);
  const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(max);
  if (huge || value.get<std::int64_t>() < 0) diagnostics.fail("is out of range", where);
}

// `indices`: every number below is an index. Depth is bounded by checkNesting.
void checkNumbers(const json& value, bool indices, const Diagnostics& diagnostics, const std::string& where) {
  constexpr std::int64_t kMaxIndex = std::numeric_limits<std::int32_t>::max();
  constexpr std::int64_t kMaxBytes = std::int64_t{1} << 52;
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      checkNumbers(value[i], indices, diagnostics, where + "[" + std::to_string(i) + "]");
  } else if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      if (key == "extras" || key == "extensions") continue;
      const std::string inside = where.empty() ? key : where + "." + key;
      const bool nested = member.is_object() || member.is_array();
      if (contains(kSizeKeys, key))
        checkWhole(member, kMaxBytes, diagnostics, inside);
      else if (contains(kIndexKeys, key) && !nested)
        checkWhole(member, kMaxIndex, diagnostics, inside);
      else
        checkNumbers(member, indices || contains(kIndexLists, key) || (key == "nodes" && !where.empty()), diagnostics,
                     inside);
    }
  } else if (indices) {
    checkWhole(value, kMaxIndex, diagnostics, where);
  }
}

const json& listOf(const json& object, const char* key) {
  static const json kEmpty = json::array();
  const auto found = object.find(key);
  return found == object.end() ? kEmpty : *found;
}

void checkExtensions(const json& root, Diagnostics& diagnostics) {
  for (const char* list : {"extensionsRequired", "extensionsUsed"}) {
    if (!listOf(root, list).is_array()) diagnostics.fail("is not a list", list);
    for (const json& element : listOf(root, list)) {
      const std::string name = element.is_string() ? element.get<std::string>().substr(0, 100) : element.dump();
      if (contains(kExtensions, name)) continue;
      if (std::strcmp(list, "extensionsRequired") == 0)
        diagnostics.fail("needs the extension " + name + ", which is not supported", list);
      diagnostics.warn("the extension " + name + " is ignored");
    }
  }
}

// The parser skips these silently, which would shift what follows them.
void checkParts(const json& root, const Diagnostics& diagnostics) {
  const json& meshes = listOf(root, "meshes");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const json& primitives = listOf(meshes[m], "primitives");
    if (!primitives.is_array()) diagnostics.fail("primitives is not a list", item("meshes", m));
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const std::string where = item("meshes", m) + "." + item("primitives", p);
      if (!primitives[p].is_object()) diagnostics.fail("is not an object", where);
      const auto attributes = primitives[p].find("attributes");
      if (attributes == primitives[p].end() || !attributes->is_object()) diagnostics.fail("has no attributes", where);
      for (const json& target : listOf(primitives[p], "targets"))
        if (!target.is_object()) diagnostics.fail("has a morph target that is not an object", where);
    }
  }
}

void checkAnimations(const json& root, Diagnostics& diagnostics) {
  const json& animations = listOf(root, "animations");
  for (std::size_t a = 0; a < animations.size(); ++a) {
    for (const char* list : {"channels", "samplers"}) {
      const json& elements = listOf(animations[a], list);
      if (!elements.is_array()) diagnostics.fail(std::string(list) + " is not a list", item("animations", a));
      for (std::size_t i = 0; i < elements.size(); ++i)
        if (!elements[i].is_object()) diagnostics.fail("is not an object", item("animations", a) + "." + item(list, i));
    }
    for (const json& channel : listOf(animations[a], "channels")) {
      const auto target = channel.find("target");
      if (!channel.contains("sampler") || target == channel.end() || !target->is_object())
        diagnostics.fail("has a channel without sampler or target", item("animations", a));
      if (!target->contains("node"))
        diagnostics.warn("an animation channel that targets no node was skipped: " + item("animations", a));
    }
  }
}

}  // namespace

json checkJson(std::string_view text, Diagnostics& diagnostics) {
  checkNesting(text, diagnostics);
  json root;
  try {
    root = json::parse(text);
  } catch (const json::parse_error& error) {
    diagnostics.fail("is not valid JSON", "byte " + std::to_string(error.byte));
  } catch (const json::exception& error) {
    diagnostics.fail("is not valid JSON", error.what());
  }
  const auto asset = root.is_object() ? root.find("asset") : root.end();
  if (asset == root.end() || !asset->is_object() || !asset->contains("version") || !asset->at("version").is_string())
    diagnostics.fail("is not a glTF file", "it has no asset.version");
  for (const char* key : {"version", "minVersion"}) {
    const auto version = asset->find(key);
    if (version == asset->end() || !version->is_string()) continue;
    const std::string needed = version->get<std::string>().substr(0, 20);
    const bool readable = std::strcmp(key, "version") == 0 ? needed.starts_with("2.") : needed == "2.0";
    if (!readable) diagnostics.fail("needs glTF " + needed + ", only 2.0 is supported", std::string("asset.") + key);
  }
  checkExtensions(root, diagnostics);
  for (const char* key : kLists) {
    const json& list = listOf(root, key);
    if (!list.is_array()) diagnostics.fail("is not a list", key);
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!list[i].is_object()) diagnostics.fail("is not an object", item(key, i));
  }
  checkNumbers(root, false, diagnostics, "");
  checkParts(root, diagnostics);
  checkAnimations(root, diagnostics);
  return root;
}

}  // namespace halfsilver::gltf
