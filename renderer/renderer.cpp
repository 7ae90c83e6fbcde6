#include <halfsilver/renderer.h>

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/ray_reader.h>
#include "effects/ray_effect.h"
#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "frame/layers.h"
#include "frame_record.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/state_guard.h"
#include "passes/composite.h"
#include "passes/gbuffer.h"
#include "passes/motion.h"
#include "passes/shade.h"
#include "passes/shadows.h"

namespace halfsilver {
namespace {

// Frames that may be under way, and frames whose figures may be: those, and one that has been reported.
constexpr std::size_t kFrames = 2, kRecords = kFrames + 1;

}  // namespace

struct Renderer::Impl {
  Impl(const std::function<Proc(const char*)>& getProcAddress, std::vector<Method> brought)
      : api(gl::Api::load(getProcAddress)), methods(std::move(brought)) {}

  gl::Api api;
  std::vector<Method> methods;  // the caller's own
  ShadowPass shadowPass{api};
  GBufferPass gbufferPass{api};
  MotionPass motionPass{api};
  ShadePass shadePass{api};
  CompositePass compositePass{api};
  std::unique_ptr<RayEffect> effect = makeEffect(api, {});

  GpuScene scene;
  std::vector<Light> lights;
  Sky sky;
  bool hasScene = false;
  SceneChange change;              // since the tracer was updated
  std::vector<VertexRange> moved;  // since the last frame

  ShadowMaps shadows;
  std::optional<ShadowSettings> shadowSettings;  // of the maps; none: they are out of date
  ShadowChange shadowChange;                     // since they were drawn
  std::vector<std::string> shadowWarnings;
  std::unique_ptr<Tracer> tracer;
  std::optional<Settings> tracerSettings;  // of the tracer, which is null for "none"

  // A frame under way, and its figures.
  struct Work {
    std::size_t frame, record;
  };
  std::array<Frame, kFrames> frames;
  std::array<FrameRecord, kRecords> records{FrameRecord(api), FrameRecord(api), FrameRecord(api)};
  std::deque<Work> underWay;            // the oldest first
  std::optional<std::size_t> shown;     // the frame that finished last, until another one takes its memory
  std::optional<std::size_t> reported;  // the record of the frame that finished last
  std::deque<std::size_t> unreported;   // records of finished frames, the oldest first

  std::optional<RayReader> rayReader;  // of readLayers()

