#include "effects/reflection/reflection_effect.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "shared/passes/look.h"
#include "shared/passes/resolve.h"
#include "shared/passes/shade_hits.h"
#include "shared/passes/spawn.h"

namespace halfsilver {
namespace {

constexpr std::uint32_t kScreenRaysAtOnce = 1u << 20;  // of a band

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
      contributions_(gl::Program::compute(api, "effects/reflection/contributions.comp")),
      count_(api),
      resolve_(gl::Program::compute(api, "effects/reflection/resolve.comp")) {}

const gl::Program& ReflectionEffect::shading(const FrameView& view, bool first, bool ofPixels, bool surfaces,
                                             bool next) {
  std::optional<SurfacePrograms>& programs = shade_[first][ofPixels][surfaces][next];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (first) defines.push_back({"FIRST_GENERATION"});
    if (ofPixels) defines.push_back({"PIXEL_QUEUE"});
    if (surfaces) defines.push_back({"HIT_SURFACES"});
    if (next) defines.push_back({"NEXT_BOUNCE"});
    programs.emplace(*api_, "effects/reflection/shade.comp", std::move(defines));
  }
  return programs->of(view);
}

void ReflectionEffect::spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) {
  const Band band = bandOf(view.gbuffer, batch, batches);
  const std::uint32_t samples = view.frame.glossySamples;
  frame.batches = batches;
  reserveFrame(*api_, band.pixels * std::max(samples, 1u), frame);
  const auto section = view.profiler.section("select");
  if (samples == 0) {
    spawnPixels(view, band, batch, out, frame);
    return;
  }
  reserveQueue(*api_, band.pixels * samples, RayStorage::rays, out);
  spawnPixels(view, band, batch, frame.pixels, frame);
  scatter(view, frame.pixels, out);
}

// Of glossy reflections, from the pixels that reflect.
void ReflectionEffect::scatter(const FrameView& view, const RayQueue& pixels, RayQueue& out) {
  if (!scatter_) scatter_ = gl::Program::compute(*api_, "effects/reflection/scatter.comp");
  out.count.fill(0);
  scatter_.use();
  view.bindRays(pixels);
  view.gbuffer.material.bind(UNIT_MATERIAL);
  view.bindCoat();
  out.rays.bindStorage(SSBO_NEXT_RAYS);
  out.paths.bindStorage(SSBO_NEXT_PATHS);
  out.count.bindStorage(SSBO_NEXT_COUNT);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pixels.count.name());
  api_->DispatchComputeIndirect(0);
  count_.run(out);
}

void ReflectionEffect::spawnPixels(const FrameView& view, const Band& band, int batch, RayQueue& out,
                                   EffectFrame& frame) {
  const GBuffer& gbuffer = view.gbuffer;
  reserveQueue(*api_, band.pixels, RayStorage::pixels, out);
  // The last frame's shaders wrote the counters; the fill overwrites them.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  out.count.fill(0);
  out.count.fill(RAYS_OF_PIXELS, offsetof(shared::RayCount, source), sizeof(shared::RayCount::source));
  if (batch == 0) frame.contributions.counts.fill(0);

  const bool byContribution = view.frame.minContribution > 0;
  if (byContribution && !spawnByContribution_)
    spawnByContribution_ =
        gl::Program::compute(*api_, "effects/reflection/spawn.comp", std::array{gl::Define{"BY_CONTRIBUTION"}});
  const gl::Program& program = byContribution ? spawnByContribution_ : spawn_;
  program.use();
  program.set("firstRow", band.firstRow);
  view.constants.bindUniform(UBO_FRAME);
  out.rays.bindStorage(SSBO_RAYS);
  out.count.bindStorage(SSBO_RAY_COUNT);
  gbuffer.normal.bind(UNIT_NORMAL);
  if (byContribution) {
    frame.contributions.counts.bindStorage(SSBO_CONTRIBUTIONS);
    bindShaded(view);
  }
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kBandTile - 1) / kBandTile),
                        static_cast<GLuint>((band.rows + kBandTile - 1) / kBandTile), 1);
  count_.run(out);
}

// What blendOf() reads beside normals.
void ReflectionEffect::bindShaded(const FrameView& view) {
  view.gbuffer.shaded.bind(UNIT_SHADED);
  view.gbuffer.material.bind(UNIT_MATERIAL);
  view.bindCoat();
  view.scene.sky.bind(UNIT_SKY);
}

