#include "renderer_impl.h"

#include <algorithm>

#include <halfsilver/error.h>
#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "gl/program.h"
#include "gl/state_guard.h"
#include "scene/rig_check.h"
#include "scene/vertex_ranges.h"

namespace halfsilver {

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

bool Renderer::Impl::blends(const Settings& wanted) const {
  return effect->blends(wanted, scene, tracer && tracer->seesBehind());
}

void Renderer::Impl::useEffect(Effect wanted) {
  if (effectName == wanted) return;
  effectName.reset();
  // What belongs to the rays of another effect has other sizes.
  for (Frame& frame : frames) frame.forgetRays();
  shown.reset();
  effect = makeEffect(api, wanted);
  effectName = wanted;
}

// The stages of README.md up to the rays.
void Renderer::Impl::begin(const Camera& camera, const Settings& wanted, int width, int height,
                           const std::optional<std::uint32_t>& sample) {
  if (!hasScene) throw Error(ErrorKind::usage, "begin() needs a scene: call setScene() first");
  if (underWay.size() == kFrames)
    throw Error(ErrorKind::usage, "begin(): two frames are under way, finish() one first");
  if (!underWay.empty() && (!sameTracer(api, *tracerSettings, wanted, methods) || shadowSettings != shadowsOf(wanted) ||
                            effectName != wanted.trace.effect))
    throw Error(ErrorKind::usage,
                "begin(): the settings need another tracer, effect or shadow maps while a frame is under way");
  if (width < 1 || height < 1 || width > api.limits.framebufferSize || height > api.limits.framebufferSize)
    throw Error(ErrorKind::usage, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                      " is beyond the device's limits (1 to " +
                                      std::to_string(api.limits.framebufferSize) + ")");
  const Work work{underWay.empty() ? 0 : 1 - underWay.front().frame, takeRecord()};
  try {
    start(work, camera, wanted, {width, height}, sample);
  } catch (...) {
    picture.forget();  // it counts on a frame that is not drawn
    throw;
  }
  underWay.push_back(work);
}

void Renderer::Impl::start(const Work& work, const Camera& camera, const Settings& wanted, const glm::ivec2& size,
                           const std::optional<std::uint32_t>& sample) {
  Frame& frame = frames[work.frame];
  FrameRecord& record = records[work.record];
  record.begin();
  const auto section = record.profiler().section("frame");
  useTracer(wanted);
  useEffect(wanted.trace.effect);
  if (rig) posePass.run(*rig, scene, wanted.scene.posing, record.profiler());
  drawShadows(camera, static_cast<float>(size.x) / static_cast<float>(size.y), wanted, record.profiler());
  const PictureUse use = picture.begin(camera, wanted, size, sample);
  shared::FrameConstants constants =
      makeFrameConstants(camera, scene.extents.bounds(), sky, wanted, size.x, size.y, shadows.ranges, use.jitter);
  constants.allLight = effect->bringsAllLight() ? 1 : 0;
  constants.blends = blends(wanted) ? 1 : 0;
  // Others know what a mirror shows, or the screen.
  const bool seesGlass = tracer && (tracer->seesBehind() || tracer->storesAttributes());
  constants.transmission =
      seesGlass && effect->showsClear(wanted) && !effect->bringsAllLight() && scene.clearMaterials > 0 ? 1 : 0;
  constants.coats = effect->showsCoats() && !effect->bringsAllLight() && scene.coatedMaterials > 0 ? 1 : 0;
  if (lightsByRays(wanted) || marksShadows(wanted)) constants.mappedLights = 0;
  constants.firstPass = use.passes.first;
  // Pixels are seen in mirrors and looked through.
  const int shaded = effect->generations(wanted, constants) * (constants.transmission != 0 ? 2 : 1);
  constants.traces = static_cast<std::uint32_t>(shaded - (effect->startsAtCamera() ? 1 : 0));
  if (effect->bringsAllLight()) constants.traces *= use.passes.count;
  if (shown == work.frame) shown.reset();
  frame.use = use;
  frame.passes = use.passes;
  if (!effect->bringsAllLight()) frame.passes = {.first = use.passes.first};  // what is blended is not summed
  frame.settings = wanted;
  frame.host = constants;
  if (!frame.constants) frame.constants = gl::Buffer(api, sizeof(frame.host), "frame constants");
  frame.constants.write(0, &frame.host, sizeof(frame.host));

  const FrameView view = viewOf(frame, record.profiler());
  gbufferPass.run(view, frame.gbuffer, wanted.primary);
  if (wanted.image.motion || use.kind == PictureUse::Kind::temporal) {
    motionPass.run(view, std::exchange(moved, {}), use.kind != PictureUse::Kind::sample || use.first, frame.gbuffer);
  } else {
    motionPass.forget();
    frame.gbuffer.motion = gl::Texture();
  }
  moved.clear();
  const bool byRays = lightsByRays(wanted);
  markShadows(view, wanted, frame.gbuffer);
  if (tracer) {
    for (RayQueue& queue : frame.queues)
      if (queue.count) queue.count.fill(0);  // overflow adds up over the generations that share a queue
    if (byRays) {
      frame.lightRays.forgetCounts();
      frame.host.traces += LightRays::traces(view, lights, shaded);
    } else {
      frame.lightRays = {};
      frame.effect.directLight = {};
    }
    if (wanted.trace.tally)
      tallyPass.begin(view, frame.tally);
    else
      frame.tally = {};
    // Some structures know holes.
    if (std::exchange(tracedBlends, view.frame.blends) != view.frame.blends) change = SceneChange::everything();
    tracer->update(view, change);
    frame.batches.resize(static_cast<std::size_t>(effect->batches(view, wanted, maxRays(wanted, frame.host))));
  } else {
    frame.tally = {};
    frame.batches.clear();  // no memory for rays that nobody traces
  }
  // Rays are on their way while the G-buffer is shaded, unless it says which ones there are.
  const bool through = frame.host.transmission != 0;
  const bool early = tracer && !byRays && !through && !effect->spawnReadsShading(wanted);
  if (early) submitBatch(view, frame, 0);
  if (byRays)
    lightRays.lightPixels(
        view, lights, tracing(view, frame),
        [&](int firstRow, int rows) { shadePass.run(view, frame.gbuffer, firstRow, rows); },
        static_cast<int>(frame.batches.size()), frame.lightRays);
  else
    shadePass.run(view, frame.gbuffer);
  if (through)
    seeThrough(view, frame);
  else
    frame.effect.behind = {};
  if (tracer && !early) submitBatch(view, frame, 0);
  change = {};
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
  try {
    const auto section = record.profiler().section("frame");
    const FrameView view = viewOf(frame, record.profiler());
    if (tracer) {
      for (std::size_t number = 0; number < frame.batches.size(); ++number) {
        if (number > 0) submitBatch(view, frame, number);
        finishBatch(view, frame, number);
      }
    }
    if (tracer && effect->looksAtScreen(frame.settings))
      screenLook.run(view, *effect, frame.effect, frame.gbuffer);
    else
      frame.effect.seen = {};
    if (frame.gbuffer.tested) interpolatePass.run(view, frame.settings.primary);
    picture.show(view, frame, motionPass.previousPositions(), target);
  } catch (...) {
    picture.forget();
    throw;
  }
  // Counts (selection, build, trace) and the signature are copied for the report.
  api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), shadowWarnings.begin(), shadowWarnings.end());
  const bool showsClear = effect->bringsAllLight() ? effect->showsClear(frame.settings) : frame.host.transmission != 0;
  if (scene.clearMaterials > 0 && !showsClear)
    warnings.push_back(
        std::to_string(scene.clearMaterials) +
        " material(s) transmit light, which the effects reflection, whitted and path show (trace.effect), "
        "the first one over methods that see behind surfaces and unless select.mode=none");
  if (scene.dispersingMaterials > 0 && showsClear && !effect->showsDispersion())
    warnings.push_back(std::to_string(scene.dispersingMaterials) +
                       " material(s) spread colors (dispersion), which only the effect whitted shows (trace.effect)");
  if (scene.coatedMaterials > 0 && !effect->showsCoats())
    warnings.push_back(std::to_string(scene.coatedMaterials) +
                       " material(s) have a clear coat, which the effect layers does not show (trace.effect)");
  if (scene.blendingMaterials > 0 && frame.host.blends == 0)
    warnings.push_back(std::to_string(scene.blendingMaterials) +
                       " material(s) with alphaMode BLEND are cut out where texture alpha times vertex alpha is below "
                       "0.5: exact methods blend them, and the effect layers does over all");
  MemoryReport held;
  held.geometry = scene.geometryBytes();
  held.textures = scene.textureBytes();
  held.shadowMaps = shadows.bytes();
  held.geometry += motionPass.bytes() + (rig ? rig->bytes() : 0);
  held.pictures = picture.bytes() + effect->bytes() + shadowMarkPass.bytes() + screenLook.bytes();
  held.peak = held.geometry + held.textures + held.shadowMaps + held.pictures;
  for (const Frame& each : frames) {
    held.queues += each.bytes() - each.gbuffer.bytes();
    held.peak += each.bytes();
  }
  held.largestBuffer = api.largestBuffer->bytes;
  held.largestBufferName = api.largestBuffer->label;
  record.end(frame, tracer.get(), held, std::move(warnings));
  shown = work.frame;
  reported = work.record;
  unreported.push_back(work.record);
}

