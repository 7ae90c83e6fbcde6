#pragma once

#include <cstdint>
#include <span>

#include <halfsilver/io.h>

// What the module halfsilver_openimageio reads beside whole files of its own.
namespace halfsilver {

// Whether the module is there.
bool hasOpenImageIo();

// Decodes bytes in a format by its file extension, through a temporary file: not every format can be read from memory.
// False if they do not decode.
bool decodeWithOpenImageIo(std::span<const std::uint8_t> bytes, const char* extension, ImageFile& result);

}  // namespace halfsilver