  FrameView viewOf(Frame& frame, gl::Profiler& profiler) const {
    return {scene, shadows, frame.constants, frame.host, profiler, frame.gbuffer};
  }
  std::size_t takeRecord();
  bool keepsWork() const;
  std::vector<shared::RayWork> readWork();
  void useTracer(const Settings& wanted);
  void drawShadows(const Settings& wanted, gl::Profiler& profiler);
  std::uint32_t maxRays(const Settings& wanted) const;
  void reserveHits(const RayQueue& rays, Hits& hits) const;
  void submitBatch(const FrameView& view, Frame& frame, std::size_t number);
  void finishBatch(const FrameView& view, Frame& frame, RayBatch& batch);
  void begin(const Camera& camera, const Settings& wanted, int width, int height);
  void finish(const Target& target);
  void noteChange(const SceneChange& changed);
  void upload(const Scene& wanted, const SceneChange& changed);
};

// A record that neither a frame under way nor report() needs; if need be, the one that arrivedReport() missed longest.
std::size_t Renderer::Impl::takeRecord() {
  const auto needed = [this](std::size_t record) {
    return reported == record ||
           std::any_of(underWay.begin(), underWay.end(), [record](const Work& work) { return work.record == record; });
  };
  for (std::size_t record = 0; record < kRecords; ++record)
    if (!needed(record) && std::find(unreported.begin(), unreported.end(), record) == unreported.end()) return record;
  const auto oldest = std::find_if_not(unreported.begin(), unreported.end(), needed);
  const std::size_t record = *oldest;
  unreported.erase(oldest);
  return record;
}

// The tracer keeps the work of the queue that it traced last: that of the shown frame, if it was the only one.
bool Renderer::Impl::keepsWork() const {
  const Frame& frame = frames[*shown];
  return tracer && tracer->rayWork() && underWay.empty() && frame.settings.trace.countWork &&
         frame.batches.size() == 1 && effect->generations(frame.settings) == 1;
}

std::vector<shared::RayWork> Renderer::Impl::readWork() {
  const gl::Buffer& work = *tracer->rayWork();
  const std::uint64_t rays = records[*reported].report().selected;
  return work.read<shared::RayWork>(std::min<std::size_t>(rays, work.bytes() / sizeof(shared::RayWork)));
}

void Renderer::Impl::useTracer(const Settings& wanted) {
  if (tracerSettings && sameTracer(api, *tracerSettings, wanted, methods)) {
    tracerSettings = wanted;
    return;
  }
  tracer.reset();  // its memory goes before the new one's comes
  tracerSettings.reset();
  tracer = makeTracer(api, wanted, methods);
  tracerSettings = wanted;
  change = SceneChange::everything();
}

void Renderer::Impl::drawShadows(const Settings& wanted, gl::Profiler& profiler) {
  if (shadowSettings == wanted.shadow) return;
  shadowSettings.reset();
  shadowWarnings = shadowPass.run(scene, lights, sky, wanted, shadowChange, shadows, profiler);
  shadowSettings = wanted.shadow;
  shadowChange = {.everything = false, .moved = {}};
}

// Of a batch: what belongs to its rays fits one storage block each.
std::uint32_t Renderer::Impl::maxRays(const Settings& wanted) const {
  static_assert(sizeof(shared::Radiance) <= sizeof(shared::Hit) && sizeof(shared::PausedRay) <= sizeof(shared::Hit));
  std::size_t bytes = sizeof(shared::Hit);
  if (tracer->storesAttributes()) bytes = std::max(bytes, sizeof(shared::HitSurface));
  if (effect->generations(wanted) > 1) bytes = std::max({bytes, sizeof(shared::Ray), sizeof(shared::RayPath)});
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(
      static_cast<std::uint64_t>(api.limits.storageBlockBytes) / bytes, std::numeric_limits<std::uint32_t>::max()));
}

void Renderer::Impl::reserveHits(const RayQueue& rays, Hits& hits) const {
  const std::size_t hitBytes = rays.capacity * sizeof(shared::Hit);
  if (hits.hits.bytes() != hitBytes) hits.hits = gl::Buffer(api, hitBytes, "hits");
  const std::size_t surfaceBytes = tracer->storesAttributes() ? rays.capacity * sizeof(shared::HitSurface) : 0;
  if (hits.surfaces.bytes() != surfaceBytes) hits.surfaces = gl::Buffer(api, surfaceBytes, "hit surfaces");
}

// The first rays of a batch, on their way.
void Renderer::Impl::submitBatch(const FrameView& view, Frame& frame, std::size_t number) {
  RayBatch& batch = frame.batches[number];
  effect->spawn(view, static_cast<int>(number), static_cast<int>(frame.batches.size()), batch.rays, frame.effect);
  reserveHits(batch.rays, batch.hits);
  tracer->submit(view, batch.rays, batch.hits);
}

// The hits of a batch and of all generations after it, into the picture.
void Renderer::Impl::finishBatch(const FrameView& view, Frame& frame, RayBatch& batch) {
  effect->measure(view, batch.rays, frame.effect);
  tracer->collect(view, batch.rays, batch.hits);
  const int generations = effect->generations(frame.settings);
  for (int generation = 0; generation < generations; ++generation) {
    const bool last = generation + 1 == generations;
    const RayQueue& rays = generation == 0 ? batch.rays : frame.queues[static_cast<std::size_t>((generation - 1) % 2)];
    RayQueue& next = frame.queues[static_cast<std::size_t>(generation % 2)];
    Hits& hits = generation == 0 ? batch.hits : frame.hits;
    if (generation > 0) {
      reserveHits(rays, hits);
      tracer->trace(view, rays, hits);
    }
    effect->shade(view, rays, hits, generation, last ? nullptr : &next, frame.effect);
  }
  effect->resolve(view, batch.rays, frame.effect, frame.gbuffer);
}

