#include "apps/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

constexpr float kMost = 20;  // stops, as image.exposure
constexpr double kGray = 0.18, kWhite = 1.0;
constexpr double kMuchWhite = 0.1;

}  // namespace

std::optional<float> parseExposure(const std::string& text) {
  if (text == "auto") return std::nullopt;
  char* end = nullptr;
  const float stops = std::strtof(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(std::abs(stops) <= kMost))
    throw Error(ErrorKind::usage, "--exposure " + text + ": expected auto, or stops from -20 to 20");
  return stops;
}

std::optional<float> automaticExposure(const Image& layers) {
  const std::size_t stride = layers.channels.size();
  const auto red = static_cast<std::size_t>(layers.channel("R")), green = static_cast<std::size_t>(layers.channel("G")),
             blue = static_cast<std::size_t>(layers.channel("B"));
  std::vector<double> lit;
  double sum = 0;
  for (std::size_t pixel = 0; pixel < layers.pixelCount(); ++pixel) {
    const float* values = &layers.data[pixel * stride];
    const double luminance = 0.2126 * static_cast<double>(values[red]) + 0.7152 * static_cast<double>(values[green]) +
                             0.0722 * static_cast<double>(values[blue]);
    if (!(luminance > 0) || !std::isfinite(luminance)) continue;
    lit.push_back(luminance);
    sum += std::log2(luminance);
  }
  if (lit.empty()) return std::nullopt;
  const double gray = std::log2(kGray) - sum / static_cast<double>(lit.size());
  const auto bright = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() - 1 - lit.size() / 20);
  std::nth_element(lit.begin(), bright, lit.end());
  const double white = std::log2(kWhite) - std::log2(*bright);
  return std::clamp(static_cast<float>(std::min(gray, white)), -kMost, kMost);
}

double shareOfWhite(std::span<const std::uint8_t> rgba) {
  std::size_t white = 0;
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4)
    white += rgba[i] == 255 && rgba[i + 1] == 255 && rgba[i + 2] == 255;
  return rgba.empty() ? 0 : 4.0 * static_cast<double>(white) / static_cast<double>(rgba.size());
}

std::string whiteHint(double share) {
  if (share <= kMuchWhite) return {};
  return std::to_string(static_cast<int>(std::lround(100 * share))) +
         " % of the picture is white: --exposure auto finds an exposure, --exposure EV (stops) sets one";
}

}  // namespace halfsilver
