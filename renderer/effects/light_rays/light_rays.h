#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include <halfsilver/frame_view.h>
#include <halfsilver/scene.h>
#include "effects/ray_effect.h"
#include "effects/ray_queues.h"
#include "frame/surface_programs.h"
#include "gl/program.h"

namespace halfsilver {

// Of one frame: rays to lights on their way, and what they have brought.
struct LightRayFrame {
  std::array<RayQueue, 2> queues;  // the second one for what goes on behind clear surfaces
  Hits hits;
  gl::Buffer sums;  // LightSum by pixel of a band

  void forgetCounts();
  std::size_t bytes() const;
};

// Direct light by rays instead of shadow maps (shadow.method=rays, or where maps are in doubt refined): one ray from
// each surface to each light that it faces, shadow.samples to one that has an extent. Opaque surfaces stop it, clear
// ones take their share. Few lights at a time, so that the queues stay small; sums are in fixed point and depend on no
// order.
class LightRays {
 public:
  // Has the frame's tracer answer a queue, in hits that it makes room for; `any`: that something is hit is enough.
  using Trace = std::function<void(const RayQueue& rays, Hits& hits, bool any)>;

  explicit LightRays(const gl::Api& api) : api_(&api), count_(api) {}

  // At most so many first rays per batch of a frame that is lit this way.
  static constexpr std::uint32_t kRaysAtOnce = 1u << 19;

  // How often a frame whose rays come in one batch has a tracer trace; `shaded`: generations of hits.
  static std::uint32_t traces(const FrameView& view, std::span<const Light> lights, int shaded);

  // Has the deferred pass shade a band of the screen.
  using Shade = std::function<void(int firstRow, int rows)>;

  // Deferred shading with these lights: each band is shaded when its rays have been sent, since that takes the surfaces
  // that they start from, and what they bring is added to GBuffer::shaded; with GBuffer::shadowMarks, of the lights
  // that are in doubt. Sections "shade" and those of the tracer.
  void lightPixels(const FrameView& view, std::span<const Light> lights, const Trace& trace, const Shade& shade,
                   int batches, LightRayFrame& frame);
  // What the reflected rays of a step hit: adds to EffectFrame::directLight, which the first generation begins.
  // `passesOn`: rays go on behind what blends.
  void lightHits(const FrameView& view, std::span<const Light> lights, const Trace& trace, const RayQueue& rays,
                 const Hits& hits, const RayStep& step, bool passesOn, EffectFrame& effect, LightRayFrame& frame);

 private:
  // Rays to `count` lights; for those that have an extent the one of that number.
  struct Group {
    std::uint32_t first, count, number;
  };
  template <class Spawn>
  void follow(const FrameView& view, const Trace& trace, const gl::Buffer& sums, std::uint32_t firstPixel,
              std::uint32_t capacity, LightRayFrame& frame, const Spawn& spawn);
  void begin(const gl::Program& program, const FrameView& view, const Group& group, std::uint32_t capacity,
             LightRayFrame& frame) const;
  void gather(const FrameView& view, const RayQueue& rays, const Hits& hits, RayQueue* next, std::uint32_t capacity,
              const gl::Buffer& sums, std::uint32_t firstPixel);

  const gl::Api* api_;
  RayCountPass count_;
  // Made on first use.
  gl::Program fromPixels_[2][2][2], add_;          // [with GBuffer::shadowMarks][GpuScene::lobes][with coats]
  std::optional<SurfacePrograms> fromHits_[2][2];  // [queue of pixels][with HitSurface]
  std::optional<SurfacePrograms> gather_[2][2];    // [with HitSurface][last generation]
};

}  // namespace halfsilver
