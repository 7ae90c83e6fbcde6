#include "io/small_codecs.h"

#include <tinyexr.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <string_view>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_HDR
#include <stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

#include "io/one_line.h"

namespace halfsilver {
namespace {

constexpr const char* kDiagonal = "halfsilver:diagonal";
constexpr double kMaxValues = 1 << 30;
constexpr double kDeflate = 1032;  // bytes that it makes of one, at most

struct Freed {
  void operator()(void* memory) const { std::free(memory); }
};

std::string takeMessage(const char* message, const char* otherwise) {
  std::string text = message ? message : otherwise;
  if (message) FreeEXRErrorMessage(message);
  return text.substr(0, text.find('\n'));
}

bool isExr(std::span<const std::uint8_t> bytes) {
  const std::uint8_t magic[] = {0x76, 0x2f, 0x31, 0x01};
  return bytes.size() > 8 && std::equal(std::begin(magic), std::end(magic), bytes.begin());
}

struct ExrHeader : EXRHeader {
  ExrHeader() { InitEXRHeader(this); }
  ~ExrHeader() { FreeEXRHeader(this); }
  ExrHeader(const ExrHeader&) = delete;
  ExrHeader& operator=(const ExrHeader&) = delete;
};

struct ExrImage : EXRImage {
  ExrImage() { InitEXRImage(this); }
  ~ExrImage() { FreeEXRImage(this); }
  ExrImage(const ExrImage&) = delete;
  ExrImage& operator=(const ExrImage&) = delete;
};

bool decodeExr(std::span<const std::uint8_t> bytes, ImageFile& result, std::string& problem) {
  EXRVersion version;
  if (ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size()) != TINYEXR_SUCCESS || version.multipart ||
      version.non_image || version.tiled) {
    problem = "only flat scanline EXR files can be read without OpenImageIO";
    return false;
  }
  ExrHeader header;
  const char* message = nullptr;
  if (ParseEXRHeaderFromMemory(&header, &version, bytes.data(), bytes.size(), &message) != TINYEXR_SUCCESS) {
    problem = takeMessage(message, "not a valid EXR header");
    return false;
  }
  const double columns = double(header.data_window.max_x) - header.data_window.min_x + 1;
  const double rows = double(header.data_window.max_y) - header.data_window.min_y + 1;
  // A value has two bytes or more, and nothing packs closer than deflate.
  const double values = columns * rows * header.num_channels;
  if (columns < 1 || rows < 1 || values > kMaxValues || values > kDeflate / 2 * double(bytes.size())) {
    problem = "not an image of a usable size";
    return false;
  }
  for (int c = 0; c < header.num_channels; ++c) {
    if (header.channels[c].x_sampling != 1 || header.channels[c].y_sampling != 1) {
      problem = "subsampled channels can be read only with OpenImageIO";
      return false;
    }
    if (header.pixel_types[c] == TINYEXR_PIXELTYPE_HALF) header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
  }
  ExrImage decoded;
  if (LoadEXRImageFromMemory(&decoded, &header, bytes.data(), bytes.size(), &message) != TINYEXR_SUCCESS) {
    InitEXRImage(&decoded);  // the library has freed its memory but left the pointers
    problem = takeMessage(message, "the pixels do not decode");
    return false;
  }
  Image image{decoded.width, decoded.height, {}, {}};
  const auto channels = static_cast<std::size_t>(decoded.num_channels);
  image.data.resize(image.pixelCount() * channels);
  for (std::size_t c = 0; c < channels; ++c) {
    image.channels.emplace_back(header.channels[c].name);
    const bool whole = header.pixel_types[c] == TINYEXR_PIXELTYPE_UINT;
    for (std::size_t p = 0; p < image.pixelCount(); ++p) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, decoded.images[c] + 4 * p, 4);
      float value = static_cast<float>(bits);
      if (!whole) std::memcpy(&value, &bits, 4);
      image.data[p * channels + c] = value;
    }
  }
  for (int a = 0; a < header.num_custom_attributes; ++a) {
    const EXRAttribute& attribute = header.custom_attributes[a];
    if (std::strcmp(attribute.name, kDiagonal) != 0 || attribute.size != 4) continue;
    float value = 0;
    std::memcpy(&value, attribute.value, 4);
    result.diagonal = value;
  }
  result.image = std::move(image);
  result.linear = true;
  return true;
}

// stb takes the memory that a PNG's chunk asks for before it looks whether the chunk is there.
bool chunksFit(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kSignature = 8, kAround = 12;
  if (bytes.size() < kSignature || bytes[0] != 0x89) return true;  // no PNG
  for (std::size_t at = kSignature; at < bytes.size();) {
    if (bytes.size() - at < kAround) return false;
    const std::size_t length = std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
                               std::size_t{bytes[at + 2]} << 8 | std::size_t{bytes[at + 3]};
    if (length > bytes.size() - at - kAround) return false;
    if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return true;
    at += kAround + length;
  }
  return true;
}

