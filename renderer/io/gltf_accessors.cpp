#include "io/gltf_accessors.h"

#include <algorithm>
#include <cstring>

namespace halfsilver::gltf {
namespace {

constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
              kFloat = 5126;

std::size_t componentBytes(int type, const Diagnostics& diagnostics, const std::string& where) {
  switch (type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      diagnostics.fail("has the unknown component type " + std::to_string(type), where);
  }
}

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

double real(const std::uint8_t* bytes, int type, bool normalized) {
  const auto scaled = [normalized](double value, double largest) {
    return normalized ? std::max(value / largest, -1.0) : value;
  };
  switch (type) {
    case kByte:
      return scaled(load<std::int8_t>(bytes), 127);
    case kUnsignedByte:
      return scaled(*bytes, 255);
    case kShort:
      return scaled(load<std::int16_t>(bytes), 32767);
    case kUnsignedShort:
      return scaled(load<std::uint16_t>(bytes), 65535);
    case kUnsignedInt:
      return scaled(load<std::uint32_t>(bytes), 4294967295.0);
    default:
      return load<float>(bytes);
  }
}

std::uint32_t unsignedInteger(const std::uint8_t* bytes, int type) {
  if (type == kUnsignedByte) return *bytes;
  return type == kUnsignedShort ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
}

bool isUnsigned(int type) { return type == kUnsignedByte || type == kUnsignedShort || type == kUnsignedInt; }

// The bytes of `count` elements, the last of which ends inside the view.
struct Elements {
  const std::uint8_t* first = nullptr;
  std::size_t stride = 0;
  const std::uint8_t* at(std::size_t index) const { return first + index * stride; }
};

Elements elements(const Document& document, const Diagnostics& diagnostics, int view, std::size_t offset,
                  std::size_t count, std::size_t elementBytes, const std::string& where) {
  const std::span<const std::uint8_t> bytes = viewBytes(document, diagnostics, view, where);
  const std::size_t declared = document.views[static_cast<std::size_t>(view)].stride;
  const std::size_t stride = declared ? declared : elementBytes;
  if (stride < elementBytes) diagnostics.fail("has a byteStride shorter than its elements", where);
  if (count && (offset > bytes.size() || elementBytes > bytes.size() - offset ||
                count - 1 > (bytes.size() - offset - elementBytes) / stride))
    diagnostics.fail("ends beyond " + item("bufferViews", static_cast<std::size_t>(view)), where);
  return {bytes.data() + std::min(offset, bytes.size()), stride};
}

std::size_t allBytes(const Document& document) {
  std::size_t total = 0;
  for (const auto& buffer : document.buffers) total += buffer.size();
  return total;
}

// Visits the bytes of every element in order, with sparse elements replaced. An accessor without a view is all zeros;
// it cannot have more of them than the file has bytes, since they accompany stored data.
template <class Store>
void visit(const Document& document, Diagnostics& diagnostics, const Accessor& accessor, const std::string& where,
           const Store& store) {
  const std::size_t elementBytes =
      componentBytes(accessor.componentType, diagnostics, where) * static_cast<std::size_t>(accessor.components);
  if (accessor.view >= 0) {
    const Elements source =
        elements(document, diagnostics, accessor.view, accessor.offset, accessor.count, elementBytes, where);
    for (std::size_t i = 0; i < accessor.count; ++i) store(i, source.at(i));
  }
  if (!accessor.sparse) return;
  const Sparse& sparse = *accessor.sparse;
  if (!isUnsigned(sparse.indexType)) diagnostics.fail("has sparse indices of a wrong component type", where);
  if (sparse.count > accessor.count) diagnostics.fail("has more sparse elements than elements", where);
  const Elements indices = elements(document, diagnostics, sparse.indexView, sparse.indexOffset, sparse.count,
                                    componentBytes(sparse.indexType, diagnostics, where), where + ".sparse.indices");
  const Elements values = elements(document, diagnostics, sparse.valueView, sparse.valueOffset, sparse.count,
                                   elementBytes, where + ".sparse.values");
  for (std::size_t i = 0; i < sparse.count; ++i) {
    const std::uint32_t index = unsignedInteger(indices.at(i), sparse.indexType);
    if (index >= accessor.count) diagnostics.fail("has a sparse index beyond its end", where);
    store(index, values.at(i));
  }
}

const Accessor& checked(const Document& document, Diagnostics& diagnostics, int index, int minComponents,
                        int maxComponents, const std::string& where) {
  const Accessor& accessor = get(document.accessors, index, "accessors", diagnostics, where);
  if (accessor.components < minComponents || accessor.components > maxComponents)
    diagnostics.fail("has elements of a wrong type", where);
  if (accessor.count == 0) diagnostics.fail("has no elements", where);
  if (accessor.view < 0 && accessor.count > allBytes(document))
    diagnostics.fail("declares " + std::to_string(accessor.count) + " elements without data", where);
  if (accessor.view >= 0)  // before anything is allocated for it
    elements(document, diagnostics, accessor.view, accessor.offset, accessor.count,
             componentBytes(accessor.componentType, diagnostics, where) * static_cast<std::size_t>(accessor.components),
             where);
  diagnostics.spend(accessor.count * static_cast<std::size_t>(accessor.components), where);
  return accessor;
}

std::string named(const std::string& where, int accessor) {
  return where + " (accessors[" + std::to_string(accessor) + "])";
}

}  // namespace

std::span<const std::uint8_t> bytesOf(const Document& document, const Diagnostics& diagnostics, const BufferView& view,
                                      const std::string& place) {
  const auto& buffer = get(document.buffers, view.buffer, "buffers", diagnostics, place);
  const std::string name = item("buffers", static_cast<std::size_t>(view.buffer));
  if (buffer.empty() && view.length > 0) diagnostics.fail("has no data", name);
  if (view.offset > buffer.size() || view.length > buffer.size() - view.offset)
    diagnostics.fail("ends beyond " + name, place);
  return std::span<const std::uint8_t>(buffer).subspan(view.offset, view.length);
}

std::span<const std::uint8_t> viewBytes(const Document& document, const Diagnostics& diagnostics, int view,
                                        const std::string& where) {
  const BufferView& source = get(document.views, view, "bufferViews", diagnostics, where);
  return bytesOf(document, diagnostics, source, item("bufferViews", static_cast<std::size_t>(view)));
}

Floats readFloats(const Document& document, Diagnostics& diagnostics, int index, int minComponents, int maxComponents,
                  const std::string& where) {
  const std::string place = named(where, index);
  const Accessor& accessor = checked(document, diagnostics, index, minComponents, maxComponents, place);
  const auto components = static_cast<std::size_t>(accessor.components);
  const std::size_t bytes = componentBytes(accessor.componentType, diagnostics, place);
  Floats result;
  result.components = accessor.components;
  result.values.resize(accessor.count * components);
  visit(document, diagnostics, accessor, place, [&](std::size_t element, const std::uint8_t* source) {
    for (std::size_t c = 0; c < components; ++c)
      result.values[element * components + c] =
          static_cast<float>(real(source + c * bytes, accessor.componentType, accessor.normalized));
  });
  return result;
}

std::vector<std::uint32_t> readUnsigned(const Document& document, Diagnostics& diagnostics, int index, int components,
                                        const std::string& where) {
  const std::string place = named(where, index);
  const Accessor& accessor = checked(document, diagnostics, index, components, components, place);
  if (!isUnsigned(accessor.componentType))
    diagnostics.fail("has the wrong component type, not unsigned integers", place);
  const std::size_t bytes = componentBytes(accessor.componentType, diagnostics, place);
  const auto width = static_cast<std::size_t>(components);
  std::vector<std::uint32_t> result(accessor.count * width);
  visit(document, diagnostics, accessor, place, [&](std::size_t element, const std::uint8_t* source) {
    for (std::size_t c = 0; c < width; ++c)
      result[element * width + c] = unsignedInteger(source + c * bytes, accessor.componentType);
  });
  return result;
}

}  // namespace halfsilver::gltf
