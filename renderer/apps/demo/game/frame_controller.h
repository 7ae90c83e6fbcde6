#pragma once

#include <deque>
#include <string>

// Holds a frame time on a device whose speed nobody knows: it chooses the resolution and how many of the reflections
// are traced.
namespace halfsilver::demo {

struct FrameQuality {
  double scale = 1;  // of the resolution along each axis, 0.25..1
  double share = 1;  // of the reflecting pixels that are traced, 0.25..1: SelectSettings::fraction

  bool operator==(const FrameQuality&) const = default;
};

// The first reflections go, down to half of them, then pixels, then the rest. After each frame: learn() its time.
// A slow frame alone changes nothing: the median of the last frames and how far they scatter count. Too slow is
// answered at once, by as much as it takes; room to spare after a while, by one step, and later each time that turned
// out to be too much.
class FrameController {
 public:
  explicit FrameController(double milliseconds);  // the time to hold, at most

  void learn(double milliseconds);  // of the last frame, which was drawn as quality() says

  const FrameQuality& quality() const;
  double target() const { return target_; }
  std::string say() const;  // "scale 0.70, 50 % of the reflections, 92 ms of 100 ms"

 private:
  double typical() const;            // milliseconds, of the last frames of this quality
  double expected(int level) const;  // milliseconds, scatter included
  void learnFixedPart();

  double target_;
  int level_ = 0;             // 0 is the best quality
  std::deque<double> times_;  // of the last frames of this quality
  // Of a frame's time what no quality changes, from the times before and after a change.
  double fixed_ = 0, timeBefore_ = 0;
  int levelBefore_ = 0;
  bool learnt_ = true;
  int settling_ = 2;  // frames whose time is not typical: the first, and just after a change
  int roomy_ = 0;     // frames in a row with room to spare
  int patience_;      // of them before quality rises
  int sinceRise_ = 0;
};

}  // namespace halfsilver::demo
