#include "passes/select.h"

#include <halfsilver/shared_structs.h>

namespace halfsilver {
namespace {

constexpr int kTile = 8;

}  // namespace

SelectPass::SelectPass(const gl::Api& api)
    : api_(&api),
      select_(gl::Program::compute(api, "passes/select.comp")),
      finish_(gl::Program::compute(api, "passes/ray_count.comp")) {}

void SelectPass::run(const GBuffer& gbuffer, RayQueue& out, Contributions& contributions, gl::Profiler& profiler) {
  const gl::Api& gl = *api_;
  const auto pixels = static_cast<std::uint32_t>(gbuffer.width) * static_cast<std::uint32_t>(gbuffer.height);
  if (out.capacity < pixels) {
    out = RayQueue{};  // the old memory goes before the new comes
    out.rays = gl::Buffer(gl, pixels * sizeof(shared::Ray), "rays");
    out.count = gl::Buffer(gl, sizeof(shared::RayCount), "ray count");
    out.capacity = pixels;
  }
  if (!contributions.counts)
    contributions.counts = gl::Buffer(gl, CONTRIBUTION_CLASSES * sizeof(GLuint), "pixels by contribution");
  const auto section = profiler.section("select");
  // The last frame's shaders wrote the counters; the fill overwrites them.
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  out.count.fill(0);
  contributions.counts.fill(0);
  gbuffer.visibility.bind(UNIT_VISIBILITY);
  gbuffer.position.bind(UNIT_POSITION);
  gbuffer.normal.bind(UNIT_NORMAL);
  gbuffer.material.bind(UNIT_MATERIAL);
  gbuffer.shaded.bind(UNIT_SHADED);
  out.rays.bindStorage(SSBO_RAYS);
  out.count.bindStorage(SSBO_RAY_COUNT);
  contributions.counts.bindStorage(SSBO_CONTRIBUTIONS);
  select_.use();
  gl.DispatchCompute(static_cast<GLuint>((gbuffer.width + kTile - 1) / kTile),
                     static_cast<GLuint>((gbuffer.height + kTile - 1) / kTile), 1);
  // The selection counts rays; the next dispatch reads the count.
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  finish_.use();
  gl.DispatchCompute(1, 1, 1);
  // Rays and their count are read by the tracer's shaders, by its indirect dispatches and by reports.
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
