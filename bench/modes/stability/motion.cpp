#include "bench/modes/stability/motion.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <halfsilver/pose.h>

namespace halfsilver::bench {
namespace {

constexpr const char* kMoving = "moving";

}  // namespace

Motion::Motion(BenchScene& scene, const SlowMove& move) : scene_(&scene), move_(move), eye_(scene.camera.eye) {
  const std::vector<Material>& materials = scene.model.scene.materials;
  std::uint32_t first = ~0u, last = 0;
  for (const Triangle& triangle : scene.model.scene.triangles)
    for (const std::uint32_t vertex : triangle.vertices)
      if (materials[triangle.material].name == kMoving) {
        first = std::min(first, vertex);
        last = std::max(last, vertex);
      }
  if (first <= last) range_ = {first, last - first + 1};
  const auto begin = scene.model.scene.vertices.begin() + (range_.count > 0 ? range_.first : 0);
  atRest_.assign(begin, begin + range_.count);
  for (const Vertex& vertex : atRest_) center_ += vertex.position / static_cast<float>(atRest_.size());
}

std::vector<VertexRange> Motion::to(int frame) {
  const auto steps = static_cast<float>(frame);
  scene_->camera.eye = eye_ + steps * move_.camera;
  Model& model = scene_->model;
  std::vector<VertexRange> moved;
  if (move_.seconds > 0)
    moved = pose(model, playTogether(compatibleAnimations(model.rig), move_.seconds * frame)).moved;
  if (range_.count == 0) return moved;
  const float size = std::pow(move_.growth, steps);
  for (std::uint32_t i = 0; i < range_.count; ++i)
    scene_->model.scene.vertices[range_.first + i].position =
        center_ + size * (atRest_[i].position - center_) + steps * move_.object;
  if (move_.shape) move_.shape(std::span(model.scene.vertices).subspan(range_.first, range_.count), frame);
  moved.push_back(range_);
  return moved;
}

}  // namespace halfsilver::bench
