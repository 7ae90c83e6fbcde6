#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {

// Red, green and blue of each pixel.
inline std::vector<float> colors(const Image& layers) {
  std::vector<float> values;
  for (std::size_t pixel = 0; pixel < layers.pixelCount(); ++pixel)
    for (const char* channel : {"R", "G", "B"})
      values.push_back(layers.data[pixel * layers.channels.size() + static_cast<std::size_t>(layers.channel(channel))]);
  return values;
}

inline double rmse(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// Small pictures of one sample, of many, and of frames that follow each other.
class SmoothEdges : public RenderTest {
 protected:
  static constexpr int kWidth = 64, kHeight = 48;

  SmoothEdges() {
    framebuffer_.attach(GL_COLOR_ATTACHMENT0, color_);
    target_ = {framebuffer_.name(), 0, 0, kWidth, kHeight};
  }

  std::vector<float> frame(Renderer& renderer, const Camera& camera, const Settings& settings) {
    renderer.render(camera, settings, target_);
    return colors(renderer.readLayers());
  }
  std::vector<float> samples(Renderer& renderer, const Camera& camera, const Settings& settings, std::uint32_t count) {
    renderer.forgetHistory();
    for (std::uint32_t sample = 0; sample < count; ++sample) renderer.refine(camera, settings, target_, sample);
    return colors(renderer.readLayers());
  }
  std::vector<float> shown() const {
    std::vector<std::uint8_t> bytes(4 * kWidth * kHeight);
    color_.read(GL_RGBA, GL_UNSIGNED_BYTE, bytes.size(), bytes.data());
    std::vector<float> values;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      if (i % 4 != 3) values.push_back(static_cast<float>(bytes[i]) / 255.0f);
    return values;
  }

  gl::Texture color_{api, {.format = GL_RGBA8, .width = kWidth, .height = kHeight}, "test picture"};
  gl::Framebuffer framebuffer_{api};
  Target target_;
};

}  // namespace halfsilver::testing
