#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/io.h>

// The codecs that are always available: stb for PNG, JPEG and HDR, tinyexr for scanline EXR.
namespace halfsilver {

// Whether the bytes begin like a PNG, JPEG or HDR file, which stb reads completely. (OpenImageIO reads them too, but
// its libraries print their own errors.)
bool knowsFormat(std::span<const std::uint8_t> bytes);

// Whether the bytes of a PNG or JPEG are enough for so many pixels, so that no memory is taken for a claim; true of
// other formats.
bool canHold(std::span<const std::uint8_t> bytes, double pixels);

// False with one line in `problem` when the bytes do not decode.
bool decodeSmall(std::span<const std::uint8_t> bytes, ImageFile& result, std::string& problem);

// PNG or JPEG as 8-bit RGBA, 16 bits rounded; false if the bytes do not decode.
bool decodeRgba(std::span<const std::uint8_t> bytes, Texture& texture);

// Empty when the library refuses.
std::vector<std::byte> encodeSmallPng(int width, int height, std::span<const std::uint8_t> rgba);

// Sorts the channels by name, as the format requires. False with one line in `problem`.
bool encodeSmallExr(const Image& image, std::optional<double> diagonal, std::vector<std::byte>& bytes,
                    std::string& problem);

}  // namespace halfsilver
