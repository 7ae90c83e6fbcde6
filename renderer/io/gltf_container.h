#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "io/gltf_document.h"

// What is around the JSON of a glTF file: the chunks of a .glb, buffers and images in files or in data URIs.
namespace halfsilver::gltf {

struct Chunks {
  std::string_view json;
  std::optional<std::span<const std::uint8_t>> binary;  // the first BIN chunk, which may be empty or absent
};

// The chunks of a .glb whose header and chunks fit the file; those of unknown types are skipped. Throws through
// `diagnostics`.
Chunks splitBinary(std::span<const std::uint8_t> bytes, const Diagnostics& diagnostics);

// Moves buffers and images from the JSON, which has been checked, into the document: the parser need not know where
// they are. A buffer without a URI that is not the binary chunk stays empty: an extension may fill its views.
void takeResources(nlohmann::json& root, const Chunks& chunks, const std::filesystem::path& folder, Document& document,
                   const Diagnostics& diagnostics);

}  // namespace halfsilver::gltf
