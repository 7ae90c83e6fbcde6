#pragma once

#include <halfsilver/gl/profiler.h>
#include "frame/gpu_rig.h"
#include "gl/program.h"

namespace halfsilver {

// Writes the vertices of what has been posed since the last run into the scene, section "pose".
class PosePass {
 public:
  explicit PosePass(const gl::Api& api) : api_(&api) {}

  void run(GpuRig& rig, const GpuScene& scene, gl::Profiler& profiler);

 private:
  const gl::Api* api_;
  gl::Program program_;  // made when first used
};

}  // namespace halfsilver