void ReflectionEffect::measure(const FrameView& view, const RayQueue& first, EffectFrame& frame) {
  if (view.frame.minContribution > 0) return;
  const auto section = view.profiler.section("select");
  contributions_.use();
  const RayQueue& pixels = first.ofPixels() ? first : frame.pixels;
  view.bindRays(pixels);
  frame.contributions.counts.bindStorage(SSBO_CONTRIBUTIONS);
  bindShaded(view);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pixels.count.name());
  api_->DispatchComputeIndirect(0);
  // The counts are read by reports.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ReflectionEffect::shade(const FrameView& view, const Settings&, const RayQueue& rays, const Hits& hits,
                             const RayStep& step, RayQueue* next, EffectFrame& frame) {
  const auto section = view.profiler.section("shade");
  if (next) {
    reserveQueue(*api_, rays.capacity, RayStorage::rays, *next);  // a hit sends on at most one ray
    beginQueue(*next);
  }

  const bool surfaces = static_cast<bool>(hits.surfaces);
  shading(view, step.generation == 0, rays.ofPixels(), surfaces, next != nullptr).use();
  view.scene.bindSurfaces();
  view.shadows.bind();
  view.bindRays(rays);
  if (!rays.ofPixels()) rays.paths.bindStorage(SSBO_PATHS);
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
    count_.run(*next);
  else
    // The slots are read by resolve().
    api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ReflectionEffect::spawnBehind(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) {
  if (!spawnBehind_) spawnBehind_.emplace(*api_, "effects/reflection/spawn_behind.comp");
  const Band band = bandOf(view.gbuffer, batch, batches);
  // As many as all queues of the frame have room for, of which this needs one per pixel.
  const std::uint32_t rays = band.pixels * std::max(view.frame.glossySamples, 1u);
  frame.batches = batches;
  reserveFrame(*api_, rays, frame);
  reserveQueue(*api_, rays, RayStorage::rays, out);
  const auto section = view.profiler.section("select");
  if (batch == 0) {
    // The last frame's shaders wrote the counters; the fill overwrites them.
    api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    out.count.fill(0);
  } else {
    beginQueue(out);
  }
  const gl::Program& program = spawnBehind_->of(view);
  program.use();
  program.set("firstRow", band.firstRow);
  program.set("rows", band.rows);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  view.gbuffer.visibility.bind(UNIT_VISIBILITY);
  out.rays.bindStorage(SSBO_NEXT_RAYS);
  out.paths.bindStorage(SSBO_NEXT_PATHS);
  out.count.bindStorage(SSBO_NEXT_COUNT);
  api_->DispatchCompute(static_cast<GLuint>((view.gbuffer.width + kBandTile - 1) / kBandTile),
                        static_cast<GLuint>((band.rows + kBandTile - 1) / kBandTile), 1);
  count_.run(out);
}

void ReflectionEffect::resolveBehind(const FrameView& view, const RayQueue& first, int batch, const EffectFrame& frame,
                                     const GBuffer& gbuffer) {
  const auto section = view.profiler.section("shade");
  const bool lightRays = static_cast<bool>(frame.directLight);
  gl::Program& program = resolveBehind_[lightRays];
  if (!program) {
    std::vector<gl::Define> defines;
    if (lightRays) defines.push_back({"LIGHT_RAYS"});
    program = gl::Program::compute(*api_, "effects/reflection/resolve_behind.comp", defines);
  }
  program.use();
  if (lightRays) {
    program.set("firstPixel", bandOf(gbuffer, batch, frame.batches).firstPixel);
    frame.directLight.bindStorage(SSBO_DIRECT_LIGHT);
  }
  view.bindRays(first);
  first.paths.bindStorage(SSBO_PATHS);
  frame.slots.bindStorage(SSBO_SLOTS);
  view.scene.sky.bind(UNIT_SKY);
  gbuffer.shaded.bindImage(IMAGE_SHADED, GL_READ_WRITE);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, first.count.name());
  api_->DispatchComputeIndirect(0);
  // The shaded pixels are read by selection, by the composite pass and by read-backs, and added to by rays to lights;
  // the next batch's counts and slots follow the reads of these.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                      GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                      GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ReflectionEffect::resolve(const FrameView& view, const Settings& settings, const RayQueue& first, const RayPasses&,
                               int batch, EffectFrame& frame, GBuffer& gbuffer) {
  resolve(view, first, frame, gbuffer, perPixel(settings), batch);
  if (!settings.effect.glossy || batch + 1 != frame.batches) return;
  if (!filter_) filter_ = gl::Program::compute(*api_, "effects/reflection/filter.comp");
  smooth(view, filter_, frame, gbuffer.reflection);
}

