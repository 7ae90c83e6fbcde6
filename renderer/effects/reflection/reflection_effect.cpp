#include "effects/reflection/reflection_effect.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "shared/passes/resolve.h"
#include "shared/passes/shade_hits.h"
#include "shared/passes/spawn.h"

namespace halfsilver {
namespace {

constexpr int kTile = 8;

void reserveQueue(const gl::Api& api, std::uint32_t rays, RayQueue& queue) {
  if (queue.capacity >= rays) return;
  queue = RayQueue{};  // the old memory goes before the new comes
  queue.rays = gl::Buffer(api, rays * sizeof(shared::Ray), "rays");
  queue.paths = gl::Buffer(api, rays * sizeof(shared::RayPath), "ray paths");
  queue.count = gl::Buffer(api, sizeof(shared::RayCount), "ray count");
  queue.count.fill(0);
  queue.capacity = rays;
}

void reserveFrame(const gl::Api& api, std::uint32_t rays, EffectFrame& frame) {
  if (frame.slots.bytes() < rays * sizeof(shared::Radiance)) {
    frame.slots = gl::Buffer();
    frame.slots = gl::Buffer(api, rays * sizeof(shared::Radiance), "radiance slots");
  }
  if (!frame.contributions.counts)
    frame.contributions.counts = gl::Buffer(api, CONTRIBUTION_CLASSES * sizeof(GLuint), "pixels by contribution");
}

}  // namespace

ReflectionEffect::ReflectionEffect(const gl::Api& api)
    : api_(&api),
      spawn_(gl::Program::compute(api, "effects/reflection/spawn.comp")),
      count_(gl::Program::compute(api, "effects/ray_count.comp")),
      resolve_(gl::Program::compute(api, "effects/reflection/resolve.comp")) {}

const gl::Program& ReflectionEffect::shading(const GpuScene& scene, bool first, bool surfaces, bool next) {
  std::optional<SurfacePrograms>& programs = shade_[first][surfaces][next];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (first) defines.push_back({"FIRST_GENERATION"});
    if (surfaces) defines.push_back({"HIT_SURFACES"});
    if (next) defines.push_back({"NEXT_BOUNCE"});
    programs.emplace(*api_, "effects/reflection/shade.comp", std::move(defines));
  }
  return programs->of(scene);
}

void ReflectionEffect::spawn(const FrameView& view, const GBuffer& gbuffer, int, RayQueue& out, EffectFrame& frame) {
  const auto pixels = static_cast<std::uint32_t>(gbuffer.width) * static_cast<std::uint32_t>(gbuffer.height);
  reserveQueue(*api_, pixels, out);
  reserveFrame(*api_, pixels, frame);
  const auto section = view.profiler.section("select");
  // The last frame's shaders wrote the counters; the fill overwrites them.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  out.count.fill(0);
  frame.contributions.counts.fill(0);

  spawn_.use();
  view.constants.bindUniform(UBO_FRAME);
  out.rays.bindStorage(SSBO_RAYS);
  out.paths.bindStorage(SSBO_PATHS);
  out.count.bindStorage(SSBO_RAY_COUNT);
  frame.contributions.counts.bindStorage(SSBO_CONTRIBUTIONS);
  gbuffer.shaded.bind(UNIT_SHADED);
  view.scene.sky.bind(UNIT_SKY);
  gbuffer.position.bind(UNIT_POSITION);
  gbuffer.normal.bind(UNIT_NORMAL);
  gbuffer.material.bind(UNIT_MATERIAL);
  gbuffer.visibility.bind(UNIT_VISIBILITY);
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kTile - 1) / kTile),
                        static_cast<GLuint>((gbuffer.height + kTile - 1) / kTile), 1);
  countRays(out);
}

void ReflectionEffect::countRays(const RayQueue& queue) const {
  // The dispatch before counts rays; this one reads the count.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  count_.use();
  queue.count.bindStorage(SSBO_RAY_COUNT);
  api_->DispatchCompute(1, 1, 1);
  // Rays, paths, slots and the dispatch's size are read by the tracer's shaders and indirect dispatches, by shading and
  // by reports.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ReflectionEffect::shade(const FrameView& view, const RayQueue& rays, const Hits& hits, int generation,
                             RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  if (next) {
    reserveQueue(*api_, rays.capacity, *next);                     // a hit sends on at most one ray
    next->count.fill(0, 0, offsetof(shared::RayCount, overflow));  // which counts for the whole frame
  }

  shading(view.scene, generation == 0, static_cast<bool>(hits.surfaces), next != nullptr).use();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  view.shadows.bind();
  rays.rays.bindStorage(SSBO_RAYS);
  rays.paths.bindStorage(SSBO_PATHS);
  rays.count.bindStorage(SSBO_RAY_COUNT);
  hits.hits.bindStorage(SSBO_HITS);
  if (hits.surfaces) hits.surfaces.bindStorage(SSBO_HIT_SURFACES);
  frame.slots.bindStorage(SSBO_SLOTS);
  if (next) {
    next->rays.bindStorage(SSBO_NEXT_RAYS);
    next->paths.bindStorage(SSBO_NEXT_PATHS);
    next->count.bindStorage(SSBO_NEXT_COUNT);
  }
  view.scene.sky.bind(UNIT_SKY);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
  api_->DispatchComputeIndirect(0);
  if (next)
    countRays(*next);
  else
    // The slots are read by resolve().
    api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ReflectionEffect::resolve(const FrameView& view, const RayQueue& first, const EffectFrame& frame, GBuffer& gbuffer,
                               std::uint32_t slotsPerPixel) {
  const auto section = view.profiler.section("shade");
  resolve_.use();
  resolve_.set("slotsPerPixel", slotsPerPixel);
  view.constants.bindUniform(UBO_FRAME);
  first.count.bindStorage(SSBO_RAY_COUNT);
  frame.slots.bindStorage(SSBO_SLOTS);
  gbuffer.reflection.bindImage(IMAGE_REFLECTION, GL_WRITE_ONLY);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, first.count.name());
  api_->DispatchComputeIndirect(0);
  // The reflection is read by the composite pass and by read-backs.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
