#include "effects/light_rays/light_rays.h"

#include <algorithm>
#include <vector>

#include "shared/passes/light_rays.h"
#include "shared/passes/light_sums.h"
#include "shared/passes/shadow_marks.h"

namespace halfsilver {
namespace {

bool extended(const Light& light) { return light.type == LightType::rectangle || light.type == LightType::sphere; }

int generations(const FrameView& view) {
  return view.scene.clearMaterials > 0 || view.frame.blends != 0 ? 1 + kPassedSurfaces : 1;
}

// Surfaces that send rays at once: pixels of a band, or rays of a batch.
std::uint32_t sourcesOf(const FrameView& view, int batches) {
  return bandOf(view.gbuffer, 0, batches).pixels * std::max(view.frame.glossySamples, 1u);
}

int pixelBands(const FrameView& view) { return bandCount(view.gbuffer, LightRays::kRaysAtOnce); }

// The same for all queues of a frame, whose counts would be lost with their memory.
std::uint32_t capacityOf(const FrameView& view, std::span<const Light> lights, int batches) {
  const std::uint32_t sources = std::max(sourcesOf(view, batches), bandOf(view.gbuffer, 0, pixelBands(view)).pixels);
  const std::uint64_t all = std::uint64_t{sources} * lights.size();
  return std::max(sources, static_cast<std::uint32_t>(std::min<std::uint64_t>(all, LightRays::kRaysAtOnce)));
}

template <class Visit>
void eachGroup(const FrameView& view, std::span<const Light> lights, std::uint32_t perGroup, Visit&& visit) {
  const auto total = static_cast<std::uint32_t>(lights.size());
  for (std::uint32_t number = 0; number < view.frame.shadowSamples; ++number)
    for (std::uint32_t first = 0; first < total; first += perGroup) {
      const std::uint32_t count = std::min(perGroup, total - first);
      const std::span<const Light> group = lights.subspan(first, count);
      if (number == 0 || std::any_of(group.begin(), group.end(), extended)) visit(first, count, number);
    }
}

}  // namespace

void LightRayFrame::forgetCounts() {
  for (RayQueue& queue : queues)
    if (queue.count) queue.count.fill(0);
}

std::size_t LightRayFrame::bytes() const {
  std::size_t sum = hits.bytes() + sums.bytes();
  for (const RayQueue& queue : queues) sum += queue.bytes();
  return sum;
}

std::uint32_t LightRays::traces(const FrameView& view, std::span<const Light> lights, int shaded) {
  const std::uint32_t capacity = capacityOf(view, lights, 1);
  std::uint32_t groups = 0;
  eachGroup(view, lights, std::max(1u, capacity / bandOf(view.gbuffer, 0, pixelBands(view)).pixels),
            [&](auto...) { groups += static_cast<std::uint32_t>(pixelBands(view)); });
  eachGroup(view, lights, std::max(1u, capacity / sourcesOf(view, 1)),
            [&](auto...) { groups += static_cast<std::uint32_t>(shaded); });
  return groups * static_cast<std::uint32_t>(generations(view));
}

// What all sources of rays have bound.
void LightRays::begin(const gl::Program& program, const FrameView& view, const Group& group, std::uint32_t capacity,
                      LightRayFrame& frame) const {
  RayQueue& queue = frame.queues[0];
  reserveQueue(*api_, capacity, RayStorage::rays, queue);
  beginQueue(queue);
  program.use();
  program.set("firstLight", group.first);
  program.set("lightCount", group.count);
  program.set("number", group.number);
  program.set("nextCapacity", queue.capacity);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  view.shadows.bind();
  queue.rays.bindStorage(SSBO_NEXT_RAYS);
  queue.paths.bindStorage(SSBO_NEXT_PATHS);
  queue.count.bindStorage(SSBO_NEXT_COUNT);
}

void LightRays::lightPixels(const FrameView& view, std::span<const Light> lights, const Trace& trace,
                            const Shade& shade, int batches, LightRayFrame& frame) {
  const GBuffer& gbuffer = view.gbuffer;
  if (lights.empty()) {
    shade(0, gbuffer.height);
    return;
  }
  const bool marked = static_cast<bool>(gbuffer.shadowMarks), coats = view.frame.coats != 0;
  gl::Program& fromPixels = fromPixels_[marked][view.scene.lobes][coats];
  if (!fromPixels) {
    std::vector<gl::Define> defines;
    if (marked) defines.push_back({"SHADOW_MARKS"});
    if (view.scene.lobes) defines.push_back({"LOBES"});
    if (coats) defines.push_back({"COATS"});
    fromPixels = gl::Program::compute(*api_, "effects/light_rays/from_pixels.comp", defines);
  }
  if (!add_) add_ = gl::Program::compute(*api_, "effects/light_rays/add.comp");
  const int bands = pixelBands(view);
  const std::uint32_t capacity = capacityOf(view, lights, batches);
  for (int number = 0; number < bands; ++number) {
    const Band band = bandOf(gbuffer, number, bands);
    const auto overBand = [&](const gl::Program& program) {
      program.set("firstRow", band.firstRow);
      program.set("rows", band.rows);
      api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kBandTile - 1) / kBandTile),
                            static_cast<GLuint>((band.rows + kBandTile - 1) / kBandTile), 1);
    };
    const std::size_t bytes = band.pixels * sizeof(shared::LightSum);
    if (frame.sums.bytes() != bytes) frame.sums = gl::Buffer(*api_, bytes, "direct light of pixels");
    frame.sums.fill(0);
    eachGroup(view, lights, std::max(1u, capacity / band.pixels),
              [&](std::uint32_t first, std::uint32_t count, std::uint32_t ray) {
                follow(view, trace, frame.sums, band.firstPixel, capacity, frame, [&] {
                  begin(fromPixels, view, {first, count, ray}, capacity, frame);
                  if (marked) gbuffer.shadowMarks.bind(UNIT_SHADOW_MARKS);
                  gbuffer.bindSurface();
                  overBand(fromPixels);
                });
              });
    api_->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);  // shading stores over what sending the rays has loaded
    shade(band.firstRow, band.rows);
    const auto section = view.profiler.section("shade");
    add_.use();
    add_.set("firstPixel", band.firstPixel);
    view.constants.bindUniform(UBO_FRAME);
    frame.sums.bindStorage(SSBO_LIGHT_SUMS);
    gbuffer.shaded.bindImage(IMAGE_SHADED, GL_READ_WRITE);
    overBand(add_);
    // The shaded pixels (compute) are read by selection, by the composite pass and by read-backs, and added to by rays
    // behind clear surfaces; the next band's fill follows the reads of the sums.
    api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                        GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
}