// The stages of README.md up to the rays.
void Renderer::Impl::begin(const Camera& camera, const Settings& wanted, int width, int height) {
  if (!hasScene) throw Error(ErrorKind::usage, "begin() needs a scene: call setScene() first");
  if (underWay.size() == kFrames)
    throw Error(ErrorKind::usage, "begin(): two frames are under way, finish() one first");
  if (!underWay.empty() && (!sameTracer(api, *tracerSettings, wanted, methods) || shadowSettings != wanted.shadow))
    throw Error(ErrorKind::usage,
                "begin(): the settings need another tracer or other shadow maps while a frame is under way");
  if (width < 1 || height < 1 || width > api.limits.framebufferSize || height > api.limits.framebufferSize)
    throw Error(ErrorKind::usage, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                      " is beyond the device's limits (1 to " +
                                      std::to_string(api.limits.framebufferSize) + ")");
  const Work work{underWay.empty() ? 0 : 1 - underWay.front().frame, takeRecord()};
  Frame& frame = frames[work.frame];
  FrameRecord& record = records[work.record];
  record.begin();
  const auto section = record.profiler().section("frame");
  useTracer(wanted);
  drawShadows(wanted, record.profiler());
  const shared::FrameConstants constants =
      makeFrameConstants(camera, scene.extents.bounds(), sky, wanted, width, height, shadows.ranges);
  if (shown == work.frame) shown.reset();
  frame.settings = wanted;
  frame.host = constants;
  if (!frame.constants) frame.constants = gl::Buffer(api, sizeof(frame.host), "frame constants");
  frame.constants.write(0, &frame.host, sizeof(frame.host));

  const FrameView view = viewOf(frame, record.profiler());
  gbufferPass.run(view, frame.gbuffer);
  if (wanted.image.motion) {
    motionPass.run(view, std::exchange(moved, {}), frame.gbuffer);
  } else {
    motionPass.forget();
    frame.gbuffer.motion = gl::Texture();
  }
  moved.clear();
  if (tracer) {
    for (RayQueue& queue : frame.queues)
      if (queue.count) queue.count.fill(0);  // overflow adds up over the generations that share a queue
    tracer->update(view, change);
    frame.batches.resize(static_cast<std::size_t>(effect->batches(frame.gbuffer, maxRays(wanted))));
  } else {
    frame.batches.clear();  // no memory for rays that nobody traces
  }
  // Rays are on their way while the G-buffer is shaded, unless it says which ones there are.
  const bool early = tracer && !effect->spawnReadsShading(wanted);
  if (early) submitBatch(view, frame, 0);
  shadePass.run(view, frame.gbuffer);
  if (tracer && !early) submitBatch(view, frame, 0);
  change = {};
  underWay.push_back(work);
}

// The stages of README.md from the hits on.
void Renderer::Impl::finish(const Target& target) {
  if (underWay.empty()) throw Error(ErrorKind::usage, "finish(): no frame is under way, call begin() first");
  const Work work = underWay.front();
  Frame& frame = frames[work.frame];
  FrameRecord& record = records[work.record];
  if (target.width != frame.gbuffer.width || target.height != frame.gbuffer.height)
    throw Error(ErrorKind::usage, "finish(): the target has another size than begin() was given");
  underWay.pop_front();
  {
    const auto section = record.profiler().section("frame");
    const FrameView view = viewOf(frame, record.profiler());
    if (tracer) {
      for (std::size_t number = 0; number < frame.batches.size(); ++number) {
        if (number > 0) submitBatch(view, frame, number);
        finishBatch(view, frame, frame.batches[number]);
      }
    }
    compositePass.run(view, frame.gbuffer, CompositePass::Output::display, target.framebuffer, {target.x, target.y});
  }
  // Counts (selection, build, trace) are copied for the report.
  api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), shadowWarnings.begin(), shadowWarnings.end());
  MemoryReport held;
  held.geometry = scene.geometryBytes();
  held.textures = scene.textureBytes();
  held.shadowMaps = shadows.bytes();
  held.geometry += motionPass.bytes();
  held.peak = held.geometry + held.textures + held.shadowMaps;
  for (const Frame& each : frames) {
    held.queues += each.bytes() - each.gbuffer.bytes();
    held.peak += each.bytes();
  }
  record.end(frame, tracer.get(), held, std::move(warnings));
  shown = work.frame;
  reported = work.record;
  unreported.push_back(work.record);
}

