#pragma once

#include <cstdint>

#include <halfsilver/frame_view.h>
#include "gl/program.h"

// What effects share of queues: how the screen is cut into batches, and how a queue grows and is counted.
namespace halfsilver {

constexpr int kBandTile = 8;  // pixels, of a dispatch that spawns

// A batch is a band of whole tiles of the screen.
struct Band {
  int firstRow = 0, rows = 0;
  std::uint32_t firstPixel = 0;  // y * width
  std::uint32_t pixels = 0;      // of the largest band
};
Band bandOf(const GBuffer& gbuffer, int batch, int batches);
// How many bands have at most `maxPixels` each, unless a row of tiles has more.
int bandCount(const GBuffer& gbuffer, std::uint32_t maxPixels);

enum class RayStorage { pixels, rays };

// Makes room for that many rays, and at most about twice as many. What a queue held is lost if it changes.
void reserveQueue(const gl::Api& api, std::uint32_t rays, RayStorage storage, RayQueue& queue);
// Hits for as many rays as the queue can hold, with what a method that stores attributes writes of them.
void reserveHits(const gl::Api& api, const RayQueue& rays, bool attributes, Hits& hits);
// Before a dispatch appends rays. Counts for the whole frame stay.
void beginQueue(RayQueue& queue);

// Turns counts into dispatches.
class RayCountPass {
 public:
  explicit RayCountPass(const gl::Api& api);
  // The queue is then ready for tracers, for shading and for reports.
  void run(const RayQueue& queue) const;

 private:
  const gl::Api* api_;
  gl::Program program_;
};

}  // namespace halfsilver
