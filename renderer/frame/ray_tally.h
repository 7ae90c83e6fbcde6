#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// How many rays of each kind a frame has sent for each pixel, and what became of them (trace.tally).
struct RayTally {
  // shared::KindTally[pixels] by RAY_..., of the kinds in use.
  std::array<gl::Buffer, RAY_THROUGH + 1> kinds;

  bool any() const { return static_cast<bool>(kinds[0]); }
  std::size_t bytes() const;
};

// Adds the rays of a queue to it. Sums depend on no order.
class RayTallyPass {
 public:
  explicit RayTallyPass(const gl::Api& api) : api_(&api) {}

  // Empties or makes the tally of a frame.
  void begin(const FrameView& view, RayTally& tally) const;
  // `any`: hits are any that were met, so distances say nothing.
  void add(const FrameView& view, const RayQueue& rays, const Hits& hits, bool any, const RayTally& tally);

 private:
  const gl::Api* api_;
  gl::Program program_;  // made on first use
};

}  // namespace halfsilver
