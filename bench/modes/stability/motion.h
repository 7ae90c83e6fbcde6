#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/builtin.h>
#include "bench/harness/bench_scene.h"

namespace halfsilver::bench {

// Moves the camera and an object of a scene, frame by frame. The object is what has the material "moving"; animations
// play, too.
class Motion {
 public:
  Motion(BenchScene& scene, const SlowMove& move);

  // Frame 0 is the scene at rest. Returns the vertices that have changed.
  std::vector<VertexRange> to(int frame);

 private:
  BenchScene* scene_;
  SlowMove move_;
  glm::vec3 eye_, center_{0};
  VertexRange range_;
  std::vector<Vertex> atRest_;
};

}  // namespace halfsilver::bench