// stb writes the Huffman tables of a JPEG without looking whether they have more codes than there are bytes: then they
// run over what lies behind them. Walks the segments as stb does (ITU T.81, B.2.4.2).
bool tablesFit(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kTables = 0xc4, kFirstBare = 0xd0, kEnd = 0xd9;
  const auto byteAt = [&](std::size_t at) { return at < bytes.size() ? bytes[at] : std::uint8_t{0}; };
  std::size_t start = 0;
  while (byteAt(start) == 0xff) ++start;                 // filling
  if (start == 0 || byteAt(start) != 0xd8) return true;  // no JPEG
  for (std::size_t at = start + 1; at < bytes.size();) {
    if (bytes[at++] != 0xff) continue;  // of a scan, or filling
    while (byteAt(at) == 0xff) ++at;
    const std::uint8_t marker = byteAt(at++);
    if (marker == kEnd) return true;
    if (marker <= 1 || (marker >= kFirstBare && marker < kEnd)) continue;  // without a segment
    const std::size_t length = std::size_t{byteAt(at)} << 8 | byteAt(at + 1);
    for (std::size_t table = at + 2; marker == kTables && table < at + length;) {
      std::size_t codes = 0;
      for (std::size_t i = 1; i <= 16; ++i) codes += byteAt(table + i);
      if (codes > 256) return false;
      table += 17 + codes;
    }
    at += std::max<std::size_t>(length, 2);
  }
  return true;
}

// stb reads on behind the end of an HDR file: rows that are cut off never end, or are what lay in memory. Walks them as
// stb does.
bool rowsFit(std::span<const std::uint8_t> bytes, std::size_t width, std::size_t height) {
  constexpr std::size_t kShortest = 8, kLongest = 32767;  // of a row that may be packed
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto nextLine = [&](std::size_t from) { return std::min(text.find('\n', from), text.size() - 1) + 1; };
  if (!text.starts_with("#?")) return true;  // no HDR
  std::size_t at = nextLine(0);
  while (at < text.size() && text[at] != '\n' && text[at] != '\0') at = nextLine(at);  // up to an empty line
  at = nextLine(nextLine(at));                                                         // and the one with the size
  const auto flat = [&] { return 4 * width * height <= bytes.size() - at; };
  if (width < kShortest || width > kLongest) return flat();
  for (std::size_t row = 0; row < height; ++row) {
    if (bytes.size() - at < 4) return false;
    if (bytes[at] != 2 || bytes[at + 1] != 2 || bytes[at + 2] >= 128) return flat();
    at += 4;
    for (std::size_t left = 4 * width, inChannel = width; left > 0; inChannel = inChannel ? inChannel : width) {
      if (at == bytes.size()) return false;
      const std::size_t code = bytes[at++], count = code > 128 ? code - 128 : code, stored = code > 128 ? 1 : code;
      if (count > inChannel) return true;  // stb refuses it
      if (stored > bytes.size() - at) return false;
      at += stored;
      inChannel -= count;
      left -= count;
    }
  }
  return true;
}

template <class T>
void takePixels(const T* pixels, float scale, Image& image) {
  image.data.resize(image.pixelCount() * image.channels.size());
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(pixels[i]) * scale;
}

bool decodeStb(std::span<const std::uint8_t> bytes, ImageFile& result, std::string& problem) {
  const auto* data = bytes.data();
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!chunksFit(bytes)) {
    problem = "the file is cut off";
    return false;
  }
  if (!tablesFit(bytes)) {
    problem = "not an image: a Huffman table has more codes than there are bytes";
    return false;
  }
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) {
    problem = oneLine(std::string("not an image: ") + stbi_failure_reason());
    return false;
  }
  const double count = double(width) * height;
  if (width < 1 || height < 1 || count * channels > kMaxValues || !canHold(bytes, count)) {
    problem = "not an image of a usable size";
    return false;
  }
  if (!rowsFit(bytes, static_cast<std::size_t>(width), static_cast<std::size_t>(height))) {
    problem = "the file is cut off";
    return false;
  }
  const bool hdr = stbi_is_hdr_from_memory(data, size);
  const bool deep = !hdr && stbi_is_16_bit_from_memory(data, size);
  std::unique_ptr<void, Freed> pixels;
  if (hdr)
    pixels.reset(stbi_loadf_from_memory(data, size, &width, &height, &channels, 0));
  else if (deep)
    pixels.reset(stbi_load_16_from_memory(data, size, &width, &height, &channels, 0));
  else
    pixels.reset(stbi_load_from_memory(data, size, &width, &height, &channels, 0));
  if (!pixels) {
    problem = oneLine(std::string("does not decode: ") + stbi_failure_reason());
    return false;
  }
  const std::vector<std::string> names[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  Image image{width, height, names[channels - 1], {}};
  if (hdr)
    takePixels(static_cast<const float*>(pixels.get()), 1, image);
  else if (deep)
    takePixels(static_cast<const std::uint16_t*>(pixels.get()), 1.0f / 65535, image);
  else
    takePixels(static_cast<const std::uint8_t*>(pixels.get()), 1.0f / 255, image);
  result.image = std::move(image);
  result.linear = hdr;
  return true;
}

}  // namespace

