#pragma once

#include <halfsilver/io.h>

namespace halfsilver::gltf {

// As loadGltf(), of a file's bytes. `file` is its name in messages; what it refers to is read from its folder.
Model loadBytes(std::span<const std::uint8_t> bytes, const std::filesystem::path& file, const GltfOptions& options);

}  // namespace halfsilver::gltf
