#include "apps/demo/false_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace halfsilver::demo {
namespace {

using glm::vec3;

constexpr vec3 kGreen{0.1f, 0.75f, 0.25f}, kBlue{0.15f, 0.35f, 0.95f}, kRed{1, 0.1f, 0.1f}, kYellow{0.95f, 0.8f, 0.1f};

// Black, blue, red, yellow, white.
vec3 heat(float value) {
  constexpr vec3 kStops[] = {{0, 0, 0}, {0.1f, 0.1f, 0.7f}, {0.85f, 0.15f, 0.2f}, {1, 0.85f, 0.2f}, {1, 1, 1}};
  const float place = 4 * std::clamp(value, 0.0f, 1.0f);
  const int stop = std::min(3, static_cast<int>(place));
  return glm::mix(kStops[stop], kStops[stop + 1], place - static_cast<float>(stop));
}

vec3 wheel(const glm::vec2& motion) {
  const float angle = std::atan2(motion.y, motion.x), length = std::min(1.0f, glm::length(motion) / 16);
  const auto channel = [&](float offset) { return 0.5f + 0.5f * length * std::cos(angle + offset); };
  return {channel(0), channel(-2.0943951f), channel(2.0943951f)};
}

class Pixel {
 public:
  Pixel(const Image& layers, std::size_t index) : layers_(&layers), at_(index * layers.channels.size()) {}
  float operator()(const char* name) const {
    const int channel = layers_->channel(name);
    return channel < 0 ? 0.0f : layers_->data[at_ + static_cast<std::size_t>(channel)];
  }

 private:
  const Image* layers_;
  std::size_t at_;
};

float gray(const Pixel& pixel) {
  const float light = 0.2126f * pixel("R") + 0.7152f * pixel("G") + 0.0722f * pixel("B");
  return 0.7f * light / (1 + light);
}

vec3 answered(const Pixel& pixel) {
  const float t = pixel("hit.T");
  if (t >= 0) return kGreen;
  if (t == -1) return kBlue;
  if (t == -3) return kRed;
  return pixel("reflectivity.Y") > 0 ? kYellow : vec3(0.5f * gray(pixel));
}

vec3 wrong(const Pixel& pixel, const Pixel& exact, double diagonal) {
  const float t = pixel("hit.T"), right = exact("hit.T");
  if (t <= -2 || right <= -2) return vec3(0.4f * gray(pixel));
  if ((t >= 0) != (right >= 0)) return kRed;
  if (t < 0) return 0.5f * kBlue;
  const double off = std::abs(static_cast<double>(t) - static_cast<double>(right)) / diagonal;
  if (off > 1e-3) return kRed;
  return pixel("hit.id") == exact("hit.id") ? 0.6f * kGreen : kYellow;
}

vec3 colorOf(View view, const Pixel& pixel, const Pixel* exact, double diagonal) {
  switch (view) {
    case View::selection:
      return pixel("selected.Y") > 0 ? vec3(1, 0.55f, 0.1f) : vec3(gray(pixel));
    case View::answer:
      return answered(pixel);
    case View::distance: {
      const float t = pixel("hit.T");
      return t < 0 ? vec3(0.3f * gray(pixel)) : heat(1 - std::sqrt(t / static_cast<float>(diagonal)));
    }
    case View::normals:
      return pixel("depth.Z") > 0 ? 0.5f + 0.5f * vec3(pixel("normal.X"), pixel("normal.Y"), pixel("normal.Z"))
                                  : vec3(0);
    case View::reflectivity:
      return vec3(std::sqrt(pixel("reflectivity.Y")));
    case View::motion:
      return wheel({pixel("motion.X"), pixel("motion.Y")});
    case View::cost:
      return pixel("selected.Y") > 0 ? heat((pixel("work.steps") + pixel("work.tests")) / 128)
                                     : vec3(0.3f * gray(pixel));
    case View::error:
      return exact ? wrong(pixel, *exact, diagonal) : vec3(0);
    case View::picture:
      break;
  }
  return vec3(gray(pixel));
}

}  // namespace

std::vector<std::uint8_t> falseColors(View view, const Image& layers, const Image* exact, double diagonal) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(layers.pixelCount() * 4);
  for (std::size_t i = 0; i < layers.pixelCount(); ++i) {
    const Pixel pixel(layers, i);
    const Pixel right(exact ? *exact : layers, i);
    const vec3 color = colorOf(view, pixel, exact ? &right : nullptr, diagonal);
    for (int c = 0; c < 3; ++c)
      rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[c], 0.0f, 1.0f))));
    rgba.push_back(255);
  }
  return rgba;
}

const char* legend(View view) {
  switch (view) {
    case View::picture:
      return "";
    case View::selection:
      return "orange: pixels whose reflection is traced";
    case View::answer:
      return "green: a hit; blue: the sky; yellow: filled from neighbors or sky; red: given up";
    case View::distance:
      return "white: near the mirror; black: a scene's diagonal away";
    case View::normals:
      return "x, y, z as red, green, blue";
    case View::reflectivity:
      return "white: a perfect mirror";
    case View::motion:
      return "hue: direction; full color: 16 pixels or more since the frame before";
    case View::cost:
      return "steps and tests of the ray: white is 128 or more";
    case View::error:
      return "green: as exact rays; blue: sky in both; yellow: another triangle at the same place; red: wrong";
  }
  return "";
}

}  // namespace halfsilver::demo
