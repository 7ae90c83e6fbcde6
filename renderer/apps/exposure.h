#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <halfsilver/image.h>

// How bright a picture is shown.
namespace halfsilver {

// `--exposure`: stops as image.exposure has them, nothing for "auto". Throws Error (usage).
std::optional<float> parseExposure(const std::string& text);

// Stops that bring the mean of a frame's layers (of the logarithms of luminances above 0) to a middle gray, and at
// least 19 of 20 pixels below white. Nothing if the picture is black.
std::optional<float> automaticExposure(const Image& layers);

// Of 8-bit RGBA.
double shareOfWhite(std::span<const std::uint8_t> rgba);

// A hint for a picture of which this much is white; empty if that is little.
std::string whiteHint(double share);

}  // namespace halfsilver
