#pragma once

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>

namespace halfsilver {

// What every stage of a frame may read. A stage binds of it what its own shaders use, at the dispatch.
struct FrameView {
  const GpuScene& scene;
  const ShadowMaps& shadows;
  const gl::Buffer& constants;          // FrameConstants, for UBO_FRAME
  const shared::FrameConstants& frame;  // the same on the host
  gl::Profiler& profiler;
  const GBuffer& gbuffer;  // of this frame, from the G-buffer pass on

  // What queuedRay() of shaders/lib/queued_ray.glsl reads of a queue: SSBO_RAYS, SSBO_RAY_COUNT, the frame's constants
  // and the G-buffer.
  void bindRays(const RayQueue& queue) const;
  // UNIT_COAT, of shaders that look there if FrameConstants::coats says so.
  void bindCoat() const;
  // What pixelLight() of shaders/lib/pixel_light.glsl reads: the G-buffer with its lit layers, the sky and the frame's
  // constants.
  void bindPixelLight() const;
};

}  // namespace halfsilver