void Renderer::Impl::noteChange(const SceneChange& changed) {
  change.add(changed);
  moved.insert(moved.end(), changed.moved.begin(), changed.moved.end());
  picture.changed();
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
  if (changed.lights) lights = wanted.lights;
  if (changed.lights && rig) rig->putInPlace(lights);
  if (changed.sky) sky = wanted.sky;
  noteChange(changed);
}

// Everything of the scene before goes.
void Renderer::Impl::load(const Scene& wanted, std::vector<PosedPart> posed) {
  hasScene = false;
  shown.reset();
  picture.forget();
  reported.reset();
  unreported.clear();
  tracer.reset();  // it knows the old scene
  tracerSettings.reset();
  shadowSettings.reset();
  shadowChange = {};
  scene = GpuScene();  // its memory goes before the new one's comes
  scene = uploadScene(api, wanted, std::move(posed));
  lights = wanted.lights;
  sky = wanted.sky;
  change = SceneChange::everything();
  moved.clear();
  motionPass.forget();
  hasScene = true;
}

void Renderer::Impl::pose(const PoseState& state) {
  motionPass.advance(scene);
  GpuRig::Change posed;
  try {
    rig->take(state, scene, posed);
  } catch (...) {
    if (posed.scene.any()) {
      noteChange(posed.scene);  // some of it may have been done
      shadowChange.everything = true;
    }
    throw;
  }
  posed.scene.lights = rig->follow(state, lights);
  if (!posed.scene.any()) return;
  shadowChange.add(posed.touched);
  noteChange(posed.scene);
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
  const gl::Api& api = impl_->api;
  return {api.vendor, api.renderer, api.version, api.software, api.programCounts->compiled, api.programCounts->cached};
}

