#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include <halfsilver/scene.h>

// The encoded images of glTF files.
namespace halfsilver::gltf {

enum class ImageFormat { unknown, png, jpeg, webp, avif };

struct ImageHeader {
  ImageFormat format = ImageFormat::unknown;
  glm::uvec2 size{0};  // as the file declares it
};

ImageHeader imageHeader(std::span<const std::uint8_t> bytes);

// AVIF takes OpenImageIO.
bool canDecode(ImageFormat format);

// Decodes into RGBA8 of the declared size; false if it does not decode.
bool decodeImage(const ImageHeader& header, std::span<const std::uint8_t> bytes, Texture& texture);

}  // namespace halfsilver::gltf
