#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/model.h>
#include <halfsilver/scene_change.h>

// Where everything that can move is at a time. evaluate() plays animations in double precision; pose() is the reference
// of how vertices follow, on the CPU. Source: the glTF 2.0 specification, sections 3.7 and 3.11.
namespace halfsilver {

// An animation at a time of its own. Keys compare as the floats that they are.
struct Playing {
  int animation = 0;  // into Rig::animations
  double seconds = 0;
  // A time beyond the duration starts again; the duration itself and its multiples are the last pose. Loops do not
  // drift: the duration is the simplest fraction that rounds to the file's float, 16/15 for 1.0666667. Without loops
  // the first and the last pose hold.
  bool loop = true;
};

struct PoseState {
  std::vector<glm::dmat4> world;             // one per node, world units
  std::vector<std::vector<double>> weights;  // morph weights, one list per node
};

// The nodes with these animations applied, later ones over earlier ones; the rest pose if there are none. The nodes of
// the rig may have been edited before. Throws Error (usage) for an unknown animation or a time that is not finite.
PoseState evaluate(const Rig& rig, std::span<const Playing> playing);

// The animations at one time.
std::vector<Playing> playTogether(std::span<const int> animations, double seconds, bool loop = true);

// All animations that can be played together, in the file's order: each that moves no property of a node that one
// before it moves.
std::vector<int> compatibleAnimations(const Rig& rig);

// Moves the scene's vertices, and the lights and cameras that follow nodes. Node transforms are evaluated in double
// precision; positions are rounded to float once. Returns what changed: vertices, turned triangles and lights.
// Throws Error (badInput) if vertices leave the range of floats.
SceneChange pose(Model& model, const PoseState& state);
SceneChange pose(Model& model, std::span<const Playing> playing);

// Changes Scene::origin of a model at rest, in world units. Vertices, lights, and cameras that follow nodes are placed
// again in double precision, all others are shifted.
void moveOrigin(Model& model, const glm::dvec3& origin);

// The point of what is drawn in a pose that is nearest to a point, in world units: of the boxes of the instances.
// Nothing if there are none.
std::optional<glm::dvec3> nearestPosed(const Model& model, const PoseState& state, const glm::dvec3& point);

// Boxes of all that a model's animations make of it, one at a time and together, relative to Scene::origin. Poses
// between the sampled ones may leave them by a little, poses of the caller's own by much.
struct AnimatedBounds {
  std::vector<Bounds> instances;  // of each instance of the rig
  Bounds all;                     // of these, and of the scene as it is now
};
// Evaluates up to 33 poses of each animation: keep it. Throws Error (usage) if an index of the rig points nowhere.
AnimatedBounds animatedBounds(const Model& model);

// A camera of the scene as it is in a pose: at its node, if it is attached to one. Throws Error (usage) for an unknown
// one.
Camera posedCamera(const Model& model, const PoseState& state, std::size_t camera);

}  // namespace halfsilver
