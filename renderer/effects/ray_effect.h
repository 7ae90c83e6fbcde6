#pragma once

#include <memory>

#include <halfsilver/frame_view.h>
#include <halfsilver/settings.h>

namespace halfsilver {

// An effect turns a G-buffer into rays and their hits into light: one folder under effects/ each, on any Tracer. Rays
// of one frame come in several batches if a storage block cannot hold what belongs to all; each goes through
//
//   spawn(), measure(), then for each generation: Tracer::trace() and shade(), then resolve().
//
// Every call binds what its shaders read and starts from no state.
class RayEffect {
 public:
  virtual ~RayEffect() = default;

  // How many batches a frame needs so that none has more than `maxRays`; one queue holds a batch.
  virtual int batches(const GBuffer& gbuffer, std::uint32_t maxRays) const = 0;
  // How many times hits may send on rays, the first rays included: at least 1.
  virtual int generations(const Settings& settings) const = 0;

  // Fills the queue with batch number `batch` of `batches`: first rays, their count and the size of their dispatch.
  // The G-buffer is shaded if spawnReadsShading(). Batch 0 begins the contributions, which all batches count. Allocates
  // what is too small.
  virtual void spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) = 0;

  // Whether rays cannot be spawned before the G-buffer is shaded.
  virtual bool spawnReadsShading(const Settings& settings) const = 0;

  // What reports want to know of the first rays of a batch and only the shaded G-buffer tells.
  virtual void measure(const FrameView& view, const RayQueue& first, EffectFrame& frame) = 0;

  // Adds the light of the hits to the rays' slots, which generation 0 begins. `next` receives the rays of the next
  // generation, with their count and dispatch, and grows to hold as many as there can be; it is null in the last
  // generation.
  virtual void shade(const FrameView& view, const RayQueue& rays, const Hits& hits, int generation, RayQueue* next,
                     EffectFrame& frame) = 0;

  // Brings the light of a batch's slots to the pixels. `first` is the queue that spawn() filled.
  virtual void resolve(const FrameView& view, const RayQueue& first, const EffectFrame& frame, GBuffer& gbuffer) = 0;
};

// The effect that the settings name.
std::unique_ptr<RayEffect> makeEffect(const gl::Api& api, const Settings& settings);

}  // namespace halfsilver
