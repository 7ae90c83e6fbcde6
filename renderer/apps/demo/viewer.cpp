#include "apps/demo/viewer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfsilver::demo {

Viewer::Viewer(Model model, const Camera& start, AnimatedBounds bounds)
    : model_(std::move(model)),
      bounds_(std::move(bounds)),
      camera_(start, bounds_.all),
      playing_(compatibleAnimations(model_.rig)),
      state_(evaluate(model_.rig, {})) {}

void Viewer::step(const Controls& controls, double elapsed) {
  camera_.follow(controls, elapsed, windowHeight_);
  if (!paused) seconds += elapsed;
  if (!playing_.empty()) state_ = evaluate(model_.rig, playTogether(playing_, seconds, loop));
}

std::vector<std::string> Viewer::status() const { return {model_.scene.name}; }

void Viewer::choose(int animation) {
  chosen_ = animation;
  playing_ = animation < 0 ? compatibleAnimations(model_.rig) : std::vector<int>{animation};
}

double Viewer::duration() const {
  double longest = 0;
  for (const int animation : playing_)
    longest =
        std::max(longest, static_cast<double>(model_.rig.animations[static_cast<std::size_t>(animation)].duration));
  return longest;
}

Bounds posedBounds(const Model& model, const PoseState& state, const std::optional<std::uint32_t>& material) {
  Model posed = model;
  pose(posed, state);
  const Scene& scene = posed.scene;
  if (!material) return scene.bounds();
  Bounds bounds;
  for (const Triangle& triangle : scene.triangles)
    if (triangle.material == *material)
      for (const std::uint32_t vertex : triangle.vertices) bounds.add(scene.vertices[vertex].position);
  return bounds;
}

std::vector<std::filesystem::path> neighbors(const std::string& scene) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(scene, error).parent_path();
  if (error || !std::filesystem::is_regular_file(scene, error)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path extension = entry.path().extension();
    if (extension == ".glb" || extension == ".gltf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace halfsilver::demo