void Renderer::restoreState(bool restores) { impl_->api.restoresState = restores; }

bool Renderer::traces(std::string_view method) const { return hasTracer(method, impl_->methods); }

void Renderer::setScene(const Scene& scene) {
  Impl& r = *impl_;
  if (!r.underWay.empty()) throw Error(ErrorKind::usage, "setScene(): a frame is under way, finish() it first");
  const gl::StateGuard guard(r.api);
  r.rig.reset();
  r.load(scene, {});
}

void Renderer::setModel(const Model& model) { setModel(model, animatedBounds(model)); }

void Renderer::setModel(const Model& model, const AnimatedBounds& bounds) {
  Impl& r = *impl_;
  if (!r.underWay.empty()) throw Error(ErrorKind::usage, "setModel(): a frame is under way, finish() it first");
  checkRig(model);
  if (bounds.instances.size() != model.rig.instances.size())
    throw Error(ErrorKind::usage, "setModel(): there are bounds of " + std::to_string(bounds.instances.size()) +
                                      " instances, the model has " + std::to_string(model.rig.instances.size()));
  const gl::StateGuard guard(r.api);
  r.hasScene = false;
  r.rig.reset();  // its memory goes before the new one's comes
  r.rig.emplace(r.api, model);
  r.load(model.scene, posedParts(model, bounds.instances));
}

void Renderer::pose(const PoseState& state) {
  Impl& r = *impl_;
  if (!r.hasScene || !r.rig) throw Error(ErrorKind::usage, "pose() needs a model: call setModel() first");
  if (!r.underWay.empty()) throw Error(ErrorKind::usage, "pose(): a frame is under way, finish() it first");
  const gl::StateGuard guard(r.api);
  r.pose(state);
}

void Renderer::update(const Scene& scene, const SceneChange& change) {
  Impl& r = *impl_;
  if (!r.hasScene) throw Error(ErrorKind::usage, "update() needs a scene: call setScene() first");
  if (!r.underWay.empty()) throw Error(ErrorKind::usage, "update(): a frame is under way, finish() it first");
  if (change.topology) throw Error(ErrorKind::usage, "update(): another topology is another scene, call setScene()");
  refusePosed(change, r.scene.extents.posed());
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

void Renderer::refine(const Camera& camera, const Settings& settings, const Target& target, std::uint32_t sample) {
  if (!impl_->underWay.empty()) throw Error(ErrorKind::usage, "refine(): a frame is under way, finish() it first");
  const gl::StateGuard guard(impl_->api);
  impl_->begin(camera, settings, target.width, target.height, sample);
  impl_->finish(target);
}

std::uint32_t Renderer::samples() const { return impl_->picture.samples(); }

void Renderer::forgetHistory() { impl_->picture.forget(); }

std::vector<std::string> Renderer::reloadShaders() {
  if (!impl_->underWay.empty())
    throw Error(ErrorKind::usage, "reloadShaders(): a frame is under way, finish() it first");
  const gl::StateGuard guard(impl_->api);
  impl_->picture.forget();
  return gl::reloadPrograms(impl_->api);
}

}  // namespace halfsilver
