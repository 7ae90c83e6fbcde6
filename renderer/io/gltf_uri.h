#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

// What the URIs in a glTF file stand for: references after RFC 3986, data after RFC 2397.
namespace halfsilver::gltf {

// Bytes, or one line that says why there are none.
struct Resource {
  std::vector<std::uint8_t> bytes;
  std::string problem;
};

// "data:" with any media type and parameters, as base64 or percent-encoded text.
bool isDataUri(std::string_view uri);

// A data URI, or a file in the scene's folder or below it. Percent escapes are decoded, a plus is a plus, query and
// fragment are no part of the name; where there is no such file, one whose name is the text as it stands counts, as
// some programs do not escape names. "." and ".." are resolved first: a path that leads out of the folder is refused,
// and so are absolute paths, other schemes and an encoded zero. At most `limit` bytes are read.
Resource readUri(std::string_view uri, const std::filesystem::path& folder,
                 std::size_t limit = std::numeric_limits<std::int32_t>::max());

}  // namespace halfsilver::gltf
