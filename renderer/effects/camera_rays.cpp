#include "effects/camera_rays.h"

#include <algorithm>
#include <cstddef>

#include "shared/passes/light_sums.h"

namespace halfsilver {
namespace {

// More rays at once gain no speed and cost 128 bytes each.
constexpr std::uint32_t kRaysAtOnce = 1u << 20;

}  // namespace

int cameraBatches(const GBuffer& gbuffer, std::uint32_t raysPerPixel, std::uint32_t maxRays) {
  return bandCount(gbuffer, std::max(1u, std::min(maxRays, kRaysAtOnce) / raysPerPixel));
}

CameraRays::CameraRays(const gl::Api& api)
    : api_(&api),
      spawn_(gl::Program::compute(api, "effects/common/spawn_camera.comp")),
      hits_(gl::Program::compute(api, "effects/common/camera_hits.comp")),
      resolve_(gl::Program::compute(api, "effects/common/resolve_sums.comp")),
      count_(api) {}

void CameraRays::spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) const {
  const GBuffer& gbuffer = view.gbuffer;
  const Band band = bandOf(gbuffer, batch, batches);
  reserveQueue(*api_, band.pixels, RayStorage::pixels, out);
  frame.batches = batches;
  const auto section = view.profiler.section("select");
  // The last frame's shaders wrote the counters; the fill overwrites them.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  out.count.fill(0);
  out.count.fill(RAYS_OF_CAMERA, offsetof(shared::RayCount, source), sizeof(shared::RayCount::source));
  spawn_.use();
  spawn_.set("firstRow", band.firstRow);
  view.constants.bindUniform(UBO_FRAME);
  out.rays.bindStorage(SSBO_RAYS);
  out.count.bindStorage(SSBO_RAY_COUNT);
  gbuffer.visibility.bind(UNIT_VISIBILITY);
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kBandTile - 1) / kBandTile),
                        static_cast<GLuint>((band.rows + kBandTile - 1) / kBandTile), 1);
  count_.run(out);
}

void CameraRays::firstHits(const FrameView& view, const RayQueue& rays, const Hits& hits) const {
  const auto section = view.profiler.section("select");
  hits_.use();
  view.bindRays(rays);
  hits.hits.bindStorage(SSBO_HITS);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
  api_->DispatchComputeIndirect(0);
  // The hits are read by shading and by reports.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void CameraRays::bind(const gl::Program& program, const FrameView& view, const EffectFrame& frame, const RayQueue& rays,
                      const RayStep& step, RayQueue* next, std::uint32_t nextRays) {
  const Band band = bandOf(view.gbuffer, step.batch, frame.batches);
  sums_.resize(static_cast<std::size_t>(frame.batches));
  gl::Buffer& sums = sums_[static_cast<std::size_t>(step.batch)];
  const std::size_t bytes = band.pixels * sizeof(shared::LightSum);
  if (sums.bytes() != bytes) sums = gl::Buffer(*api_, bytes, "light sums");
  if (step.begins && step.generation == 0) sums.fill(0);
  program.use();
  program.set("firstPixel", band.firstPixel);
  sums.bindStorage(SSBO_LIGHT_SUMS);
  view.bindRays(rays);
  if (!rays.ofPixels()) rays.paths.bindStorage(SSBO_PATHS);
  if (!next) return;
  reserveQueue(*api_, nextRays, RayStorage::rays, *next);
  beginQueue(*next);
  program.set("nextCapacity", next->capacity);
  next->rays.bindStorage(SSBO_NEXT_RAYS);
  next->paths.bindStorage(SSBO_NEXT_PATHS);
  next->count.bindStorage(SSBO_NEXT_COUNT);
}

void CameraRays::dispatch(const RayQueue& rays, const RayQueue* next) const {
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
  api_->DispatchComputeIndirect(0);
  if (next)
    count_.run(*next);
  else
    // The sums are added to by the next pass and read by resolve().
    api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void CameraRays::resolve(const FrameView& view, const EffectFrame& frame, const RayQueue& first,
                         const RayPasses& passes, int samples, int batch, const GBuffer& gbuffer) const {
  const auto section = view.profiler.section("shade");
  resolve_.use();
  resolve_.set("firstPixel", bandOf(gbuffer, batch, frame.batches).firstPixel);
  resolve_.set("share", 1.0f / (static_cast<float>(passes.summed + passes.count) * static_cast<float>(samples)));
  view.constants.bindUniform(UBO_FRAME);
  first.rays.bindStorage(SSBO_RAYS);
  first.count.bindStorage(SSBO_RAY_COUNT);
  sums_[static_cast<std::size_t>(batch)].bindStorage(SSBO_LIGHT_SUMS);
  gbuffer.reflection.bindImage(IMAGE_REFLECTION, GL_WRITE_ONLY);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, first.count.name());
  api_->DispatchComputeIndirect(0);
  // The light is read by the composite pass and by read-backs.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

std::uint64_t CameraRays::bytes() const {
  std::uint64_t sum = 0;
  for (const gl::Buffer& each : sums_) sum += each.bytes();
  return sum;
}

}  // namespace halfsilver