void Renderer::Impl::noteChange(const SceneChange& changed) {
  change.add(changed);
  moved.insert(moved.end(), changed.moved.begin(), changed.moved.end());
  shadowSettings.reset();
  shown.reset();  // its layers would show the changed scene
}

void Renderer::Impl::upload(const Scene& wanted, const SceneChange& changed) {
  try {
    motionPass.advance(scene);
    shadowChange.add(updateScene(api, scene, wanted, changed));
  } catch (...) {
    noteChange(changed);  // some of it may have been written
    shadowChange.everything = true;
    throw;
  }
  shadowChange.everything |= changed.materials;
  if (changed.lights) lights = wanted.lights;
  if (changed.sky) sky = wanted.sky;
  noteChange(changed);
}

Renderer::Renderer(const std::function<Proc(const char*)>& getProcAddress, TracerFactory exact)
    : Renderer(getProcAddress,
               exact ? std::vector<Method>{{methodInfo("exact"), std::move(exact)}} : std::vector<Method>()) {}
Renderer::Renderer(const std::function<Proc(const char*)>& getProcAddress, std::vector<Method> methods)
    : impl_(std::make_unique<Impl>(getProcAddress, std::move(methods))) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

DeviceInfo Renderer::device() const {
  return {impl_->api.vendor, impl_->api.renderer, impl_->api.version, impl_->api.software};
}

void Renderer::setScene(const Scene& scene) {
  Impl& r = *impl_;
  if (!r.underWay.empty()) throw Error(ErrorKind::usage, "setScene(): a frame is under way, finish() it first");
  const gl::StateGuard guard(r.api);
  r.hasScene = false;
  r.shown.reset();
  r.reported.reset();
  r.unreported.clear();
  r.tracer.reset();  // it knows the old scene
  r.tracerSettings.reset();
  r.shadowSettings.reset();
  r.shadowChange = {};
  r.scene = GpuScene();  // its memory goes before the new one's comes
  r.scene = uploadScene(r.api, scene);
  r.lights = scene.lights;
  r.sky = scene.sky;
  r.change = SceneChange::everything();
  r.moved.clear();
  r.motionPass.forget();
  r.hasScene = true;
}

void Renderer::update(const Scene& scene, const SceneChange& change) {
  Impl& r = *impl_;
  if (!r.hasScene) throw Error(ErrorKind::usage, "update() needs a scene: call setScene() first");
  if (!r.underWay.empty()) throw Error(ErrorKind::usage, "update(): a frame is under way, finish() it first");
  if (change.topology) throw Error(ErrorKind::usage, "update(): another topology is another scene, call setScene()");
  if (!change.any()) return;
  const gl::StateGuard guard(r.api);
  r.upload(scene, change);
}

void Renderer::updateVertices(const Scene& scene, std::span<const VertexRange> ranges) {
  if (ranges.empty() && impl_->hasScene) return;
  update(scene, {.lights = true, .moved = {ranges.begin(), ranges.end()}});
}

void Renderer::forgetStructures() {
  if (impl_->tracer) impl_->tracer->forget();
}

void Renderer::begin(const Camera& camera, const Settings& settings, int width, int height) {
  const gl::StateGuard guard(impl_->api);
  impl_->begin(camera, settings, width, height);
}

void Renderer::finish(const Target& target) {
  const gl::StateGuard guard(impl_->api);
  impl_->finish(target);
}

void Renderer::render(const Camera& camera, const Settings& settings, const Target& target) {
  if (!impl_->underWay.empty()) throw Error(ErrorKind::usage, "render(): a frame is under way, finish() it first");
  const gl::StateGuard guard(impl_->api);
  impl_->begin(camera, settings, target.width, target.height);
  impl_->finish(target);
}

FrameReport Renderer::report() {
  Impl& r = *impl_;
  if (!r.reported) throw Error(ErrorKind::usage, "report() needs a finished frame: call render() first");
  const gl::StateGuard guard(r.api);
  r.unreported.clear();  // arrivedReport() does not go back
  return r.records[*r.reported].report();
}

