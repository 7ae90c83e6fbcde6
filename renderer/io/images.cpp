#include <halfsilver/io.h>

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <string>

#include <halfsilver/error.h>
#include "io/openimageio.h"
#include "io/openimageio_module.h"
#include "io/small_codecs.h"

namespace halfsilver {
namespace {

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& what) {
  throw Error(ErrorKind::badInput, file.string() + ": " + what);
}

struct OpenImageIo {
  OpenImageIoRead* read = nullptr;
  OpenImageIoCompare* compare = nullptr;
};

// Found next to the program or in the linker's search path. Stays loaded: its libraries cannot be unloaded safely.
const OpenImageIo& openImageIo() {
  static const OpenImageIo functions = [] {
    OpenImageIo found;
    if constexpr (HALFSILVER_OPENIMAGEIO) {
      if (void* module = dlopen(kOpenImageIoModule, RTLD_NOW | RTLD_LOCAL)) {
        found.read = reinterpret_cast<OpenImageIoRead*>(dlsym(module, kReadFunction));
        found.compare = reinterpret_cast<OpenImageIoCompare*>(dlsym(module, kCompareFunction));
      }
    }
    return found;
  }();
  return functions;
}

std::vector<std::uint8_t> readBytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) reject(file, "no such file");
  if (!std::filesystem::is_regular_file(status)) reject(file, "not a regular file");
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(std::filesystem::file_size(file, error));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (error || !stream) reject(file, "cannot be read");
  return bytes;
}

float linearFromDisplay(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

ImageFile readImage(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = readBytes(file);
  ImageFile result;
  std::string problem;
  try {
    const bool read = knowsFormat(bytes) || !openImageIo().read ? decodeSmall(bytes, result, problem)
                                                                : openImageIo().read(file.string(), result, problem);
    if (!read) reject(file, problem.empty() ? "does not decode" : problem);
  } catch (const std::bad_alloc&) {
    reject(file, "too large for this machine's memory");
  }
  return result;
}

bool hasOpenImageIo() { return openImageIo().read != nullptr; }

bool decodeWithOpenImageIo(std::span<const std::uint8_t> bytes, const char* extension, ImageFile& result) {
  if (!hasOpenImageIo()) return false;
  std::string name = (std::filesystem::temp_directory_path() / "halfsilver-XXXXXX.").string() + extension;
  const int descriptor = mkstemps(name.data(), static_cast<int>(std::strlen(extension)) + 1);
  if (descriptor < 0) return false;
  close(descriptor);
  std::ofstream(name, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::string problem;
  const bool read = openImageIo().read(name, result, problem);
  std::error_code ignored;
  std::filesystem::remove(name, ignored);
  return read;
}

std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> rgba) {
  std::vector<std::byte> bytes = encodeSmallPng(width, height, rgba);
  if (bytes.empty()) throw Error(ErrorKind::failed, "the picture cannot be encoded as PNG");
  return bytes;
}

std::vector<std::byte> encodeExr(const Image& image, std::optional<double> diagonal) {
  std::vector<std::byte> bytes;
  std::string problem;
  if (!encodeSmallExr(image, diagonal, bytes, problem)) throw Error(ErrorKind::failed, "EXR: " + problem);
  return bytes;
}

std::size_t readSky(const std::filesystem::path& file, Sky& sky) {
  const ImageFile source = readImage(file);
  const Image& image = source.image;
  const int gray = image.channel("Y");
  const int channels[3] = {image.channel("R") < 0 ? gray : image.channel("R"),
                           image.channel("G") < 0 ? gray : image.channel("G"),
                           image.channel("B") < 0 ? gray : image.channel("B")};
  if (std::min({channels[0], channels[1], channels[2]}) < 0) reject(file, "a sky needs the channels R, G, B or Y");
  constexpr float kBrightest = 65504;  // the largest half float; the sky may be stored as such
  std::size_t repaired = 0;
  std::vector<float> texels(image.pixelCount() * 3);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const std::size_t index = i / 3 * image.channels.size() + static_cast<std::size_t>(channels[i % 3]);
    const float stored = source.linear ? image.data[index] : linearFromDisplay(image.data[index]);
    texels[i] = stored >= 0 ? std::min(stored, kBrightest) : 0;  // NaN becomes 0
    repaired += texels[i] != stored;
  }
  sky.imageWidth = image.width;
  sky.imageHeight = image.height;
  sky.image = std::move(texels);
  return repaired;
}

std::optional<PerceptualDifference> comparePerceptually(const Image& image, const Image& reference) {
  PerceptualDifference result;
  if (!openImageIo().compare || !openImageIo().compare(image, reference, result)) return std::nullopt;
  return result;
}

}  // namespace halfsilver
