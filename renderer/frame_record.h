#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <halfsilver/gl/profiler.h>
#include <halfsilver/gl/readback.h>
#include <halfsilver/products.h>
#include <halfsilver/renderer.h>
#include <halfsilver/tracer.h>
#include "effects/light_rays/light_rays.h"
#include "effects/ray_effect.h"
#include "frame/ray_tally.h"

namespace halfsilver {

// What a frame is for.
struct PictureUse {
  enum class Kind {
    frame,    // a picture of its own
    sample,   // one of those that Renderer::refine() averages
    temporal  // joined with those before
  };
  Kind kind = Kind::frame;
  bool first = true;   // nothing that was drawn before goes into the picture
  bool still = false;  // temporal: nothing has changed since the frame before
  glm::vec2 jitter{0};
  RayPasses passes{};  // of its effect
};

// Everything that one frame owns, so that two can be under way. The batches of first rays stay until the next frame,
// since the layers show them; later generations take turns with two queues.
struct Frame {
  gl::Buffer constants;  // FrameConstants
  shared::FrameConstants host{};
  Settings settings;
  PictureUse use;
  RayPasses passes;
  GBuffer gbuffer;
  EffectFrame effect;
  std::vector<RayBatch> batches;
  std::array<RayQueue, 2> queues;
  Hits hits;  // of later generations
  LightRayFrame lightRays;
  RayTally tally;  // with trace.tally

  void forgetRays();
  std::size_t bytes() const;
};

// The figures of one frame. Times and counts are gathered on the GPU while it runs and arrive later.
class FrameRecord {
 public:
  explicit FrameRecord(const gl::Api& api) : profiler_(api), readback_(api) {}

  // Takes the sections of the frame; begin() forgets those of the frame before.
  gl::Profiler& profiler() { return profiler_; }
  void begin();
  // Has the counts of the finished frame copied. `held`: geometry, textures, shadow maps and queues, and as the peak
  // the bytes of all that is not the tracer's.
  void end(const Frame& frame, const Tracer* tracer, const MemoryReport& held, std::vector<std::string> warnings);

  // Whether report() has all that it needs; never waits.
  bool arrived() const { return readback_.ready() && profiler_.ready(); }
  // After end(); waits for what has not arrived. Can be asked again. Throws Error (failed) if the GPU did not run it.
  FrameReport report();

 private:
  FrameReport known_;
  TracerMemory memory_;
  bool reported_ = false;
  std::uint32_t raysPerPixel_ = 1, number_ = 0;
  gl::Profiler profiler_;
  gl::Readback readback_;
  std::vector<gl::Readback::Slice<shared::RayCount>> firstCounts_, laterCounts_;  // of batches and later generations
  gl::Readback::Slice<std::uint32_t> signature_, contributions_, buildCounts_, primaryCounts_;
  void (*addBuildCounts_)(std::span<const std::uint32_t>, TracerMemory&) = nullptr;
};

}  // namespace halfsilver
