#include "io/gltf_container.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/gltf_uri.h"

namespace halfsilver::gltf {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{1} << 32;  // of all buffers and images together

std::uint32_t littleEndian(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

const std::string* textOf(const json& object, const char* key, const Diagnostics& diagnostics,
                          const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end()) return nullptr;
  if (!found->is_string()) diagnostics.fail(std::string(key) + " is not text", where);
  return found->get_ptr<const std::string*>();
}

// The name of a resource in messages; data would be long.
std::string shown(const std::string& uri) { return isDataUri(uri) ? "" : " \"" + uri.substr(0, 100) + "\""; }

class Taker {
 public:
  Taker(const Chunks& chunks, const std::filesystem::path& folder, const Diagnostics& diagnostics)
      : chunks_(chunks), folder_(folder), diagnostics_(diagnostics) {}

  std::vector<std::uint8_t> buffer(const json& source, std::size_t index) {
    const std::string where = item("buffers", index);
    const auto declared = source.find("byteLength");
    if (declared == source.end()) diagnostics_.fail("has no byteLength", where);
    const auto length = declared->get<std::size_t>();
    const std::string* uri = textOf(source, "uri", diagnostics_, where);
    std::vector<std::uint8_t> bytes;
    if (uri) {
      Resource resource = readUri(*uri, folder_, length);
      if (!resource.problem.empty()) diagnostics_.fail(resource.problem, where + shown(*uri));
      bytes = std::move(resource.bytes);
    } else if (index == 0 && chunks_.binary) {
      bytes.assign(chunks_.binary->begin(),
                   chunks_.binary->begin() + static_cast<std::ptrdiff_t>(std::min(length, chunks_.binary->size())));
    } else {
      return bytes;
    }
    if (bytes.size() < length)
      diagnostics_.fail("has " + std::to_string(bytes.size()) + " bytes, but declares " + std::to_string(length),
                        where + (uri ? shown(*uri) : ""));
    count(bytes.size(), where);
    return bytes;
  }

  ImageSource image(const json& source, std::size_t index) {
    const std::string where = item("images", index);
    ImageSource image;
    if (const std::string* name = textOf(source, "name", diagnostics_, where)) image.name = *name;
    if (const auto view = source.find("bufferView"); view != source.end()) image.view = view->get<int>();
    const std::string* uri = textOf(source, "uri", diagnostics_, where);
    if (image.view >= 0 || !uri) return image;
    if (image.name.empty() && !isDataUri(*uri)) image.name = *uri;
    Resource resource = readUri(*uri, folder_);
    image.bytes = std::move(resource.bytes);
    image.problem = std::move(resource.problem);
    count(image.bytes.size(), where);
    return image;
  }

 private:
  void count(std::size_t bytes, const std::string& where) {
    total_ += bytes;
    if (total_ > kMaxBytes) diagnostics_.fail("buffers and images together are larger than 4 GiB", where);
  }

  const Chunks& chunks_;
  const std::filesystem::path& folder_;
  const Diagnostics& diagnostics_;
  std::size_t total_ = 0;
};

}  // namespace

Chunks splitBinary(std::span<const std::uint8_t> bytes, const Diagnostics& diagnostics) {
  constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  const auto truncated = [&](std::uint64_t needed, const std::string& where) {
    if (bytes.size() < needed)
      diagnostics.fail(
          "is truncated: it declares " + std::to_string(needed) + " bytes and has " + std::to_string(bytes.size()),
          where);
  };
  truncated(kHeader + kChunkHeader, "header");
  if (const std::uint32_t version = littleEndian(bytes, 4); version != 2)
    diagnostics.fail("is binary glTF of version " + std::to_string(version) + ", only 2 is supported", "header");
  truncated(littleEndian(bytes, 8), "header");
  Chunks chunks;
  // What follows the declared length does not count, but some files declare too little.
  const std::size_t end =
      std::max<std::size_t>(littleEndian(bytes, 8), kHeader + kChunkHeader + littleEndian(bytes, kHeader));
  std::size_t at = kHeader;
  for (std::size_t index = 0; at + kChunkHeader <= end; ++index) {
    const std::uint32_t length = littleEndian(bytes, at), type = littleEndian(bytes, at + 4);
    at += kChunkHeader;
    if (index == 0 && type != kJson) diagnostics.fail("does not begin with a JSON chunk", "chunk 0");
    truncated(std::uint64_t{at} + length, "chunk " + std::to_string(index));
    const auto chunk = bytes.subspan(at, length);
    if (index == 0)
      chunks.json = {reinterpret_cast<const char*>(chunk.data()), chunk.size()};
    else if (type == kBinary && !chunks.binary)
      chunks.binary = chunk;
    at += length;
  }
  // Some programs pad with zeros, not with spaces.
  chunks.json = chunks.json.substr(0, chunks.json.find_last_not_of('\0') + 1);
  return chunks;
}

void takeResources(json& root, const Chunks& chunks, const std::filesystem::path& folder, Document& document,
                   const Diagnostics& diagnostics) {
  Taker taker(chunks, folder, diagnostics);
  if (const auto buffers = root.find("buffers"); buffers != root.end())
    for (std::size_t i = 0; i < buffers->size(); ++i) document.buffers.push_back(taker.buffer((*buffers)[i], i));
  if (const auto images = root.find("images"); images != root.end())
    for (std::size_t i = 0; i < images->size(); ++i) document.images.push_back(taker.image((*images)[i], i));
  root.erase("buffers");
  root.erase("images");
}

}  // namespace halfsilver::gltf
