#pragma once

#include <glm/glm.hpp>

#include <halfsilver/scene.h>
#include "apps/demo/controls.h"

namespace halfsilver::demo {

// A camera around a pivot that can also fly: orbit, pan, zoom; W A S D E Q while the right button is held.
class ViewerCamera {
 public:
  explicit ViewerCamera(const Camera& start, const Bounds& bounds);

  // Pixels of a window of that height.
  void follow(const Controls& controls, double seconds, int windowHeight);
  void setPivot(const glm::vec3& pivot);  // keeps the eye and turns to the pivot
  void frame(const Bounds& bounds);       // shows all of it from the same side

  Camera camera() const;
  float speed() const { return speed_; }  // meters per second of flying

 private:
  glm::vec3 back() const;  // unit, from the pivot to the eye
  glm::vec3 right() const;

  Camera camera_;
  glm::vec3 pivot_{0};
  float distance_ = 1;
  float yaw_ = 0, pitch_ = 0;  // radians
  float speed_ = 1;
};

}  // namespace halfsilver::demo
