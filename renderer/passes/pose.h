#pragma once

#include <array>

#include <halfsilver/gl/profiler.h>
#include <halfsilver/settings.h>
#include "frame/gpu_rig.h"
#include "gl/program.h"

namespace halfsilver {

// Writes the vertices of what has been posed since the last run into the scene, section "pose".
class PosePass {
 public:
  explicit PosePass(const gl::Api& api) : api_(&api) {}

  void run(GpuRig& rig, GpuScene& scene, Posing posing, gl::Profiler& profiler);

 private:
  const gl::Program& programFor(const GpuRig::Batch& batch);

  const gl::Api* api_;
  std::array<gl::Program, GpuRig::Batch::kKinds> programs_;  // made when first used
};

}  // namespace halfsilver
