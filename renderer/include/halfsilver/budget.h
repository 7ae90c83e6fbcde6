#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <halfsilver/renderer.h>

namespace halfsilver {

struct BudgetLimits {
  double milliseconds = std::numeric_limits<double>::infinity();  // of GPU time per frame
  double bytes = std::numeric_limits<double>::infinity();         // of the structure (MemoryReport::structureTotal)
  float minContribution = 0;                                      // 0..1: pixels at or below it are always dropped
};

// Keeps frames within limits of time and memory by dropping the least visible reflections first. After each frame:
//
//   budget.learn(renderer.report());
//   settings.select.minContribution = budget.minContribution();
//   if (budget.forgetStructures()) renderer.forgetStructures();
//
// A frame over a limit drops pixels at once; only the time spent on a structure that the next frame keeps is forgiven.
// Pixels come back after several frames with room to spare, and more slowly each time they had to be dropped again, so
// that the picture does not oscillate between two thresholds.
class Budget {
 public:
  explicit Budget(const BudgetLimits& limits);

  // Learns from the last frame, which was drawn with this object's threshold.
  void learn(const FrameReport& report);

  float minContribution() const { return minContribution_; }   // for SelectSettings
  bool forgetStructures() const { return forgetStructures_; }  // before the next frame
  bool held() const { return held_; }                          // whether the last frame was within the limits
  std::uint64_t dropped() const { return dropped_; }           // pixels of the last frame, because of the limits
  bool atRest() const { return atRest_; }                      // nothing will change as long as the view stays

 private:
  struct Frame;  // what counts of a report

  void noteView(double available);
  float lowestThreshold(const FrameReport& report) const;
  double raysInTime(const Frame& frame);
  double raysInMemory(const Frame& frame);
  double raysWithRoom(const Frame& frame, bool dropping);

  BudgetLimits limits_;
  float minContribution_;
  bool forgetStructures_ = false, held_ = false, atRest_ = false;
  bool builtForItself_ = true;   // the last frame's structure was built for its own rays alone
  bool pixelsCameBack_ = false;  // by the last change of the threshold
  int slowFrames_ = 0;           // in a row, over the time limit
  int roomyFrames_ = 0;          // in a row, with room to spare
  int patience_;                 // roomy frames before pixels come back
  // Of the current view.
  double availablePixels_ = 0;    // that could be traced
  double maxFittingRays_ = 0;     // the most that fitted into the memory
  double minExcessRays_ = 0;      // the fewest that did not
  bool overWithoutRays_ = false;  // the memory is over its limit even without rays
  std::uint64_t dropped_ = 0;
};

// The same for effects whose picture is the mean of several rays per pixel (EffectSettings): keeps frames within a
// limit of time by sending fewer of them, passes first. `wanted` is the most.
class PassBudget {
 public:
  PassBudget(double milliseconds, const EffectSettings& wanted);

  // Learns from the last frame, which was drawn with these numbers.
  void learn(const FrameReport& report);

  int passes() const;   // for EffectSettings, as the next
  int samples() const;  // 1 at least
  int raysPerPixel() const { return rays_; }
  int wanted() const { return most_; }
  bool held() const { return held_; }      // as above
  bool atRest() const { return atRest_; }  // as above

 private:
  double milliseconds_;
  int samples_, most_;  // rays per pixel of a pass, and of all
  int rays_;            // of the next frame
  int roomyFrames_ = 0, patience_;
  bool held_ = false, atRest_ = false, grew_ = false;
};

// The threshold that keeps about `kept` of the pixels counted in `contributions` (FrameReport::contributions).
float contributionThreshold(std::span<const std::uint32_t> contributions, double kept);

}  // namespace halfsilver