void LightRays::lightHits(const FrameView& view, std::span<const Light> lights, const Trace& trace,
                          const RayQueue& rays, const Hits& hits, const RayStep& step, bool passesOn,
                          EffectFrame& effect, LightRayFrame& frame) {
  const Band band = bandOf(view.gbuffer, step.batch, effect.batches);
  const std::size_t bytes = band.pixels * sizeof(shared::LightSum);
  if (effect.directLight.bytes() != bytes) effect.directLight = gl::Buffer(*api_, bytes, "direct light of hits");
  if (step.generation == 0) effect.directLight.fill(0);
  if (lights.empty()) return;

  const bool ofPixels = rays.ofPixels(), surfaces = static_cast<bool>(hits.surfaces);
  std::optional<SurfacePrograms>& programs = fromHits_[ofPixels][surfaces];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (ofPixels) defines.push_back({"PIXEL_QUEUE"});
    if (surfaces) defines.push_back({"HIT_SURFACES"});
    programs.emplace(*api_, "effects/light_rays/from_hits.comp", std::move(defines));
  }
  const gl::Program& program = programs->of(view);
  const std::uint32_t capacity = capacityOf(view, lights, effect.batches);
  eachGroup(view, lights, std::max(1u, capacity / sourcesOf(view, effect.batches)),
            [&](std::uint32_t first, std::uint32_t count, std::uint32_t ray) {
              follow(view, trace, effect.directLight, band.firstPixel, capacity, frame, [&] {
                begin(program, view, {first, count, ray}, capacity, frame);
                program.set("generation", static_cast<unsigned>(step.generation));
                program.set("passesOn", passesOn ? 1u : 0u);
                view.bindRays(rays);
                if (!ofPixels) rays.paths.bindStorage(SSBO_PATHS);
                hits.hits.bindStorage(SSBO_HITS);
                if (surfaces) hits.surfaces.bindStorage(SSBO_HIT_SURFACES);
                api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
                api_->DispatchComputeIndirect(0);
              });
            });
}

// All generations of the rays that `spawn` appends to the first queue.
template <class Spawn>
void LightRays::follow(const FrameView& view, const Trace& trace, const gl::Buffer& sums, std::uint32_t firstPixel,
                       std::uint32_t capacity, LightRayFrame& frame, const Spawn& spawn) {
  {
    const auto section = view.profiler.section("shade");
    spawn();
    count_.run(frame.queues[0]);
  }
  const int all = generations(view);
  for (int generation = 0; generation < all; ++generation) {
    const bool last = generation + 1 == all;
    const RayQueue& rays = frame.queues[static_cast<std::size_t>(generation % 2)];
    RayQueue* next = last ? nullptr : &frame.queues[static_cast<std::size_t>((generation + 1) % 2)];
    trace(rays, frame.hits, all == 1);
    gather(view, rays, frame.hits, next, capacity, sums, firstPixel);
  }
}

void LightRays::gather(const FrameView& view, const RayQueue& rays, const Hits& hits, RayQueue* next,
                       std::uint32_t capacity, const gl::Buffer& sums, std::uint32_t firstPixel) {
  const auto section = view.profiler.section("shade");
  const bool surfaces = static_cast<bool>(hits.surfaces), last = next == nullptr;
  std::optional<SurfacePrograms>& programs = gather_[surfaces][last];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (surfaces) defines.push_back({"HIT_SURFACES"});
    if (last) defines.push_back({"LAST_GENERATION"});
    programs.emplace(*api_, "effects/light_rays/gather.comp", std::move(defines));
  }
  const gl::Program& program = programs->of(view.scene);
  program.use();
  program.set("firstPixel", firstPixel);
  view.scene.bindSurfaces();
  view.bindRays(rays);
  rays.paths.bindStorage(SSBO_PATHS);
  hits.hits.bindStorage(SSBO_HITS);
  if (surfaces) hits.surfaces.bindStorage(SSBO_HIT_SURFACES);
  sums.bindStorage(SSBO_LIGHT_SUMS);
  if (next) {
    reserveQueue(*api_, capacity, RayStorage::rays, *next);
    beginQueue(*next);
    program.set("nextCapacity", next->capacity);
    next->rays.bindStorage(SSBO_NEXT_RAYS);
    next->paths.bindStorage(SSBO_NEXT_PATHS);
    next->count.bindStorage(SSBO_NEXT_COUNT);
  }
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rays.count.name());
  api_->DispatchComputeIndirect(0);
  if (next)
    count_.run(*next);
  else
    // The sums are added to by the next rays and read by resolve(); the next spawn writes over what was read here.
    api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
