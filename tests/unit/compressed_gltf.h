#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gltf_files.h"

// glTF files whose geometry is encoded here, with the libraries that decode it.
namespace halfsilver::testing {

inline const std::vector<std::uint32_t> kSquareIndices = {0, 1, 2, 0, 2, 3};

// The square with texture coordinates, normals and colors, by libdraco.
inline std::string dracoSquare(bool sequential, bool quantized) {
  draco::Mesh mesh;
  mesh.set_num_points(4);
  const auto add = [&](draco::GeometryAttribute::Type type, draco::DataType data, const auto& values, int width) {
    draco::GeometryAttribute attribute;
    using Value = std::decay_t<decltype(values[0])>;
    attribute.Init(type, nullptr, static_cast<std::int8_t>(width), data, false,
                   static_cast<std::int64_t>(sizeof(Value)) * width, 0);
    const int id = mesh.AddAttribute(attribute, true, 4);
    for (std::uint32_t i = 0; i < 4; ++i)
      mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                            values.data() + i * static_cast<std::uint32_t>(width));
  };
  add(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, kSquare, 3);
  add(draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, 2);
  add(draco::GeometryAttribute::COLOR, draco::DT_UINT8,
      std::vector<std::uint8_t>{255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255}, 4);
  for (std::uint32_t f = 0; f < 2; ++f)
    mesh.AddFace({draco::PointIndex(kSquareIndices[3 * f]), draco::PointIndex(kSquareIndices[3 * f + 1]),
                  draco::PointIndex(kSquareIndices[3 * f + 2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(sequential ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
  if (quantized) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok()) throw std::runtime_error("libdraco does not encode");
  return {buffer.data(), buffer.size()};
}

inline GltfFile dracoFile(const std::string& data) {
  GltfFile file;
  const auto declared = [&](int type, int count, const char* kind, bool normalized = false) {
    return file.add("accessors",
                    {{"componentType", type}, {"count", count}, {"type", kind}, {"normalized", normalized}});
  };
  json& primitive = file.primitive({{"POSITION", declared(5126, 4, "VEC3")},
                                    {"TEXCOORD_0", declared(5126, 4, "VEC2")},
                                    {"COLOR_0", declared(5121, 4, "VEC4", true)}});
  primitive["indices"] = declared(5123, 6, "SCALAR");
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", file.view(data)}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"COLOR_0", 2}}}};
  file.root["extensionsUsed"] = file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return file;
}

// A view compressed by meshoptimizer, with a fallback buffer that has no data.
inline int meshoptView(GltfFile& file, const std::vector<unsigned char>& data, std::size_t count, std::size_t stride,
                       const char* mode, const char* filter = nullptr) {
  json compressed = {{"buffer", 0},    {"byteOffset", 0},      {"byteLength", data.size()},
                     {"count", count}, {"byteStride", stride}, {"mode", mode}};
  if (filter) compressed["filter"] = filter;
  file.buffer.resize((file.buffer.size() + 3) / 4 * 4);
  compressed["byteOffset"] = file.buffer.size();
  file.buffer.append(data.begin(), data.end());
  json view = {{"buffer", 1}, {"byteLength", count * stride}};
  if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
  view["extensions"]["EXT_meshopt_compression"] = std::move(compressed);
  return file.add("bufferViews", std::move(view));
}

template <class T>
std::vector<unsigned char> encodeVertices(const std::vector<T>& values, std::size_t stride) {
  const std::size_t count = values.size() * sizeof(T) / stride;
  std::vector<unsigned char> data(meshopt_encodeVertexBufferBound(count, stride));
  data.resize(meshopt_encodeVertexBuffer(data.data(), data.size(), values.data(), count, stride));
  return data;
}

inline int accessorOf(GltfFile& file, int view, int type, std::size_t count, const char* kind,
                      bool normalized = false) {
  return file.add(
      "accessors",
      {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", kind}, {"normalized", normalized}});
}

// The .gltf of a file with a second buffer that only its compressed views fill.
inline std::string withFallback(GltfFile file) {
  const std::string binary = std::exchange(file.buffer, "");
  file.root["buffers"] = {
      {{"byteLength", binary.size()}, {"uri", "data:application/octet-stream;base64," + base64(binary)}},
      {{"byteLength", 4096}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  file.root["extensionsUsed"] = file.root["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  return file.root.dump();
}

}  // namespace halfsilver::testing
