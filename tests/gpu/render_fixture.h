#pragma once

#include <memory>
#include <vector>

#include <halfsilver/exact.h>
#include <halfsilver/image.h>
#include <halfsilver/renderer.h>
#include "gl/framebuffer.h"
#include "gpu/context_fixture.h"

namespace halfsilver::testing {

// A frame as the layers of the contract, with what the renderer says of it.
struct Frame {
  Image layers;
  FrameReport report;

  float at(int x, int y, const std::string& channel) const;
  std::vector<float> plane(const std::string& channel) const;
};

// Shares of the traced rays by which a frame departs from the exact one, in the words of the contract.
struct HitErrors {
  double hitError = 0, falseMiss = 0, falseHit = 0, wrongId = 0;
  std::size_t rays = 0;
};
HitErrors compareHits(const Frame& frame, const Frame& exact, float diagonal);

// The public renderer with exact rays on the scene of the test.
class RenderTest : public ContextTest {
 protected:
  // Draws until no fragment is lost (the pool of a method grows from frame to frame), at most four frames.
  Frame draw(const Scene& scene, const Camera& camera, const Settings& settings, int width, int height);
  // Exactly one frame after the scene was set.
  Frame drawOnce(const Scene& scene, const Camera& camera, const Settings& settings, int width, int height);

  // What the renderer is given besides the table of methods: exact rays.
  virtual std::vector<Method> methods(const Scene& scene) const;

  // For sequences of frames: a renderer that holds the scene (which outlives it), and its next frame.
  Renderer makeRenderer(const Scene& scene);
  Frame drawWith(Renderer& renderer, const Camera& camera, const Settings& settings, int width, int height);
  // The next one without lost fragments, as draw().
  Frame drawWholeWith(Renderer& renderer, const Camera& camera, const Settings& settings, int width, int height);
};

// Settings as "name=value" pairs over the defaults.
Settings settingsWith(std::initializer_list<std::pair<const char*, const char*>> values);

// A camera without a roll, 60 degrees high.
Camera lookAt(const glm::vec3& eye, const glm::vec3& target);

}  // namespace halfsilver::testing
