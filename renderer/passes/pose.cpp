#include "passes/pose.h"

#include <algorithm>
#include <vector>

#include "frame/pose_structs.h"

namespace halfsilver {

void PosePass::run(GpuRig& rig, GpuScene& scene, Posing posing, gl::Profiler& profiler) {
  if (!rig.waiting()) return;
  if (posing == Posing::cpu) {
    const auto section = profiler.hostSection("pose");
    return rig.placeOnCpu(scene);
  }
  const auto section = profiler.section("pose");
  const std::vector<GpuRig::Batch> batches = rig.upload();
  scene.positions.bindStorage(SSBO_POSITIONS);
  scene.attributes.bindStorage(SSBO_ATTRIBUTES);
  rig.bind();
  for (const GpuRig::Batch& batch : batches) {
    const gl::Program& program = programFor(batch);
    program.set("firstGroup", batch.firstGroup);
    program.set("groupCount", batch.groupCount);
    program.use();
    constexpr std::uint32_t kMaxGroups = 65535;  // along an axis
    api_->DispatchCompute(std::min(batch.groupCount, kMaxGroups), (batch.groupCount + kMaxGroups - 1) / kMaxGroups, 1);
  }
  rig.placed();
  // Vertices (compute) are read by the shaders of all passes, copied for motion vectors and read by tracers on the CPU.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

const gl::Program& PosePass::programFor(const GpuRig::Batch& batch) {
  gl::Program& program = programs_[batch.kind()];
  if (program) return program;
  std::vector<gl::Define> defines;
  if (batch.skinned) defines.push_back({"SKINNED"});
  if (batch.morphed) defines.push_back({"MORPHED"});
  if (batch.flatNormals) defines.push_back({"FLAT_NORMALS"});
  program = gl::Program::compute(*api_, "passes/pose.comp", defines);
  return program;
}

}  // namespace halfsilver
