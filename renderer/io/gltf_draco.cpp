#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <cstring>

#include "io/gltf_accessors.h"
#include "io/gltf_decompress.h"

namespace halfsilver::gltf {
namespace {

constexpr int kFloat = 5126, kUnsignedInt = 5125;

// glTF's number for a component type; 0: there is none, and floats must do.
int componentType(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return 5120;
    case draco::DT_UINT8:
      return 5121;
    case draco::DT_INT16:
      return 5122;
    case draco::DT_UINT16:
      return 5123;
    case draco::DT_UINT32:
      return kUnsignedInt;
    case draco::DT_FLOAT32:
      return kFloat;
    default:
      return 0;
  }
}

template <class T>
void append(std::vector<std::uint8_t>& bytes, const T* values, std::size_t count) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(values);
  bytes.insert(bytes.end(), first, first + count * sizeof(T));
}

class Primitives {
 public:
  Primitives(Document& document, Diagnostics& diagnostics) : document_(document), diagnostics_(diagnostics) {}

  void expand(Primitive& primitive, const std::string& where) {
    const std::unique_ptr<draco::Mesh> mesh = decode(*primitive.draco, where);
    std::vector<std::uint8_t> indices;
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f)
      for (const draco::PointIndex& point : mesh->face(f)) {
        const std::uint32_t index = point.value();
        append(indices, &index, 1);
      }
    primitive.indices = add(
        {addView(document_, std::move(indices), 0), 0, std::size_t{3} * mesh->num_faces(), kUnsignedInt, 1, false, {}});
    if (primitive.mode == 5) primitive.mode = 4;  // what is decoded are triangles, whatever was compressed
    for (const auto& [name, id] : primitive.draco->attributes) {
      const auto declared = primitive.attributes.find(name);
      if (declared == primitive.attributes.end()) continue;
      const bool normalized =
          get(document_.accessors, declared->second, "accessors", diagnostics_, where + "." + name).normalized;
      declared->second = attribute(*mesh, id, normalized, where + "." + name);
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& where) const {
    diagnostics_.fail("KHR_draco_mesh_compression has " + what, where);
  }

  // The counts that the data begins with, before memory is taken for them.
  void checkCounts(std::span<const std::uint8_t> bytes, const std::string& where) const {
    constexpr std::uint64_t kLargestRatio = 1024, kSmall = 4096;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() || header.encoder_type != draco::TRIANGULAR_MESH)
      refuse("data that is not a mesh", where);
    buffer.set_bitstream_version(static_cast<std::uint16_t>(header.version_major << 8 | header.version_minor));
    draco::GeometryMetadata metadata;
    if ((header.flags & METADATA_FLAG_MASK) && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
      refuse("metadata that does not decode", where);
    const bool varied = buffer.bitstream_version() >= 0x0202;
    const auto read = [&](std::uint32_t& value) {
      return varied ? draco::DecodeVarint(&value, &buffer) : buffer.Decode(&value);
    };
    std::uint8_t traversal = 0;
    std::uint32_t first = 0, second = 0;  // faces and points in one order or the other
    const bool edges = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
    if ((edges && !buffer.Decode(&traversal)) || !read(first) || !read(second)) refuse("data that ends early", where);
    const std::uint64_t limit = kSmall + kLargestRatio * bytes.size();
    if (first > limit || second > limit) refuse("counts that its bytes cannot hold", where);
    diagnostics_.require(std::uint64_t{3} * std::max(first, second), where);
  }

  std::unique_ptr<draco::Mesh> decode(const DracoSource& source, const std::string& where) const {
    const std::span<const std::uint8_t> bytes = viewBytes(document_, diagnostics_, source.view, where);
    checkCounts(bytes, where);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok() || !decoded.value()) refuse("data that does not decode", where);
    return std::move(decoded).value();
  }

  int attribute(const draco::Mesh& mesh, int id, bool normalized, const std::string& where) {
    const draco::PointAttribute* source =
        id < 0 ? nullptr : mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    if (!source) refuse("no attribute " + std::to_string(id), where);
    const int components = source->num_components();
    const std::size_t count = mesh.num_points();
    diagnostics_.require(count * static_cast<std::size_t>(components), where);
    const int type = componentType(source->data_type());
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint8_t> raw(static_cast<std::size_t>(source->byte_stride()));
    std::vector<float> converted(static_cast<std::size_t>(components));
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
      const draco::AttributeValueIndex value = source->mapped_index(point);
      if (value.value() >= source->size()) refuse("points without a value", where);
      if (type) {
        source->GetValue(value, raw.data());
        append(bytes, raw.data(), raw.size());
      } else {
        if (!source->ConvertValue<float>(value, static_cast<std::int8_t>(components), converted.data()))
          refuse("values that are not numbers", where);
        append(bytes, converted.data(), converted.size());
      }
    }
    return add({addView(document_, std::move(bytes), 0),
                0,
                count,
                type ? type : kFloat,
                components,
                type != kFloat && type != 0 && normalized,
                {}});
  }

  int add(const Accessor& accessor) {
    document_.accessors.push_back(accessor);
    return static_cast<int>(document_.accessors.size()) - 1;
  }

  Document& document_;
  Diagnostics& diagnostics_;
};

}  // namespace

void expandDraco(Document& document, Diagnostics& diagnostics) {
  Primitives primitives(document, diagnostics);
  for (std::size_t m = 0; m < document.meshes.size(); ++m)
    for (std::size_t p = 0; p < document.meshes[m].primitives.size(); ++p)
      if (Primitive& primitive = document.meshes[m].primitives[p]; primitive.draco)
        primitives.expand(primitive, item("meshes", m) + "." + item("primitives", p));
}

}  // namespace halfsilver::gltf
