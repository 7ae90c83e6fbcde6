#pragma once

#include <string>
#include <string_view>

#include "apps/outputs.h"
#include "apps/progress.h"
#include "apps/view_request.h"
#include "apps/wall_clock.h"

// An image sequence: pictures of consecutive frames in files of their own, which several machines can share out.
namespace halfsilver {

inline constexpr double kFramesPerSecond = 24;

// Frames first to last, both included; frame n is at n / framesPerSecond seconds.
struct FrameRange {
  int first = 0, last = 0;
  double framesPerSecond = kFramesPerSecond;
};

// "A..B" with 0 <= A <= B <= 9,999,999. Throws Error (usage).
FrameRange parseFrames(std::string_view text, double framesPerSecond);

// The path with its last run of # replaced by the frame's number, with zeros in front up to the run's length. Throws
// Error (usage) if it has none.
std::string numbered(const std::string& path, int frame);

struct SequenceRequest {
  const ViewRequest& view;
  const ViewArguments& arguments;
  const Settings& settings;
  const OutputPaths& outputs;  // with a run of # each
  FrameRange range;
  bool overwrite = false;
  int samples = 1;                 // per pixel
  bool automaticExposure = false;  // that of the first frame
};

// Draws what is missing; structures and shadow maps are kept from frame to frame. Every file is whole as soon as it
// exists, so that a run can be stopped at any time and be taken up by the same command. Layers hold the motion since
// the frame before, whether that one is drawn in the same run or not; frame 0 has none. Throws Error.
void renderSequence(const SequenceRequest& request, Progress& progress, WallClock& clock);

}  // namespace halfsilver
