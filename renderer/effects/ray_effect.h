#pragma once

#include <functional>
#include <memory>

#include <halfsilver/frame_view.h>
#include <halfsilver/settings.h>

namespace halfsilver {

// Passes of rays whose light a frame shows as their mean.
struct RayPasses {
  std::uint32_t first = 0;  // the number of the frame's first, which chooses its random numbers
  std::uint32_t count = 1;
  std::uint32_t summed = 0;  // of frames before, which are in the picture, too
};

// Surfaces that let light through and that a ray may pass after the depth of its effect: two walls.
inline constexpr int kPassedSurfaces = 4;

// Where a frame is among its rays.
struct RayStep {
  int generation = 0;      // 0: first rays
  std::uint32_t pass = 0;  // its number
  bool begins = true;      // it is the first of the picture
  int batch = 0;
};

// Has a queue answered, in hits that it makes room for.
using AnswerQueue = std::function<void(const RayQueue& rays, Hits& hits)>;

// An effect turns a G-buffer into rays and their hits into light: one folder under effects/ each, on any Tracer. Rays
// of one frame come in several batches if a storage block cannot hold what belongs to all; each goes through
//
//   spawn(), measure(), then per pass and generation: Tracer::trace() and shade(), then resolve().
//
// When all are through, lookAtScreen() may follow.
//
// Every call binds what its shaders read and starts from no state.
class RayEffect {
 public:
  virtual ~RayEffect() = default;

  // How many batches a frame needs so that none of its queues has more than `maxRays`.
  virtual int batches(const FrameView& view, const Settings& settings, std::uint32_t maxRays) const = 0;
  // How many times hits may send on rays, the first rays included: at least 1. `frame` says what is seen through.
  virtual int generations(const Settings& settings, const shared::FrameConstants& frame) const = 0;

  // Whether first rays are stored, not pixels.
  virtual bool storesFirstRays(const Settings&) const { return false; }
  // Whether what a pixel's rays bring is all of its light. If not, it is the share that the surface reflects.
  virtual bool bringsAllLight() const { return false; }
  // Whether its hits are lit as deferred pixels are, so that rays may find their shadows (shadow.method).
  virtual bool usesLightRays() const { return false; }
  // Whether it asks GBuffer::shadowMarks which lights of a pixel need no rays (shadow.method = refined).
  virtual bool readsShadowMarks() const { return false; }
  // Whether surfaces that transmit, or that have a coat, look so. If it blends, it sees through the first ones by rays
  // of their own.
  virtual bool showsClear(const Settings&) const { return false; }
  virtual bool showsDispersion() const { return false; }
  virtual bool showsCoats() const { return false; }
  // Whether first rays are the camera's, which firstHits() answers; otherwise a tracer does.
  virtual bool startsAtCamera() const { return false; }

  // Whether it is enough to know of that generation's rays that they meet something.
  virtual bool asksForAnyHit(int /*generation*/, const shared::FrameConstants&) const { return false; }
  // Whether it composes what lies behind surfaces of AlphaMode::blend; if not, they are cut at a half. `seesBehind`:
  // Tracer::seesBehind().
  virtual bool blends(const Settings&, const GpuScene&, bool /*seesBehind*/) const { return false; }

  // Fills the queue with batch number `batch` of `batches`: first rays, their count and the size of their dispatch.
  // The G-buffer is shaded if spawnReadsShading(). Batch 0 begins the contributions, which all batches count. Allocates
  // what is too small.
  virtual void spawn(const FrameView& view, int batch, int batches, RayQueue& out, EffectFrame& frame) = 0;
  virtual void firstHits(const FrameView&, const RayQueue&, Hits&) {}

  // Whether rays cannot be spawned before the G-buffer is shaded.
  virtual bool spawnReadsShading(const Settings&) const { return false; }

  // What reports want to know of the first rays of a batch and only the shaded G-buffer tells.
  virtual void measure(const FrameView&, const RayQueue&, EffectFrame&) {}

  // Adds the light of the hits to what their pixels have. `next` receives the rays of the next generation, with their
  // count and dispatch, and grows to hold as many as there can be; it is null in the last generation.
  virtual void shade(const FrameView& view, const Settings& settings, const RayQueue& rays, const Hits& hits,
                     const RayStep& step, RayQueue* next, EffectFrame& frame) = 0;

  // Brings the light of a batch to the pixels. `first` is the queue that spawn() filled.
  virtual void resolve(const FrameView& view, const Settings& settings, const RayQueue& first, const RayPasses& passes,
                       int batch, EffectFrame& frame, GBuffer& gbuffer) = 0;

  // Rays behind the clear surfaces of a batch's pixels, and their light, which is added to the shaded pixels before any
  // other ray is sent. Between them they go the way of all others, from shade() on.
  virtual void spawnBehind(const FrameView&, int /*batch*/, int /*batches*/, RayQueue& /*out*/, EffectFrame&) {}
  virtual void resolveBehind(const FrameView&, const RayQueue& /*first*/, int /*batch*/, const EffectFrame&,
                             const GBuffer&) {}

  // Whether it then looks at the screen: `screen` knows what the camera sees, and nothing else.
  virtual bool looksAtScreen(const Settings&) const { return false; }
  virtual void lookAtScreen(const FrameView&, const AnswerQueue& /*screen*/, EffectFrame&, GBuffer&) {}

  // Of what it keeps from frame to frame.
  virtual std::uint64_t bytes() const { return 0; }
};

// The effect of that name.
std::unique_ptr<RayEffect> makeEffect(const gl::Api& api, Effect effect);

}  // namespace halfsilver
