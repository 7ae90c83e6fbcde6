#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <halfsilver/pose.h>
#include <halfsilver/products.h>
#include "scene/posed_bounds.h"

namespace halfsilver {

// What poses a model on the GPU: rest vertices, joints, morph targets. Matrices are composed in double precision and
// relative to Scene::origin, rest positions relative to their middle, so that floats serve wherever they are. Instances
// that floats still cannot place within kTolerance, or that the device's storage blocks cannot hold, are posed on the
// CPU.
class GpuRig {
 public:
  static constexpr double kTolerance = 1e-5;  // of the scene's diagonal

  // Of the model whose scene was uploaded with posedParts(), and which checkRig() has passed.
  GpuRig(const gl::Api& api, const Model& model);

  struct Change {
    SceneChange scene;            // vertices and turned triangles
    std::vector<Bounds> touched;  // boxes that they have left or come into
  };
  // Has the scene follow a pose. Bounds, winding and what the CPU poses are right at once, the rest after the next
  // PosePass::run(). The first pose moves every instance, later ones those that they place elsewhere. Fills `change`,
  // which is empty before, ahead of what is done to the scene: if it throws with `change` empty nothing has been done,
  // else any part of it, and the next pose moves these instances again. Throws Error (usage) if the pose is of another
  // rig and Error (badInput) if it leaves the range of floats, with nothing done.
  void take(const PoseState& state, GpuScene& scene, Change& change);

  // Attached lights follow the nodes that the pose moves. Returns whether one did.
  bool follow(const PoseState& state, std::span<Light> lights);
  // Moves the caller's lights, given as at rest, to where their nodes are now.
  void putInPlace(std::span<Light> lights) const;

  // Groups of vertices that one program places.
  struct Batch {
    bool skinned = false, morphed = false, flatNormals = false;  // what the program knows
    std::uint32_t firstGroup = 0, groupCount = 0;

    static constexpr std::size_t kKinds = 8;
    std::size_t kind() const { return (skinned ? 1u : 0u) + (morphed ? 2u : 0u) + (flatNormals ? 4u : 0u); }
  };
  // For the pass: whether instances wait for it; places them on the CPU, so that they wait no more; or uploads their
  // pose and returns the batches, of a kind each, until they have been placed(). bind(): SSBO_REST to SSBO_POSE_GROUPS.
  bool waiting() const;
  void placeOnCpu(GpuScene& scene);
  std::vector<Batch> upload();
  void bind() const;
  void placed();

  std::size_t bytes() const;

 private:
  struct Part {
    InstanceShape shape;
    std::vector<double> shares;  // see matrixShares()
    bool fits = false;           // the GPU has the next three
    std::uint32_t rest = 0, influences = 0;
    std::vector<std::uint32_t> deltas{};  // of each morph target, the first float
    // The pose that was taken last; no matrices: none.
    std::vector<glm::dmat4> matrices{};
    std::vector<double> weights{};
    bool waiting = false;

    void forgetPose() {
      matrices.clear();
      waiting = false;
    }
  };
  // What becomes of a part in a pose.
  struct Next {
    std::vector<glm::dmat4> matrices;
    std::vector<double> weights;
    InstanceShape::Placed placed;
    bool moves = false;
  };
  std::vector<Next> next(const PoseState& state) const;
  void placeOnCpu(std::size_t part, GpuScene& scene) const;

  Rig rig_;
  PoseState state_;                                 // that was taken last
  std::vector<glm::dmat4> restNodes_, lightNodes_;  // of each light with a node: at rest, and in that pose
  glm::dvec3 origin_{0};
  std::vector<Part> parts_;  // of each instance
  gl::Buffer rest_, influences_, deltas_;
  gl::Buffer weights_, matrices_, groups_;  // with room for all parts at once
};

// The parts of a scene that poses of the model move, in the AnimatedBounds::instances of it.
std::vector<PosedPart> posedParts(const Model& model, std::span<const Bounds> bounds);

}  // namespace halfsilver
