#include <halfsilver/renderer.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include <halfsilver/error.h>
#include <halfsilver/tracer.h>
#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "frame/layers.h"
#include "gl/framebuffer.h"
#include "gl/state_guard.h"
#include "passes/composite.h"
#include "passes/gbuffer.h"
#include "passes/select.h"
#include "passes/shade.h"
#include "passes/shade_hits.h"
#include "passes/shadows.h"

namespace halfsilver {
namespace {

// What a tracer is made from; another value needs another tracer.
auto tracerKey(const Settings& s) { return std::tuple(s.scene, s.voxels, s.abuffer, s.search, s.trace); }

// What the shadow maps depend on besides the scene.
auto shadowKey(const Settings& s) { return std::tuple(s.shadow, s.scene); }

std::uint64_t bytesOf(const RayQueue& queue) { return queue.rays.bytes() + queue.count.bytes(); }
std::uint64_t bytesOf(const Hits& hits) { return hits.hits.bytes() + hits.surfaces.bytes(); }

std::uint64_t bytesOf(const GpuScene& scene) {
  std::uint64_t bytes = scene.positions.bytes() + scene.attributes.bytes() + scene.triangles.bytes() +
                        scene.materials.bytes() + scene.drawList.bytes() + scene.sky.bytes();
  for (const gl::Texture& texture : scene.textures) bytes += texture.bytes();
  return bytes;
}

}  // namespace

struct Renderer::Impl {
  Impl(const std::function<Proc(const char*)>& getProcAddress, TracerFactory exactTracer)
      : api(gl::Api::load(getProcAddress)), exact(std::move(exactTracer)) {}

  gl::Api api;
  TracerFactory exact;
  gl::Profiler profiler{api};
  gl::Buffer constants{api, sizeof(shared::FrameConstants), "frame constants"};
  ShadowPass shadowPass{api};
  GBufferPass gbufferPass{api};
  SelectPass selectPass{api};
  ShadePass shadePass{api};
  ShadeHitsPass shadeHitsPass{api};
  CompositePass compositePass{api};

  GpuScene scene;
  std::vector<Light> lights;
  Sky sky;
  bool hasScene = false;

  // Products that live from frame to frame. Queue and hits 0 are the first bounce's, which the layers show; later
  // bounces take turns with the others.
  ShadowMaps shadows;
  bool shadowsStale = true;
  GBuffer gbuffer;
  Contributions contributions;
  RayQueue queues[3];
  Hits hits[2];
  std::unique_ptr<Tracer> tracer;
  std::optional<Settings> settings;  // of the last frame
  std::vector<std::string> shadowWarnings;

