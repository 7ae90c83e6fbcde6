#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <halfsilver/pose.h>
#include "apps/demo/play.h"
#include "apps/demo/viewer_camera.h"

namespace halfsilver::demo {

// Any scene, with its animations.
class Viewer final : public Play {
 public:
  Viewer(Model model, const Camera& start, AnimatedBounds bounds);

  Model& model() override { return model_; }
  const AnimatedBounds& bounds() const override { return bounds_; }
  void step(const Controls& controls, double elapsed) override;
  const PoseState& poseState() const override { return state_; }
  Camera camera() const override { return camera_.camera(); }
  std::vector<std::string> status() const override;
  void setPivot(const glm::vec3& pivot) override { camera_.setPivot(pivot); }
  void frame(const Bounds& bounds) override { camera_.frame(bounds); }

  void setWindowHeight(int pixels) { windowHeight_ = pixels; }
  // -1: all that can be played together.
  void choose(int animation);
  int chosen() const { return chosen_; }
  double duration() const;  // seconds, of the longest that plays; 0: nothing does

  double seconds = 0;  // of the animations
  bool paused = false;
  bool loop = true;  // else the animations' last pose holds

 private:
  Model model_;
  AnimatedBounds bounds_;
  ViewerCamera camera_;
  int windowHeight_ = 1, chosen_ = -1;
  std::vector<int> playing_;
  PoseState state_;
};

// Of what is of a material, or of all, in a pose. Leaves the model as it is.
Bounds posedBounds(const Model& model, const PoseState& state, const std::optional<std::uint32_t>& material);

// The scenes (.gltf, .glb) in the folder of a file, sorted; empty for what is no file.
std::vector<std::filesystem::path> neighbors(const std::string& scene);

}  // namespace halfsilver::demo
