#pragma once

#include <array>
#include <glm/glm.hpp>

#include <halfsilver/frame_view.h>
#include "gl/program.h"
#include "shared/passes/temporal.h"

namespace halfsilver {

// Joins frames over time (image.antialiasing = temporal), section "composite". Each frame's samples lie elsewhere in
// their pixels. The last frames are kept as they are, and each new picture is the mean of what they showed in the same
// places, which are followed back from frame to frame by the motion of surfaces and, for what they reflect, of the
// images behind them. What is old is kept as far as the new neighborhood allows (after Karis 2014, "High Quality
// Temporal Supersampling", and Salvi 2016, "An Excursion in Temporal Supersampling"). A moment that stays is averaged
// over more frames.
class TemporalPass {
 public:
  explicit TemporalPass(const gl::Api& api) : api_(&api) {}

  enum class Past {
    none,   // the frame begins a history
    still,  // nothing has changed since the frame before
    moving
  };

  // Before a frame's hits; allocates.
  void begin(const FrameView& view);
  // Where the images of what a batch of first rays has hit were in the frame before. `previousPositions` are those of
  // the scene's vertices then.
  void follow(const FrameView& view, const RayBatch& batch, const gl::Buffer& previousPositions);
  // Joins the frame with those before it.
  void run(const FrameView& view, Past past);

  const gl::Texture& picture() const { return mean_; }  // radiance

  void forget();  // and frees
  std::size_t bytes() const;

 private:
  // Of one frame, see IMAGE_COUNTS and IMAGE_DEPTHS.
  struct Known {
    gl::Texture counts, depths;
  };

  const gl::Api* api_;
  gl::Program join_;
  gl::Program follow_[2];                             // [with HitSurface]; all are made when first used
  gl::Texture frames_;                                // see IMAGE_FRAME
  gl::Texture mean_;                                  // see IMAGE_MEAN
  std::array<Known, 2> known_;                        // of this frame and of the one before, in turn
  std::array<glm::vec2, TEMPORAL_FRAMES> jitters_{};  // of the frames, the latest first
  std::size_t latest_ = 0;                            // of known_
  int number_ = 0;                                    // of the latest frame, modulo TEMPORAL_FRAMES
  gl::Texture motion_;                                // of reflections, see IMAGE_REFLECTION_MOTION
  gl::Buffer constants_;                              // FrameConstants of the frame before
  shared::FrameConstants previous_{};                 // the same
};

}  // namespace halfsilver
