#pragma once

#include <array>

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// Joins frames over time (image.antialiasing = temporal), section "composite". Each frame's samples lie elsewhere in
// their pixels; what earlier frames showed is followed back by the motion of surfaces and, for what they reflect, of
// the images behind them, and kept as far as the new neighborhood allows (after Karis 2014, "High Quality Temporal
// Supersampling", and Salvi 2016, "An Excursion in Temporal Supersampling"). Frames of a moment that stays are averaged
// without a limit.
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
  // Joins the frame with the history, which becomes the frame's.
  void run(const FrameView& view, Past past);

  // The picture is the sum of both: radiance.
  const gl::Texture& surface() const { return histories_[latest_].surface; }
  const gl::Texture& reflected() const { return histories_[latest_].reflected; }

  void forget();  // and frees
  std::size_t bytes() const;

 private:
  struct History {
    gl::Texture surface;    // RGBA32F: mean radiance, a the number of frames
    gl::Texture reflected;  // the same
    gl::Texture depths;     // RG32F, see UNIT_DEPTH_HISTORY
  };

  const gl::Api* api_;
  gl::Program join_;
  gl::Program follow_[2];  // [with HitSurface]; all are made when first used
  std::array<History, 2> histories_;
  std::size_t latest_ = 0;
  gl::Texture motion_;                 // of reflections, see IMAGE_REFLECTION_MOTION
  gl::Buffer constants_;               // FrameConstants of the frame before
  shared::FrameConstants previous_{};  // the same
};

}  // namespace halfsilver
