#include <algorithm>
#include <utility>

#include <halfsilver/error.h>
#include "frame/frame_constants.h"
#include "frame/layers.h"
#include "gl/framebuffer.h"
#include "gl/state_guard.h"
#include "renderer_impl.h"

namespace halfsilver {

// The tracer keeps the work of the queue that it traced last: that of the shown frame, if it was the only one.
bool Renderer::Impl::keepsWork() const {
  const Frame& frame = frames[*shown];
  return tracer && tracer->rayWork() && underWay.empty() && frame.settings.trace.countWork &&
         frame.batches.size() == 1 && effect->generations(frame.settings, frame.host) == 1;
}

std::vector<shared::RayWork> Renderer::Impl::readWork() {
  const gl::Buffer& work = *tracer->rayWork();
  const std::uint64_t rays = records[*reported].report().selected;
  return work.read<shared::RayWork>(std::min<std::size_t>(rays, work.bytes() / sizeof(shared::RayWork)));
}

// Who has answered the first rays, batch by batch; nothing if the method does not say so.
std::vector<std::vector<std::uint32_t>> Renderer::Impl::readAnswers() const {
  std::vector<std::vector<std::uint32_t>> all;
  if (!tracer || effect->startsAtCamera()) return all;  // whose first rays nobody has traced
  for (const RayBatch& batch : frames[*shown].batches) {
    const gl::Buffer* answers = tracer->answers(batch.rays);
    if (!answers) return {};
    all.push_back(answers->read<std::uint32_t>(batch.rays.count.read<shared::RayCount>(1)[0].count));
  }
  return all;
}

const SurfaceReader& Renderer::Impl::surfaces() {
  if (!surfaceReader) surfaceReader.emplace(api);
  return *surfaceReader;
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
  r.picture.readLinear(r.viewOf(frame, untimed), frame, framebuffer.name());
  // Images and buffers (all stages) are read by the host.
  r.api.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (!r.rayReader) r.rayReader.emplace(r.api);
  const std::vector<shared::RayWork> work = r.reported && r.keepsWork() ? r.readWork() : std::vector<shared::RayWork>();
  Image layers = assembleLayers(r.viewOf(frame, untimed), linear, frame.batches, work, r.readAnswers(), r.surfaces(),
                                *r.rayReader);
  return frame.tally.any() ? withTally(std::move(layers), frame.tally, static_cast<double>(frame.host.diagonal))
                           : layers;
}

std::optional<Picked> Renderer::pick(int x, int y) const {
  Impl& r = *impl_;
  if (!r.shown)
    throw Error(ErrorKind::usage, "pick() needs a finished frame of the present scene: call render() first");
  Frame& frame = r.frames[*r.shown];
  const GBuffer& gbuffer = frame.gbuffer;
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
  gl::Profiler untimed(r.api);
  const Surfaces there = r.surfaces().read(r.viewOf(frame, untimed), x, y, 1, 1);
  return Picked{visible - 1, glm::vec3(there.positions.front())};
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

CameraMatrices Renderer::matrices(const Camera& camera, const Target& target) const {
  if (!impl_->hasScene) throw Error(ErrorKind::usage, "matrices() needs a scene: call setScene() first");
  return cameraMatrices(camera, impl_->scene.extents.bounds(), target);
}

// A device that was reset has lost the frame.
void Renderer::Impl::checkDevice() const {
  if (api.GetGraphicsResetStatus() != GL_NO_ERROR)
    throw Error(ErrorKind::failed, "the device was reset while it drew, and the frame is lost");
}

FrameReport Renderer::report() {
  Impl& r = *impl_;
  r.checkDevice();
  if (!r.reported) throw Error(ErrorKind::usage, "report() needs a finished frame: call render() first");
  const gl::StateGuard guard(r.api);
  r.unreported.clear();  // arrivedReport() does not go back
  return r.records[*r.reported].report();
}

std::optional<FrameReport> Renderer::arrivedReport() {
  Impl& r = *impl_;
  r.checkDevice();
  const auto newest = std::find_if(r.unreported.rbegin(), r.unreported.rend(),
                                   [&r](std::size_t record) { return r.records[record].arrived(); });
  if (newest == r.unreported.rend()) return std::nullopt;
  FrameReport report = r.records[*newest].report();
  r.unreported.erase(r.unreported.begin(), newest.base());
  return report;
}

}  // namespace halfsilver
