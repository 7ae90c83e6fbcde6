#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <halfsilver/renderer.h>
#include "apps/offscreen.h"

namespace halfsilver::demo {

// A renderer with a picture of its own, which the window or a file shows.
class SceneView {
 public:
  // The model must outlive it.
  SceneView(const gl::Api& api, const std::function<Renderer::Proc(const char*)>& getProcAddress, const Model& model,
            const AnimatedBounds& bounds, int threads);

  void pose(const PoseState& state);
  void update(const Scene& scene, const SceneChange& change);
  // Draws a picture of that size, which replaces the last one. If nothing has changed since, it becomes the mean of up
  // to `samples` frames, one more with each call.
  // Returns false if it has them all, and nothing was drawn.
  bool draw(const Camera& camera, const Settings& settings, const Size& size, int samples = 1);

  Renderer& renderer() { return renderer_; }
  const Renderer& renderer() const { return renderer_; }
  Size size() const { return size_; }
  unsigned texture() const;                // RGBA8, row 0 is the bottom
  std::vector<std::uint8_t> read() const;  // rows from the top; waits for the GPU

 private:
  const gl::Api* api_;
  Renderer renderer_;
  PoseState state_;  // that was posed last
  Size size_;
  // What the picture was drawn with, and how many samples it has; none: something has changed since.
  std::optional<std::pair<Camera, Settings>> drawn_;
  int samples_ = 0;
  std::optional<OffscreenTarget> picture_;
};

}  // namespace halfsilver::demo
