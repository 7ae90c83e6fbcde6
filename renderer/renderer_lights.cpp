#include "renderer_impl.h"

// How a frame's direct lights find their shadows: by maps, by rays, or by both.
namespace halfsilver {

// Whether rays find the shadows of direct lights: all of them, or those of hits and of pixels that are in doubt.
bool Renderer::Impl::lightsByRays(const Settings& wanted) const {
  return wanted.shadow.method != ShadowMethod::maps && tracer && effect->usesLightRays();
}

bool Renderer::Impl::marksShadows(const Settings& wanted) const {
  return wanted.shadow.method == ShadowMethod::refined && tracer &&
         (effect->usesLightRays() || effect->readsShadowMarks());
}

ShadowSettings Renderer::Impl::shadowsOf(const Settings& wanted) const {
  ShadowSettings used = wanted.shadow;
  if (!lightsByRays(wanted) && !marksShadows(wanted)) used.method = ShadowMethod::maps;
  used.kernel = ShadowSettings().kernel;  // maps are the same for all
  return used;
}

void Renderer::Impl::drawShadows(const Camera& camera, float aspect, const Settings& wanted, gl::Profiler& profiler) {
  const ShadowSettings used = shadowsOf(wanted);
  // Parallel rays may start anywhere on their way.
  const glm::vec3& from = camera.parallelHeight > 0 ? camera.target : camera.eye;
  ShadowBoxes boxes = shadowBoxes(scene.clusters.all(), scene.extents.bounds(), shadowPass.resolutionOf(used), from);
  if (used.projection == ShadowProjection::perspective)
    boxes.seen = visibleBody(camera, aspect, scene.extents.bounds());
  if (shadowSettings == used && shadowsShow == boxes) return;
  shadowSettings.reset();
  shadowWarnings = shadowPass.run(scene, lights, sky, used, boxes, shadowChange, shadows, profiler);
  shadowsShow = boxes;
  if (used.method != wanted.shadow.method)
    shadowWarnings.emplace_back(
        "shadow.method=rays is for trace.effect=reflection, refined for that and whitted, with a method that traces; "
        "shadow maps are used");
  shadowSettings = used;
  shadowChange = {.everything = false, .moved = {}};
}

void Renderer::Impl::markShadows(const FrameView& view, const Settings& wanted, GBuffer& gbuffer) {
  if (marksShadows(wanted))
    shadowMarkPass.run(view, wanted.shadow.kernel, gbuffer);
  else
    gbuffer.shadowMarks = gl::Texture();
}

LightRays::Trace Renderer::Impl::tracing(const FrameView& view, const Frame& frame) {
  return [this, &view, &frame](const RayQueue& rays, Hits& hits, bool any) {
    reserveHits(api, rays, tracer->storesAttributes(), hits);
    if (any)
      tracer->occluded(view, rays, hits);
    else
      tracer->trace(view, rays, hits);
    if (frame.tally.any()) tallyPass.add(view, rays, hits, any, frame.tally);
  };
}

}  // namespace halfsilver
