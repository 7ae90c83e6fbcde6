#pragma once

#include <string_view>

#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Checks the JSON of a glTF file before the parser, which trusts it, sees it: nesting, version, extensions, that lists
// contain objects, that indices and sizes are whole numbers in range. Throws through `diagnostics`.
// Returns the declared lengths of the buffers stored in separate files, in bytes and in order.
std::vector<std::size_t> checkJson(std::string_view text, bool binary, Diagnostics& diagnostics);

// The JSON chunk of a .glb whose header and chunks fit the file.
std::string_view checkBinary(std::span<const std::uint8_t> bytes, const Diagnostics& diagnostics);

}  // namespace halfsilver::gltf
