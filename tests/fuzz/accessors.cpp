// An accessor, plain or sparse, over a small buffer: the numbers that the specification's words give, read in the
// simplest way, or one line. The input begins with the accessor's numbers (Layout); what follows is the buffer.
#include <cmath>
#include <cstring>
#include <optional>

#include "expect.h"
#include "io/gltf_accessors.h"

namespace halfsilver::fuzz {
namespace {

using gltf::Accessor;
using gltf::Document;

// Numbers of one or two bytes, so that most of them are near what they stand beside.
class Layout {
 public:
  Layout(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::size_t byte() { return at_ < size_ ? data_[at_++] : 0; }
  std::size_t word() {
    const std::size_t low = byte();
    return low | byte() << 8;
  }
  // A size; now and then one near the end of what fits in 64 bits.
  std::size_t length() {
    const std::size_t value = word();
    return value < 0xff00 ? value : ~std::size_t{0} - (value & 0xff);
  }
  std::vector<std::uint8_t> rest() const { return {data_ + at_, data_ + size_}; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

Document makeDocument(const std::uint8_t* data, std::size_t size) {
  Layout layout(data, size);
  Document document;
  const auto type = [&] { return 5119 + static_cast<int>(layout.byte() % 9); };
  const auto view = [&] { return static_cast<int>(layout.byte() % 6) - 1; };
  for (int v = 0; v < 3; ++v) {
    gltf::BufferView& added = document.views.emplace_back();
    added.buffer = static_cast<int>(layout.byte() % 4) == 3 ? 1 : 0;
    added.offset = layout.length();
    added.length = layout.length();
    added.stride = layout.byte();
  }
  Accessor accessor;
  accessor.view = view();
  accessor.offset = layout.length();
  accessor.count = layout.length();
  accessor.componentType = type();
  accessor.components = static_cast<int>(layout.byte() % 17);
  accessor.normalized = layout.byte() % 2;
  if (layout.byte() % 4) {
    gltf::Sparse& sparse = accessor.sparse.emplace();
    sparse.count = layout.length();
    sparse.indexView = view();
    sparse.indexType = type();
    sparse.valueView = view();
    sparse.indexOffset = layout.length();
    sparse.valueOffset = layout.length();
  }
  document.accessors.push_back(accessor);
  document.buffers.push_back(layout.rest());
  return document;
}

std::size_t bytesOf(int type) { return type <= 5121 ? 1 : type <= 5123 ? 2 : 4; }

// One component; nothing if any byte is outside its view or its view is outside the buffer.
std::optional<double> component(const Document& document, int view, std::size_t offset, std::size_t stride, int type,
                                bool normalized, std::size_t element, std::size_t index) {
  const gltf::BufferView& source = document.views.at(static_cast<std::size_t>(view));
  const std::vector<std::uint8_t>& buffer = document.buffers.at(static_cast<std::size_t>(source.buffer));
  const std::size_t at = offset + element * (source.stride ? source.stride : stride) + index * bytesOf(type);
  if (at + bytesOf(type) > source.length || source.offset + at + bytesOf(type) > buffer.size()) return std::nullopt;
  std::uint32_t bits = 0;
  for (std::size_t b = 0; b < bytesOf(type); ++b)
    bits |= static_cast<std::uint32_t>(buffer[source.offset + at + b]) << (8 * b);
  float real = 0;
  std::memcpy(&real, &bits, 4);
  switch (type) {
    case 5120:
      return normalized ? std::max(static_cast<std::int8_t>(bits) / 127.0, -1.0) : static_cast<std::int8_t>(bits);
    case 5121:
      return normalized ? bits / 255.0 : bits;
    case 5122:
      return normalized ? std::max(static_cast<std::int16_t>(bits) / 32767.0, -1.0) : static_cast<std::int16_t>(bits);
    case 5123:
      return normalized ? bits / 65535.0 : bits;
    case 5125:
      return normalized ? bits / 4294967295.0 : bits;
    default:
      return real;
  }
}

bool same(double a, double b) {
  return static_cast<float>(a) == static_cast<float>(b) || (std::isnan(a) && std::isnan(b));
}

void expectSame(const Document& document, const gltf::Floats& read) {
  const Accessor& accessor = document.accessors.front();
  const auto components = static_cast<std::size_t>(accessor.components);
  expect(read.values.size() == accessor.count * components, "another number of values");
  const std::size_t stride = components * bytesOf(accessor.componentType);
  std::vector<double> expected(read.values.size());
  const auto value = [&](int view, std::size_t offset, std::size_t element, std::size_t c) {
    const auto found =
        component(document, view, offset, stride, accessor.componentType, accessor.normalized, element, c);
    expect(found.has_value(), "was read from outside of its view");
    return found.value();
  };
  for (std::size_t i = 0; accessor.view >= 0 && i < expected.size(); ++i)
    expected[i] = value(accessor.view, accessor.offset, i / components, i % components);
  if (accessor.sparse)
    for (std::size_t s = 0; s < accessor.sparse->count; ++s) {
      const gltf::Sparse& sparse = *accessor.sparse;
      const auto index = component(document, sparse.indexView, sparse.indexOffset, bytesOf(sparse.indexType),
                                   sparse.indexType, false, s, 0);
      expect(index && *index < static_cast<double>(accessor.count), "a sparse index out of range");
      for (std::size_t c = 0; c < components; ++c)
        expected[static_cast<std::size_t>(*index) * components + c] = value(sparse.valueView, sparse.valueOffset, s, c);
    }
  for (std::size_t i = 0; i < expected.size(); ++i)
    expect(same(read.values[i], expected[i]), "another value at " + std::to_string(i));
}

}  // namespace
}  // namespace halfsilver::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfsilver;
  const gltf::Document document = fuzz::makeDocument(data, size);
  gltf::Diagnostics diagnostics;
  diagnostics.file = "scene.glb";
  try {
    fuzz::expectSame(document, gltf::readFloats(document, diagnostics, 0, 1, 16, "accessor"));
    const int components = document.accessors.front().components;
    gltf::readUnsigned(document, diagnostics, 0, components, "accessor");
  } catch (const Error& error) {
    fuzz::expectRefusal(error, diagnostics.file);
  }
  return 0;
}
