#include "apps/arguments.h"

#include <charconv>
#include <cmath>

#include "core/error.h"

namespace halfsilver {
namespace {

constexpr int kMostPixels = 16384;  // along an edge

template <class T>
bool parseNumber(std::string_view text, T& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

[[noreturn]] void reject(std::string_view option, std::string_view text, const std::string& expected) {
  throw Error(ErrorKind::usage, std::string(option) + " '" + std::string(text) + "' is not " + expected);
}

}  // namespace

Size parseSize(std::string_view text) {
  Size size;
  const std::size_t cross = text.find('x');
  const auto valid = [](int n) { return n >= 1 && n <= kMostPixels; };
  if (cross == text.npos || !parseNumber(text.substr(0, cross), size.width) ||
      !parseNumber(text.substr(cross + 1), size.height) || !valid(size.width) || !valid(size.height))
    reject("--size", text, "WIDTHxHEIGHT with both from 1 to " + std::to_string(kMostPixels));
  return size;
}

glm::dvec3 parseVector(std::string_view option, std::string_view text) {
  glm::dvec3 vector(0);
  std::string_view rest = text;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = i < 2 ? rest.find(',') : rest.size();
    if (comma == rest.npos || !parseNumber(rest.substr(0, comma), vector[i]) || !std::isfinite(vector[i]))
      reject(option, text, "three finite numbers X,Y,Z");
    rest.remove_prefix(i < 2 ? comma + 1 : comma);
  }
  return vector;
}

MirrorArgument parseMirror(std::string_view text) {
  // The last equals sign: a material's name may hold one.
  const std::size_t equals = text.rfind('=');
  MirrorArgument mirror;
  if (equals == text.npos || equals == 0 || !parseNumber(text.substr(equals + 1), mirror.reflectivity) ||
      !(mirror.reflectivity >= 0 && mirror.reflectivity <= 1))
    reject("--mirror", text, "MATERIAL=REFLECTIVITY with a reflectivity from 0 to 1");
  mirror.material = text.substr(0, equals);
  return mirror;
}

SettingArgument parseSetting(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0) reject("--set", text, "section.key=value");
  return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

}  // namespace halfsilver
