#pragma once

#include <string_view>

#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Checks the JSON of a glTF file before the parser sees it, which trusts it: nesting, the version, extensions,
// lists that hold objects, indices and sizes that are whole numbers in range. Throws through `diagnostics`.
// Returns the lengths that the buffers in files of their own declare, in bytes and in order.
std::vector<std::size_t> checkJson(std::string_view text, bool binary, Diagnostics& diagnostics);

// The JSON chunk of a .glb whose header and chunks fit the file.
std::string_view checkBinary(std::span<const std::uint8_t> bytes, const Diagnostics& diagnostics);

}  // namespace halfsilver::gltf
