#include "effects/ray_queues.h"

#include <algorithm>
#include <cstddef>

namespace halfsilver {
namespace {

// Rows of the screen in a band but the last.
int bandRows(const GBuffer& gbuffer, int batches) {
  const int tiles = (gbuffer.height + kBandTile - 1) / kBandTile;
  return (tiles + batches - 1) / batches * kBandTile;
}

std::uint32_t bandPixels(const GBuffer& gbuffer, int batches) {
  return static_cast<std::uint32_t>(gbuffer.width) *
         static_cast<std::uint32_t>(std::min(bandRows(gbuffer, batches), gbuffer.height));
}

}  // namespace

Band bandOf(const GBuffer& gbuffer, int batch, int batches) {
  Band band;
  band.firstRow = batch * bandRows(gbuffer, batches);
  band.rows = std::clamp(gbuffer.height - band.firstRow, 0, bandRows(gbuffer, batches));
  band.firstPixel = static_cast<std::uint32_t>(band.firstRow) * static_cast<std::uint32_t>(gbuffer.width);
  band.pixels = bandPixels(gbuffer, batches);
  return band;
}

int bandCount(const GBuffer& gbuffer, std::uint32_t maxPixels) {
  int batches = 1;
  while (bandPixels(gbuffer, batches) > maxPixels && bandRows(gbuffer, batches) > kBandTile) ++batches;
  const int rows = bandRows(gbuffer, batches);
  return (gbuffer.height + rows - 1) / rows;  // rounding up may leave nothing to the last ones
}

void reserveQueue(const gl::Api& api, std::uint32_t rays, RayStorage storage, RayQueue& queue) {
  const bool fits = queue.capacity >= rays && queue.capacity / 2 <= rays;  // what is far too large goes, too
  if (fits && queue.ofPixels() == (storage == RayStorage::pixels)) return;
  queue = RayQueue{};  // the old memory goes before the new comes
  if (storage == RayStorage::rays) {
    queue.rays = gl::Buffer(api, rays * sizeof(shared::Ray), "rays");
    queue.paths = gl::Buffer(api, rays * sizeof(shared::RayPath), "ray paths");
  } else {
    constexpr std::uint32_t kPixelsPerRow = 4;  // shaders read rows of 16 bytes
    queue.rays = gl::Buffer(api, (rays + kPixelsPerRow - 1) / kPixelsPerRow * sizeof(glm::uvec4), "pixels with rays");
  }
  queue.count = gl::Buffer(api, sizeof(shared::RayCount), "ray count");
  queue.count.fill(0);
  queue.capacity = rays;
}

void reserveHits(const gl::Api& api, const RayQueue& rays, bool attributes, Hits& hits) {
  const std::size_t hitBytes = rays.capacity * sizeof(shared::Hit);
  if (hits.hits.bytes() != hitBytes) hits.hits = gl::Buffer(api, hitBytes, "hits");
  const std::size_t surfaceBytes = attributes ? rays.capacity * sizeof(shared::HitSurface) : 0;
  if (hits.surfaces.bytes() != surfaceBytes) hits.surfaces = gl::Buffer(api, surfaceBytes, "hit surfaces");
}

void beginQueue(RayQueue& queue) { queue.count.fill(0, 0, offsetof(shared::RayCount, overflow)); }

RayCountPass::RayCountPass(const gl::Api& api)
    : api_(&api), program_(gl::Program::compute(api, "effects/common/ray_count.comp")) {}

void RayCountPass::run(const RayQueue& queue) const {
  // The dispatch before counts rays; this one reads the count.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  program_.use();
  program_.set("capacity", queue.capacity);
  queue.count.bindStorage(SSBO_RAY_COUNT);
  api_->DispatchCompute(1, 1, 1);
  // Rays, paths, sums and the dispatch's size are read by the tracer's shaders and indirect dispatches, by shading and
  // by reports.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
