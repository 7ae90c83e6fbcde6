#include "apps/arguments.h"

#include <charconv>
#include <cmath>
#include <vector>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

constexpr int kMaxPixels = 16384;  // along an edge

template <class T>
bool parseNumber(std::string_view text, T& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

// Finite numbers between commas; empty if one is not a finite number.
std::vector<double> parseNumbers(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = text.find(',');
    double number = 0;
    if (!parseNumber(text.substr(0, comma), number) || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (comma == text.npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

[[noreturn]] void reject(std::string_view option, std::string_view text, const std::string& expected) {
  throw Error(ErrorKind::usage, std::string(option) + " '" + std::string(text) + "' is not " + expected);
}

}  // namespace

Size parseSize(std::string_view text) {
  Size size;
  const std::size_t cross = text.find('x');
  const auto valid = [](int n) { return n >= 1 && n <= kMaxPixels; };
  if (cross == text.npos || !parseNumber(text.substr(0, cross), size.width) ||
      !parseNumber(text.substr(cross + 1), size.height) || !valid(size.width) || !valid(size.height))
    reject("--size", text, "WIDTHxHEIGHT with both from 1 to " + std::to_string(kMaxPixels));
  return size;
}

glm::dvec3 parseVector(std::string_view option, std::string_view text) {
  const std::vector<double> numbers = parseNumbers(text);
  if (numbers.size() != 3) reject(option, text, "three finite numbers X,Y,Z");
  return {numbers[0], numbers[1], numbers[2]};
}

MirrorArgument parseMirror(std::string_view text) {
  // The last equals sign: a material's name may contain one.
  const std::size_t equals = text.rfind('=');
  MirrorArgument mirror;
  if (equals == text.npos || equals == 0 || !parseNumber(text.substr(equals + 1), mirror.reflectivity) ||
      !(mirror.reflectivity >= 0 && mirror.reflectivity <= 1))
    reject("--mirror", text, "MATERIAL=REFLECTIVITY with a reflectivity from 0 to 1");
  mirror.material = text.substr(0, equals);
  return mirror;
}

ViewArgument parseView(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  const std::vector<double> numbers = parseNumbers(equals == text.npos ? "" : text.substr(equals + 1));
  if (equals == 0 || numbers.size() < 6 || numbers.size() > 7)
    reject("--view", text, "SCENE=EX,EY,EZ,TX,TY,TZ or SCENE=EX,EY,EZ,TX,TY,TZ,FOV with finite numbers");
  ViewArgument view{std::string(text.substr(0, equals)),
                    {numbers[0], numbers[1], numbers[2]},
                    {numbers[3], numbers[4], numbers[5]},
                    {}};
  if (numbers.size() == 7) view.fov = numbers[6];
  return view;
}

SettingArgument parseSetting(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0) reject("--set", text, "section.key=value");
  return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

}  // namespace halfsilver
