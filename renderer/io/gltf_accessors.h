#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/gltf_document.h"

// The contents of buffers, checked against the buffers' ends.
namespace halfsilver::gltf {

struct Floats {
  int components = 0;  // per element
  std::vector<float> values;
  std::size_t count() const { return values.size() / static_cast<std::size_t>(components); }
};

// Throws through `diagnostics` unless the view is inside its buffer; `place` names it.
std::span<const std::uint8_t> bytesOf(const Document& document, const Diagnostics& diagnostics, const BufferView& view,
                                      const std::string& place);
std::span<const std::uint8_t> viewBytes(const Document& document, const Diagnostics& diagnostics, int view,
                                        const std::string& where);

// Any component type; normalized integers become -1..1 or 0..1, others keep their value. Throws through `diagnostics`
// if an element does not have `minComponents` to `maxComponents` components.
Floats readFloats(const Document& document, Diagnostics& diagnostics, int index, int minComponents, int maxComponents,
                  const std::string& where);

// Unsigned integers of any width, `components` per element.
std::vector<std::uint32_t> readUnsigned(const Document& document, Diagnostics& diagnostics, int index, int components,
                                        const std::string& where);

}  // namespace halfsilver::gltf
