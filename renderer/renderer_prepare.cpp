#include <algorithm>

#include <halfsilver/error.h>
#include "gl/framebuffer.h"
#include "gl/state_guard.h"
#include "renderer_impl.h"

namespace halfsilver {
namespace {

constexpr int kSize = 16;  // pixels along an edge

// From outside, obliquely, so that all of it is in view.
Camera overview(const Bounds& bounds) {
  const float distance = 1.1f * std::max(bounds.diagonal(), 1e-3f);
  Camera camera;
  camera.target = bounds.center();
  camera.eye = camera.target + distance * glm::normalize(glm::vec3(1, 0.8f, 1.3f));
  return camera;
}

}  // namespace

// Frames as a caller would draw them: what a method or an effect makes only when it is first needed is made by needing
// it.
void Renderer::Impl::prepare(const Settings& wanted, DepthUse depth) {
  const gl::Texture color(api, {.format = GL_RGBA8, .width = kSize, .height = kSize}, "prepared picture");
  const gl::Texture depths(api, {.format = GL_DEPTH_COMPONENT32F, .width = kSize, .height = kSize}, "prepared depth");
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
  framebuffer.attach(GL_DEPTH_ATTACHMENT, depths);
  const Target target{framebuffer.name(), 0, 0, kSize, kSize, depth};
  const Camera camera = overview(scene.extents.bounds());
  const auto draw = [&](const std::optional<std::uint32_t>& sample) {
    begin(camera, wanted, kSize, kSize, sample);
    finish(target);
  };
  draw({});
  // Something has moved: to where it is.
  noteChange({.moved = {{0, std::min(3u, scene.vertexCount)}}});
  draw({});
  draw(0);
  picture.forget();
  motionPass.forget();
  shown.reset();
  reported.reset();
  unreported.clear();
  api.Finish();
}

void Renderer::prepare(const Settings& settings, DepthUse depth) {
  Impl& r = *impl_;
  if (!r.hasScene) throw Error(ErrorKind::usage, "prepare() needs a scene: call setScene() first");
  if (!r.underWay.empty()) throw Error(ErrorKind::usage, "prepare(): a frame is under way, finish() it first");
  const gl::StateGuard guard(r.api);
  r.prepare(settings, depth);
}

}  // namespace halfsilver