// Over neighbors with alike surfaces; `light` is a layer of the G-buffer.
void ReflectionEffect::smooth(const FrameView& view, const gl::Program& program, EffectFrame& frame,
                              gl::Texture& light) const {
  const gl::Texture::Shape& shape = light.shape();
  if (!frame.filtered || frame.filtered.shape().width != shape.width || frame.filtered.shape().height != shape.height)
    frame.filtered = gl::Texture(*api_, shape, "filtered reflection");
  const auto section = view.profiler.section("shade");
  program.use();
  view.constants.bindUniform(UBO_FRAME);
  light.bind(UNIT_REFLECTION);
  view.gbuffer.depth.bind(UNIT_DEPTH);
  view.gbuffer.normal.bind(UNIT_NORMAL);
  view.gbuffer.material.bind(UNIT_MATERIAL);
  frame.filtered.bindImage(IMAGE_REFLECTION, GL_WRITE_ONLY);
  api_->DispatchCompute(static_cast<GLuint>((shape.width + kBandTile - 1) / kBandTile),
                        static_cast<GLuint>((shape.height + kBandTile - 1) / kBandTile), 1);
  // The light is read by what looks at the screen, by the composite pass and by read-backs; what has been read here is
  // written by the next one.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                      GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  std::swap(frame.filtered, light);
}

void ReflectionEffect::lookAtScreen(const FrameView& view, const AnswerQueue& screen, EffectFrame& frame,
                                    GBuffer& gbuffer) {
  if (!seen_) {
    look_ = gl::Program::compute(*api_, "effects/reflection/look.comp");
    seen_ = gl::Program::compute(*api_, "effects/reflection/seen.comp");
    filterSeen_ = gl::Program::compute(*api_, "effects/reflection/filter.comp", std::array{gl::Define{"SEEN"}});
  }
  RayBatch& batch = frame.seen;
  const int bands = bandCount(gbuffer, kScreenRaysAtOnce / view.frame.glossySamples);
  reserveQueue(*api_, bandOf(gbuffer, 0, bands).pixels * view.frame.glossySamples, RayStorage::rays, batch.rays);
  batch.rays.count.fill(0);
  for (int number = 0; number < bands; ++number) {
    sendToScreen(view, bandOf(gbuffer, number, bands), batch.rays);
    screen(batch.rays, batch.hits);
    const auto section = view.profiler.section("shade");
    seen_.use();
    view.bindRays(batch.rays);
    batch.rays.paths.bindStorage(SSBO_PATHS);
    batch.hits.hits.bindStorage(SSBO_HITS);
    bindShaded(view);
    view.shadows.bind();
    gbuffer.occlusion.bind(UNIT_OCCLUSION);
    gbuffer.reflection.bind(UNIT_REFLECTION);
    gbuffer.seen.bindImage(IMAGE_SEEN, GL_WRITE_ONLY);
    api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, batch.rays.count.name());
    api_->DispatchComputeIndirect(0);
    // Read by the filter; the next band's rays follow the reads of these.
    api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
  smooth(view, filterSeen_, frame, gbuffer.seen);
}

void ReflectionEffect::sendToScreen(const FrameView& view, const Band& band, RayQueue& out) {
  const auto section = view.profiler.section("select");
  beginQueue(out);
  look_.use();
  look_.set("firstRow", band.firstRow);
  look_.set("rows", band.rows);
  view.constants.bindUniform(UBO_FRAME);
  out.rays.bindStorage(SSBO_NEXT_RAYS);
  out.paths.bindStorage(SSBO_NEXT_PATHS);
  out.count.bindStorage(SSBO_NEXT_COUNT);
  view.scene.bindTriangles();
  view.gbuffer.normal.bind(UNIT_NORMAL);
  view.gbuffer.visibility.bind(UNIT_VISIBILITY);
  bindShaded(view);
  api_->DispatchCompute(static_cast<GLuint>((view.gbuffer.width + kBandTile - 1) / kBandTile),
                        static_cast<GLuint>((band.rows + kBandTile - 1) / kBandTile), 1);
  count_.run(out);
}

void ReflectionEffect::resolve(const FrameView& view, const RayQueue& first, const EffectFrame& frame, GBuffer& gbuffer,
                               std::uint32_t slotsPerPixel, int batch) {
  const auto section = view.profiler.section("shade");
  const bool lightRays = static_cast<bool>(frame.directLight);
  if (lightRays && !resolveLightRays_)
    resolveLightRays_ =
        gl::Program::compute(*api_, "effects/reflection/resolve.comp", std::array{gl::Define{"LIGHT_RAYS"}});
  const gl::Program& program = lightRays ? resolveLightRays_ : resolve_;
  program.use();
  program.set("slotsPerPixel", slotsPerPixel);
  if (lightRays) {
    program.set("firstPixel", bandOf(gbuffer, batch, frame.batches).firstPixel);
    frame.directLight.bindStorage(SSBO_DIRECT_LIGHT);
  }
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
