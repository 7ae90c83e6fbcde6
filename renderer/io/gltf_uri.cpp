#include "io/gltf_uri.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

namespace halfsilver::gltf {
namespace {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool equalText(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char small = lower(c);
  return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

// Nothing if an escape is not whole.
std::optional<std::string> unescaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
    if (high < 0 || low < 0) return std::nullopt;
    result += static_cast<char>(16 * high + low);
    i += 2;
  }
  return result;
}

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// White space is skipped and padding may be missing. Nothing if there is another character.
std::optional<std::vector<std::uint8_t>> fromBase64(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t word = 0;
  int digits = 0;
  bool padded = false;
  for (const char c : text) {
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    if (c == '=') {
      padded = true;
      continue;
    }
    const int digit = base64Digit(c);
    if (digit < 0 || padded) return std::nullopt;
    word = word << 6 | static_cast<std::uint32_t>(digit);
    if (++digits % 4 != 0) continue;
    for (int shift = 16; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift & 255));
    word = 0;
  }
  if (digits % 4 == 1) return std::nullopt;
  if (digits % 4 == 2) bytes.push_back(static_cast<std::uint8_t>(word >> 4));
  if (digits % 4 == 3) {
    bytes.push_back(static_cast<std::uint8_t>(word >> 10));
    bytes.push_back(static_cast<std::uint8_t>(word >> 2 & 255));
  }
  return bytes;
}

Resource failed(std::string problem) { return {{}, std::move(problem)}; }

// data:[type/subtype][;name=value]...[;base64],data
Resource readData(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return failed("a data URI has no comma");
  const std::string_view head = uri.substr(0, comma);
  const std::optional<std::string> data = unescaped(uri.substr(comma + 1));
  if (!data) return failed("a data URI has an escape that is not whole");
  const std::size_t last = head.find_last_of(';');
  if (last == std::string_view::npos || !equalText(head.substr(last + 1), "base64"))
    return {{data->begin(), data->end()}, {}};
  std::optional<std::vector<std::uint8_t>> bytes = fromBase64(*data);
  if (!bytes) return failed("a data URI is not base64");
  return {std::move(*bytes), {}};
}

// With "." and ".." resolved and no separator in front; nothing if it leads out of where it starts.
std::optional<std::string> resolved(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, slash);
    path.remove_prefix(std::min(slash + 1, path.size()));
    if (part.empty() || part == ".") continue;
    if (part != "..") {
      parts.push_back(part);
      continue;
    }
    if (parts.empty()) return std::nullopt;
    parts.pop_back();
  }
  std::string result;
  for (const std::string_view part : parts) {
    if (!result.empty()) result += '/';
    result += part;
  }
  return result;
}

// The length of "name:" in front, 0 if there is no scheme.
std::size_t schemeLength(std::string_view uri) {
  const std::size_t end = uri.find_first_of(":/?#");
  if (end == std::string_view::npos || end == 0 || uri[end] != ':') return 0;
  const auto letter = [](char c) { return lower(c) >= 'a' && lower(c) <= 'z'; };
  const auto legal = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.'; };
  return letter(uri[0]) && std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(end), legal) ? end + 1
                                                                                                           : 0;
}

std::filesystem::path pathOf(const std::string& utf8) { return {std::u8string(utf8.begin(), utf8.end())}; }

std::optional<Resource> readFile(const std::filesystem::path& path, std::size_t limit) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) return failed("cannot be read");
  Resource result;
  result.bytes.resize(static_cast<std::size_t>(std::min<std::uintmax_t>(size, limit)));
  if (!stream.read(reinterpret_cast<char*>(result.bytes.data()), static_cast<std::streamsize>(result.bytes.size())))
    return failed("cannot be read");
  return result;
}

}  // namespace

bool isDataUri(std::string_view uri) { return uri.size() >= 5 && equalText(uri.substr(0, 5), "data:"); }

Resource readUri(std::string_view uri, const std::filesystem::path& folder, std::size_t limit) {
  if (isDataUri(uri)) {
    Resource result = readData(uri);
    if (result.bytes.size() > limit) result.bytes.resize(limit);
    return result;
  }
  const std::size_t scheme = schemeLength(uri);
  // What the text can mean, the standard's reading first.
  const std::array readings = {
      scheme ? std::nullopt : unescaped(uri.substr(0, uri.find_first_of("?#"))),
      unescaped(uri),
      std::optional(std::string(uri)),
  };
  std::string problem = "there is no such file";
  if (scheme) problem = "the scheme " + std::string(uri.substr(0, std::min<std::size_t>(scheme, 20))) + " is not read";
  for (const std::optional<std::string>& reading : readings) {
    if (!reading) continue;
    if (reading->find('\0') != std::string::npos) return failed("the name contains a zero");
    if (reading->starts_with('/')) return failed("the path is absolute, not relative to the scene");
    const std::optional<std::string> path = resolved(*reading);
    if (!path) return failed("the path leads out of the scene's folder");
    if (path->empty()) continue;
    if (std::optional<Resource> file = readFile(folder / pathOf(*path), limit)) return std::move(*file);
  }
  return failed(problem);
}

}  // namespace halfsilver::gltf
