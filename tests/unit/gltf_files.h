#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Small glTF files made by the tests.
namespace halfsilver::testing {

using nlohmann::json;

// A folder that is removed after the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "halfsilver-gltf-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

template <class T>
constexpr int componentType() {
  if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
  if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
  if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
  if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
  return 5126;
}

inline std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
  }
  return text;
}

// Corners of a square, position by position.
inline const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

// One buffer and the JSON around it.
struct GltfFile {
  json root = {{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  int add(const char* list, json element) {
    root[list].push_back(std::move(element));
    return static_cast<int>(root[list].size()) - 1;
  }
  int view(const std::string& bytes, int stride = 0) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    json element = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (stride) element["byteStride"] = stride;
    buffer += bytes;
    return add("bufferViews", std::move(element));
  }
  template <class T>
  int view(const std::vector<T>& values) {
    return view(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
  }
  template <class T>
  int accessor(const std::vector<T>& values, const char* type, bool normalized = false) {
    const std::string name(type);
    const std::size_t width = name == "MAT4" ? 16 : name == "SCALAR" ? 1 : static_cast<std::size_t>(name[3] - '0');
    json element = {{"bufferView", view(values)},
                    {"componentType", componentType<T>()},
                    {"count", values.size() / width},
                    {"type", type}};
    if (normalized) element["normalized"] = true;
    return add("accessors", std::move(element));
  }
  // A node with a mesh of one primitive.
  json& primitive(json attributes) {
    const int mesh = add("meshes", {{"primitives", json::array({{{"attributes", std::move(attributes)}}})}});
    add("nodes", {{"mesh", mesh}});
    return root["meshes"].back()["primitives"][0];
  }
  // The triangle (0,0,0), (1,0,0), (0,1,0).
  json& triangle() {
    return primitive({{"POSITION", accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}});
  }

  std::string glb() const {
    json finished = root;
    if (!buffer.empty()) finished["buffers"] = json::array({{{"byteLength", buffer.size()}}});
    std::string text = finished.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary = buffer;
    binary.resize((binary.size() + 3) / 4 * 4);
    const auto word = [](std::size_t value) {
      const auto number = static_cast<std::uint32_t>(value);
      return std::string(reinterpret_cast<const char*>(&number), 4);
    };
    std::string chunks = word(text.size()) + "JSON" + text;
    if (!binary.empty()) chunks += word(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
  }
  std::string gltf(const std::string& uri) const {
    json finished = root;
    if (!buffer.empty()) finished["buffers"] = json::array({{{"byteLength", buffer.size()}, {"uri", uri}}});
    return finished.dump();
  }
  std::string gltf() const { return gltf("data:application/octet-stream;base64," + base64(buffer)); }
};

// A 2 x 2 PNG: red, green / blue, white with alpha 128. Stored uncompressed.
inline std::string smallPng() {
  const auto big = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  };
  const auto chunk = [&](const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : type + data) {
      crc ^= static_cast<std::uint8_t>(c);
      for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return big(static_cast<std::uint32_t>(data.size())) + type + data + big(~crc);
  };
  const std::string rows("\0\xff\0\0\xff\0\xff\0\xff\0\0\0\xff\xff\xff\xff\xff\x80", 18);
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : rows) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const std::string stored = std::string("\x78\x01\x01\x12\x00\xed\xff", 7) + rows + big(b << 16 | a);
  return std::string("\x89PNG\r\n\x1a\n", 8) + chunk("IHDR", big(2) + big(2) + std::string("\x08\x06\0\0\0", 5)) +
         chunk("IDAT", stored) + chunk("IEND", "");
}

}  // namespace halfsilver::testing
