#include "passes/pose.h"

#include <algorithm>

#include "frame/pose_structs.h"

namespace halfsilver {

void PosePass::run(GpuRig& rig, const GpuScene& scene, gl::Profiler& profiler) {
  if (!rig.waiting()) return;
  const auto section = profiler.section("pose");
  const std::uint32_t groups = rig.upload();
  if (groups == 0) return;
  if (!program_) program_ = gl::Program::compute(*api_, "passes/pose.comp");
  program_.set("groupCount", groups);
  program_.use();
  scene.positions.bindStorage(SSBO_POSITIONS);
  scene.attributes.bindStorage(SSBO_ATTRIBUTES);
  rig.bind();
  constexpr std::uint32_t kMaxGroups = 65535;  // along an axis
  api_->DispatchCompute(std::min(groups, kMaxGroups), (groups + kMaxGroups - 1) / kMaxGroups, 1);
  // Vertices (compute) are read by the shaders of all passes, copied for motion vectors and read by tracers on the CPU.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
