#include "io/gltf_images.h"

#include <webp/decode.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "io/openimageio.h"
#include "io/small_codecs.h"

namespace halfsilver::gltf {
namespace {

std::uint32_t bigEndian(std::span<const std::uint8_t> bytes, std::size_t offset, std::size_t width) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < width; ++i) value = value << 8 | bytes[offset + i];
  return value;
}

// Walks the segments up to the frame header (ITU T.81, B.2.2).
glm::uvec2 jpegSize(std::span<const std::uint8_t> bytes) {
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    if (bytes[at] != 0xff) {
      ++at;
      continue;
    }
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xff || marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame) return {bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2)};
    at += 2 + bigEndian(bytes, at + 2, 2);
  }
  return glm::uvec2(0);
}

// The largest "ispe" box: a picture of tiles has one for each and one for the whole.
glm::uvec2 avifSize(std::span<const std::uint8_t> bytes) {
  constexpr char kBox[] = {'i', 's', 'p', 'e'};
  glm::uvec2 size(0);
  for (auto at = bytes.begin();;) {
    at = std::search(at, bytes.end(), std::begin(kBox), std::end(kBox));
    if (bytes.end() - at < 16) return size;
    const auto offset = static_cast<std::size_t>(at - bytes.begin());
    size = glm::max(size, glm::uvec2(bigEndian(bytes, offset + 8, 4), bigEndian(bytes, offset + 12, 4)));
    at += 4;
  }
}

bool decodeAvif(std::span<const std::uint8_t> bytes, Texture& texture) {
  ImageFile file;
  if (!decodeWithOpenImageIo(bytes, "avif", file)) return false;
  const Image& image = file.image;
  const int gray = image.channel("Y");
  const auto channel = [&](const char* name, int otherwise) {
    return image.channel(name) < 0 ? otherwise : image.channel(name);
  };
  const int channels[4] = {channel("R", gray), channel("G", gray), channel("B", gray), channel("A", -1)};
  if (std::min({channels[0], channels[1], channels[2]}) < 0) return false;
  texture.width = image.width;
  texture.height = image.height;
  texture.texels.assign(4 * image.pixelCount(), 255);
  for (std::size_t p = 0; p < image.pixelCount(); ++p)
    for (std::size_t c = 0; c < 4; ++c)
      if (channels[c] >= 0) {
        const float value = image.data[p * image.channels.size() + static_cast<std::size_t>(channels[c])];
        texture.texels[4 * p + c] = static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f);
      }
  return true;
}

struct FreedByWebp {
  void operator()(std::uint8_t* texels) const { WebPFree(texels); }
};

// A few bytes can be a very large image of one color, so no size is too much to claim: the library's own memory is not
// touched before there are texels for it.
bool decodeWebp(std::span<const std::uint8_t> bytes, Texture& texture) {
  const std::unique_ptr<std::uint8_t, FreedByWebp> texels(
      WebPDecodeRGBA(bytes.data(), bytes.size(), &texture.width, &texture.height));
  if (!texels) return false;
  texture.texels.assign(texels.get(), texels.get() + std::size_t{4} * static_cast<std::size_t>(texture.width) *
                                                         static_cast<std::size_t>(texture.height));
  return true;
}

}  // namespace

ImageHeader imageHeader(std::span<const std::uint8_t> bytes) {
  const auto has = [&](std::size_t at, std::string_view text) {
    return bytes.size() >= at + text.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
  };
  if (has(0, "\x89PNG\r\n\x1a\n") && bytes.size() >= 29)
    return {ImageFormat::png, {bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)}};
  if (has(0, "\xff\xd8")) {
    const glm::uvec2 size = jpegSize(bytes);
    return {size == glm::uvec2(0) ? ImageFormat::unknown : ImageFormat::jpeg, size};
  }
  int width = 0, height = 0;
  if (has(0, "RIFF") && has(8, "WEBP") && WebPGetInfo(bytes.data(), bytes.size(), &width, &height))
    return {ImageFormat::webp, glm::uvec2(width, height)};
  if (has(4, "ftypavif") || has(4, "ftypavis")) return {ImageFormat::avif, avifSize(bytes)};
  return {};
}

bool canDecode(ImageFormat format) { return format != ImageFormat::avif || hasOpenImageIo(); }

bool decodeImage(const ImageHeader& header, std::span<const std::uint8_t> bytes, Texture& texture) {
  const bool decoded = header.format == ImageFormat::webp   ? decodeWebp(bytes, texture)
                       : header.format == ImageFormat::avif ? decodeAvif(bytes, texture)
                                                            : decodeRgba(bytes, texture);
  return decoded && texture.width > 0 && texture.height > 0 &&
         glm::uvec2(texture.width, texture.height) == header.size &&
         texture.texels.size() ==
             std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
}

}  // namespace halfsilver::gltf
