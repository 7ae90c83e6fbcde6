#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/image.h"
#include "scene/scene.h"

// Images in and out. stb reads and writes PNG and reads JPEG and HDR, tinyexr writes EXR. OpenImageIO, where the
// project is built with it, reads EXR and all other formats and compares perceptually; because its 260 shared libraries
// cost a quarter of a second to load, it sits in a module that is opened on first use (see openimageio_module.h).
// Without it tinyexr reads EXR, too.
namespace halfsilver {

struct ImageFile {
  // Channels have the file's names; a picture without names has R G B A, or Y A for grey.
  Image image;
  bool linear = false;  // EXR and HDR: linear radiance. Otherwise display values 0..1, as stored.
  // Attribute "halfsilver:diagonal" of a layers file: the scene's diagonal in metres.
  std::optional<double> diagonal;
};

// Throws Error (badInput) with one line when the file is missing, does not decode or is larger than 2^30 values.
ImageFile readImage(const std::filesystem::path& file);

// 8-bit RGBA, rows from the top. `rgba` holds width * height * 4 bytes.
std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> rgba);

// All channels as 32-bit floats under their names, ZIP-compressed; `diagonal` as above.
// Throws Error (failed) where the format cannot hold the image.
std::vector<std::byte> encodeExr(const Image& image, std::optional<double> diagonal = {});

// Reads an equirectangular image (HDR, EXR; a display format is linearized) as the sky's. Errors as readImage.
// Returns how many values had to be brought into 0..65504: not a number, negative or brighter.
std::size_t readSky(const std::filesystem::path& file, Sky& sky);

struct PerceptualDifference {
  std::uint64_t failures = 0;  // pixels
  double fraction = 0;         // of all pixels
};

// OpenImageIO's comparison after Yee et al. 2001, with its own defaults, on RGB values as they are. Both images have
// the same size and the channels R G B. Nothing where OpenImageIO is not at hand.
std::optional<PerceptualDifference> comparePerceptually(const Image& image, const Image& reference);

}  // namespace halfsilver