  void useSettings(const Settings& wanted);
  void uploadConstants(const Camera& camera, int width, int height);
  void prepareBounce(RayQueue& queue, Hits& result) const;
  void traceReflections();
  void render(const Camera& camera, const Settings& wanted, const Target& target);
  FrameReport report();
};

void Renderer::Impl::useSettings(const Settings& wanted) {
  if (!settings || shadowKey(*settings) != shadowKey(wanted)) shadowsStale = true;
  if (!settings || tracerKey(*settings) != tracerKey(wanted)) {
    tracer.reset();  // its memory goes before the new one's comes
    settings.reset();
    tracer = makeTracer(api, wanted, exact);
  }
  settings = wanted;
}

void Renderer::Impl::uploadConstants(const Camera& camera, int width, int height) {
  const shared::FrameConstants frame =
      makeFrameConstants(camera, scene.bounds, sky, *settings, width, height, shadows.lightCount);
  constants.write(0, &frame, sizeof(frame));
  constants.bindUniform(UBO_FRAME);
}

void Renderer::Impl::prepareBounce(RayQueue& queue, Hits& result) const {
  if (queue.capacity != queues[0].capacity) {
    queue.rays = gl::Buffer(api, queues[0].rays.bytes(), "rays of a later bounce");
    queue.count = gl::Buffer(api, queues[0].count.bytes(), "ray count of a later bounce");
    queue.count.fill(0);
    queue.capacity = queues[0].capacity;
  }
  const std::size_t hitBytes = queue.capacity * sizeof(shared::Hit);
  if (result.hits.bytes() != hitBytes) result.hits = gl::Buffer(api, hitBytes, "hits");
  const std::size_t surfaceBytes = tracer->storesAttributes() ? queue.capacity * sizeof(shared::HitSurface) : 0;
  if (result.surfaces.bytes() != surfaceBytes) result.surfaces = gl::Buffer(api, surfaceBytes, "hit surfaces");
}

void Renderer::Impl::traceReflections() {
  prepareBounce(queues[0], hits[0]);
  for (int i : {1, 2})
    if (queues[i].count) queues[i].count.fill(0);  // their overflow adds up over the bounces that share a queue
  tracer->build(scene, queues[0], profiler);
  for (int bounce = 0; bounce < settings->trace.bounces; ++bounce) {
    const bool last = bounce + 1 == settings->trace.bounces;
    RayQueue& rays = queues[bounce == 0 ? 0 : 1 + (bounce - 1) % 2];
    RayQueue& next = queues[1 + bounce % 2];
    Hits& found = hits[bounce == 0 ? 0 : 1];
    if (!last) prepareBounce(next, hits[1]);
    tracer->trace(scene, rays, found, profiler);
    shadeHitsPass.run(rays, found, gbuffer, last ? nullptr : &next, profiler);
  }
}

// The whole frame; the stages are those of README.md.
void Renderer::Impl::render(const Camera& camera, const Settings& wanted, const Target& target) {
  if (!hasScene) throw Error(ErrorKind::usage, "render() needs a scene: call setScene() first");
  if (target.width < 1 || target.height < 1 || target.width > api.limits.framebufferSize ||
      target.height > api.limits.framebufferSize)
    throw Error(ErrorKind::usage, "a picture of " + std::to_string(target.width) + " x " +
                                      std::to_string(target.height) + " is beyond the device's limits (1 to " +
                                      std::to_string(api.limits.framebufferSize) + ")");
  const gl::StateGuard guard(api);
  profiler.discard();
  const auto frame = profiler.section("frame");
  useSettings(wanted);
  scene.bind();
  uploadConstants(camera, target.width, target.height);
  if (shadowsStale) {
    shadowWarnings = shadowPass.run(scene, lights, sky, *settings, shadows, profiler);
    shadowsStale = false;
    uploadConstants(camera, target.width, target.height);  // with the number of lights
  }
  gbufferPass.run(scene, gbuffer, target.width, target.height, settings->scene.cullBackFaces, profiler);
  scene.bind();
  shadows.bind();
  shadePass.run(gbuffer, profiler);
  if (tracer)
    selectPass.run(gbuffer, queues[0], contributions, profiler);
  else
    queues[0] = RayQueue();  // a ray for each pixel is much memory for nothing
  scene.bind();
  shadeHitsPass.clear(gbuffer, profiler);
  if (tracer)
    traceReflections();
  else
    hits[0] = Hits();
  scene.bind();
  compositePass.run(gbuffer, CompositePass::Output::display, target.framebuffer, {target.x, target.y}, profiler);
  scene.moved.clear();
  scene.drawnGeometry = scene.geometry;
}

FrameReport Renderer::Impl::report() {
  FrameReport report;
  report.pixels = static_cast<std::uint64_t>(gbuffer.width) * static_cast<std::uint64_t>(gbuffer.height);
  for (const gl::SectionTime& time : profiler.collect()) report.times.push_back({time.name, time.milliseconds});
  // Counts (selection, trace) are read by the host.
  api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto count = [](const RayQueue& queue) {
    return queue.count ? queue.count.read<shared::RayCount>(1)[0] : shared::RayCount{};
  };
  // Rays that nobody traces are no selection: the layers say so too.
  report.selected = tracer ? count(queues[0]).count : 0;
  report.reflecting = tracer ? count(queues[0]).reflecting : 0;
  if (tracer) {
    const std::vector<GLuint> counts = contributions.counts.read<GLuint>(CONTRIBUTION_CLASSES);
    report.contributions.assign(counts.begin(), counts.end());
  }
  report.warnings = scene.warnings;
  report.warnings.insert(report.warnings.end(), shadowWarnings.begin(), shadowWarnings.end());

  MemoryReport& memory = report.memory;
  std::uint64_t transient = 0;
  if (tracer) {
    const TracerMemory held = tracer->memory();
    memory.voxels = held.voxels;
    for (int axis = 0; axis < 3; ++axis) memory.grid[axis] = held.grid[axis];
    memory.heads = held.heads;
    memory.poolReserved = held.poolReserved;
    memory.poolUsed = held.poolUsed;
    memory.fragments = held.fragments;
    memory.fragmentsStored = held.fragmentsStored;
    std::copy(std::begin(held.perAxis), std::end(held.perAxis), std::begin(memory.fragmentsPerAxis));
    memory.bytesPerFragment = held.bytesPerFragment;
    memory.structureTotal = held.structureTotal;
    transient = held.transient;
    report.lostFragments = tracer->lostFragments();
    report.overflow = count(queues[0]).overflow;
    for (int bounce = 1; bounce < std::min(settings->trace.bounces, 3); ++bounce)
      report.overflow += count(queues[bounce]).overflow;
  }
  memory.gbuffer = gbuffer.bytes();
  memory.peak = bytesOf(scene) + shadows.lights.bytes() + shadows.maps.bytes() + memory.gbuffer + constants.bytes() +
                contributions.counts.bytes() + memory.structureTotal + transient;
  for (const RayQueue& queue : queues) memory.peak += bytesOf(queue);
  for (const Hits& result : hits) memory.peak += bytesOf(result);
  return report;
}

Renderer::Renderer(const std::function<Proc(const char*)>& getProcAddress, TracerFactory exact)
    : impl_(std::make_unique<Impl>(getProcAddress, std::move(exact))) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

DeviceInfo Renderer::device() const {
  return {impl_->api.vendor, impl_->api.renderer, impl_->api.version, impl_->api.software};
}

void Renderer::setScene(const Scene& scene) {
  const gl::StateGuard guard(impl_->api);
  impl_->hasScene = false;
  impl_->tracer.reset();  // it knows the old scene
  impl_->settings.reset();
  impl_->scene = GpuScene();  // its memory goes before the new one's comes
  impl_->scene = uploadScene(impl_->api, scene);
  impl_->lights = scene.lights;
  impl_->sky = scene.sky;
  impl_->shadowsStale = true;
  impl_->hasScene = true;
}

void Renderer::updateVertices(const Scene& scene, std::span<const VertexRange> ranges) {
  if (!impl_->hasScene) throw Error(ErrorKind::usage, "updateVertices() needs a scene: call setScene() first");
  if (ranges.empty()) return;
  const gl::StateGuard guard(impl_->api);
  halfsilver::updateVertices(impl_->scene, scene, ranges);
  impl_->lights = scene.lights;
  impl_->shadowsStale = true;
}

void Renderer::forgetStructures() {
  // Kept structures are of the geometry that was drawn last.
  ++impl_->scene.geometry;
  impl_->scene.drawnGeometry = impl_->scene.geometry;
}

void Renderer::render(const Camera& camera, const Settings& settings, const Target& target) {
  impl_->render(camera, settings, target);
}

FrameReport Renderer::report() {
  if (!impl_->settings) throw Error(ErrorKind::usage, "report() needs a frame: call render() first");
  const gl::StateGuard guard(impl_->api);
  return impl_->report();
}

Image Renderer::readLayers() const {
  Impl& r = *impl_;
  if (!r.settings) throw Error(ErrorKind::usage, "readLayers() needs a frame: call render() first");
  const gl::StateGuard guard(r.api);
  const gl::Texture linear(r.api, {.format = GL_RGBA32F, .width = r.gbuffer.width, .height = r.gbuffer.height},
                           "linear picture");
  const gl::Framebuffer framebuffer(r.api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, linear);
  r.scene.bind();
  r.constants.bindUniform(UBO_FRAME);
  gl::Profiler untimed(r.api);
  r.compositePass.run(r.gbuffer, CompositePass::Output::linear, framebuffer.name(), {0, 0}, untimed);
  // Images and buffers (all stages) are read by the host.
  r.api.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  return assembleLayers(r.scene, r.gbuffer, linear, r.queues[0], r.hits[0]);
}

}  // namespace halfsilver