bool knowsFormat(std::span<const std::uint8_t> bytes) {
  const auto startsWith = [&](std::string_view magic) {
    return bytes.size() > magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
  };
  return startsWith("\x89PNG") || startsWith("\xff\xd8\xff") || startsWith("#?R");
}

bool canHold(std::span<const std::uint8_t> bytes, double pixels) {
  const double stored = double(bytes.size());
  if (bytes.size() >= 29 && bytes[0] == 0x89) {
    const std::uint8_t depth = bytes[24], color = bytes[25];  // of each of the channels that a color means
    const double bits = std::max<int>(depth, 1) * (color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1);
    return pixels * bits / 8 <= kDeflate * stored;
  }
  // A block of 8 x 8 takes at least a bit, even where refined in several scans.
  if (bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xd8) return pixels <= 8 * 64 * (stored + 8);
  return true;
}

bool decodeSmall(std::span<const std::uint8_t> bytes, ImageFile& result, std::string& problem) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    problem = "the file is larger than 2 GiB";
    return false;
  }
  return isExr(bytes) ? decodeExr(bytes, result, problem) : decodeStb(bytes, result, problem);
}

bool decodeRgba(std::span<const std::uint8_t> bytes, Texture& texture) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) || !chunksFit(bytes) ||
      !tablesFit(bytes))
    return false;
  const auto* data = bytes.data();
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  const auto take = [&](const auto* pixels, auto narrow) {
    texture.width = width;
    texture.height = height;
    texture.texels.resize(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::transform(pixels, pixels + texture.texels.size(), texture.texels.begin(), narrow);
  };
  if (stbi_is_16_bit_from_memory(data, size)) {
    const std::unique_ptr<stbi_us, Freed> pixels(
        stbi_load_16_from_memory(data, size, &width, &height, &channels, STBI_rgb_alpha));
    if (pixels) take(pixels.get(), [](stbi_us value) { return static_cast<std::uint8_t>((value + 128u) / 257u); });
    return pixels != nullptr;
  }
  const std::unique_ptr<stbi_uc, Freed> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, STBI_rgb_alpha));
  if (pixels) take(pixels.get(), [](stbi_uc value) { return value; });
  return pixels != nullptr;
}

std::vector<std::byte> encodeSmallPng(int width, int height, std::span<const std::uint8_t> rgba) {
  std::vector<std::byte> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* first = static_cast<const std::byte*>(data);
    auto& out = *static_cast<std::vector<std::byte>*>(context);
    out.insert(out.end(), first, first + size);
  };
  if (!stbi_write_png_to_func(append, &bytes, width, height, 4, rgba.data(), width * 4)) bytes.clear();
  return bytes;
}

bool encodeSmallExr(const Image& image, std::optional<double> diagonal, std::vector<std::byte>& bytes,
                    std::string& problem) {
  const std::size_t count = image.channels.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return image.channels[a] < image.channels[b]; });

  // tinyexr takes planes. The header's arrays belong to this function, so the library must not free the header.
  std::vector<std::vector<float>> planes(count, std::vector<float>(image.pixelCount()));
  std::vector<unsigned char*> pointers(count);
  std::vector<EXRChannelInfo> channels(count);
  std::vector<int> types(count, TINYEXR_PIXELTYPE_FLOAT);
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t p = 0; p < image.pixelCount(); ++p) planes[c][p] = image.data[p * count + order[c]];
    pointers[c] = reinterpret_cast<unsigned char*>(planes[c].data());
    const std::string& name = image.channels[order[c]];
    channels[c] = {};
    name.copy(channels[c].name, sizeof(channels[c].name) - 1);
  }
  EXRAttribute attribute{};
  float value = static_cast<float>(diagonal.value_or(0));
  std::strcpy(attribute.name, kDiagonal);
  std::strcpy(attribute.type, "float");
  attribute.value = reinterpret_cast<unsigned char*>(&value);
  attribute.size = 4;

  EXRHeader header;
  InitEXRHeader(&header);
  header.num_channels = static_cast<int>(count);
  header.channels = channels.data();
  header.pixel_types = types.data();
  header.requested_pixel_types = types.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  header.num_custom_attributes = diagonal ? 1 : 0;
  header.custom_attributes = diagonal ? &attribute : nullptr;
  EXRImage source;
  InitEXRImage(&source);
  source.images = pointers.data();
  source.width = image.width;
  source.height = image.height;
  source.num_channels = static_cast<int>(count);

  unsigned char* memory = nullptr;
  const char* message = nullptr;
  const std::size_t size = SaveEXRImageToMemory(&source, &header, &memory, &message);
  const std::unique_ptr<unsigned char, Freed> owned(memory);
  if (size == 0) {
    problem = takeMessage(message, "the EXR writer refused the image");
    return false;
  }
  const auto* first = reinterpret_cast<const std::byte*>(memory);
  bytes.assign(first, first + size);
  return true;
}

}  // namespace halfsilver
