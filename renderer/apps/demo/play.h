#pragma once

#include <string>
#include <vector>

#include <halfsilver/model.h>
#include <halfsilver/pose.h>
#include <halfsilver/scene_change.h>
#include "apps/demo/controls.h"

namespace halfsilver::demo {

// What is played in the window: a scene, how it moves and where the camera is.
class Play {
 public:
  virtual ~Play() = default;

  virtual Model& model() = 0;  // vertices as at rest
  // Time passes, in seconds; 0 while it is frozen.
  virtual void step(const Controls& controls, double seconds) = 0;
  // Of all that the model does.
  virtual const AnimatedBounds& bounds() const = 0;
  // What changed of the model's lights, sky and materials since the last call.
  virtual SceneChange takeChange() { return {}; }
  // Where everything is now.
  virtual const PoseState& poseState() const = 0;
  virtual Camera camera() const = 0;
  // What the player should know, a line each.
  virtual std::vector<std::string> status() const { return {}; }
  // At the end of the run: writes what is to be kept. Throws Error (failed).
  virtual void finish() {}
  // The point that the player double-clicked, and the bounds that F shows; nothing if that has no meaning.
  virtual void setPivot(const glm::vec3&) {}
  virtual void frame(const Bounds&) {}
};

}  // namespace halfsilver::demo