std::optional<FrameReport> Renderer::arrivedReport() {
  Impl& r = *impl_;
  const auto newest = std::find_if(r.unreported.rbegin(), r.unreported.rend(),
                                   [&r](std::size_t record) { return r.records[record].arrived(); });
  if (newest == r.unreported.rend()) return std::nullopt;
  FrameReport report = r.records[*newest].report();
  r.unreported.erase(r.unreported.begin(), newest.base());
  return report;
}

std::vector<std::string> Renderer::reloadShaders() {
  if (!impl_->underWay.empty())
    throw Error(ErrorKind::usage, "reloadShaders(): a frame is under way, finish() it first");
  const gl::StateGuard guard(impl_->api);
  return gl::reloadPrograms(impl_->api);
}

Image Renderer::readLayers() const {
  Impl& r = *impl_;
  if (!r.shown)
    throw Error(ErrorKind::usage,
                "readLayers() needs a finished frame of the present scene whose memory no begin() has taken");
  const gl::StateGuard guard(r.api);
  Frame& frame = r.frames[*r.shown];
  const gl::Texture linear(r.api, {.format = GL_RGBA32F, .width = frame.gbuffer.width, .height = frame.gbuffer.height},
                           "linear picture");
  const gl::Framebuffer framebuffer(r.api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, linear);
  gl::Profiler untimed(r.api);
  r.compositePass.run(r.viewOf(frame, untimed), frame.gbuffer, CompositePass::Output::linear, framebuffer.name(),
                      {0, 0});
  // Images and buffers (all stages) are read by the host.
  r.api.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (!r.rayReader) r.rayReader.emplace(r.api);
  const std::vector<shared::RayWork> work = r.reported && r.keepsWork() ? r.readWork() : std::vector<shared::RayWork>();
  return assembleLayers(r.viewOf(frame, untimed), linear, frame.batches, work, *r.rayReader);
}

std::optional<Picked> Renderer::pick(int x, int y) const {
  const Impl& r = *impl_;
  if (!r.shown)
    throw Error(ErrorKind::usage, "pick() needs a finished frame of the present scene: call render() first");
  const GBuffer& gbuffer = r.frames[*r.shown].gbuffer;
  if (x < 0 || y < 0 || x >= gbuffer.width || y >= gbuffer.height) return std::nullopt;
  const gl::StateGuard guard(r.api);
  const gl::Framebuffer framebuffer(r.api);
  r.api.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.name());
  // The G-buffer's images are read by the host.
  r.api.MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);
  GLuint visible = 0;
  framebuffer.attach(GL_COLOR_ATTACHMENT0, gbuffer.visibility);
  r.api.ReadPixels(x, y, 1, 1, GL_RED_INTEGER, GL_UNSIGNED_INT, &visible);
  if (visible == 0) return std::nullopt;
  glm::vec4 position(0);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, gbuffer.position);
  r.api.ReadPixels(x, y, 1, 1, GL_RGBA, GL_FLOAT, &position);
  return Picked{visible - 1, glm::vec3(position)};
}

StructureCells Renderer::readStructure() const {
  if (!impl_->tracer) return {};
  const gl::StateGuard guard(impl_->api);
  // Builds write the structure's buffers; the host reads them.
  impl_->api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return impl_->tracer->cells();
}

std::vector<RayWork> Renderer::readRayWork() {
  Impl& r = *impl_;
  if (!r.shown || !r.reported)
    throw Error(ErrorKind::usage, "readRayWork() needs a finished frame of the present scene: call render() first");
  const gl::StateGuard guard(r.api);
  if (!r.tracer || !r.tracer->rayWork()) return {};
  if (!r.keepsWork())
    throw Error(ErrorKind::usage, r.underWay.empty()
                                      ? "readRayWork() needs a frame of one bounce whose rays come in one batch"
                                      : "readRayWork(): a frame is under way, finish() it first");
  std::vector<RayWork> result;
  for (const shared::RayWork& work : r.readWork()) result.push_back({work.steps, work.tests});
  return result;
}

}  // namespace halfsilver
