#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <halfsilver/renderer.h>

namespace halfsilver {

struct BudgetLimits {
  double milliseconds = std::numeric_limits<double>::infinity();  // of GPU time, a frame
  double bytes = std::numeric_limits<double>::infinity();         // of the structure (MemoryReport::structureTotal)
  float leastContribution = 0;                                    // 0..1: pixels at or below are dropped in any case
};

// Keeps frames within a time and a memory by dropping the reflections that contribute least. After each frame:
//
//   budget.learn(renderer.report());
//   settings.select.minContribution = budget.minContribution();
//   if (budget.forgetStructures()) renderer.forgetStructures();
//
// A frame beyond a limit drops pixels at once; only the time of a structure that the next frame keeps is forgiven.
// Pixels come back after several frames with much room, and more slowly each time that they had to go again, so that
// the picture does not swing between two thresholds.
class Budget {
 public:
  explicit Budget(const BudgetLimits& limits);

  // Learns from the last frame, which was drawn as this object said.
  void learn(const FrameReport& report);

  float minContribution() const { return minContribution_; }  // for SelectSettings
  bool forgetStructures() const { return forget_; }           // before the next frame
  bool held() const { return held_; }                         // whether the last frame was within the limits
  std::uint64_t dropped() const { return dropped_; }          // pixels of the last frame, for the limits' sake
  bool atRest() const { return atRest_; }                     // nothing is about to change while the view stays

 private:
  struct Frame;  // what counts of a report

  void noteView(double available);
  float lowestThreshold(const FrameReport& report) const;
  double raysInTime(const Frame& frame);
  double raysInMemory(const Frame& frame);
  double raysWithRoom(const Frame& frame, bool dropping);

  BudgetLimits limits_;
  float minContribution_;
  bool forget_ = false, held_ = false, atRest_ = false;
  bool fresh_ = true;        // the last frame built its structure for its own rays alone
  bool rose_ = false;        // the last change let pixels come back
  int slow_ = 0, calm_ = 0;  // frames in a row: beyond the time, with much room
  int patience_;             // calm frames before pixels come back
  // Of the present view: pixels that could be traced, most rays that fitted into the memory, fewest that did not.
  double available_ = 0, fitting_ = 0, tooMany_ = 0;
  bool rayless_ = false;  // and the memory is beyond its limit without any ray
  std::uint64_t dropped_ = 0;
};

// The threshold that keeps about so many of the pixels that are counted (FrameReport::contributions).
float contributionThreshold(std::span<const std::uint32_t> contributions, double kept);

}  // namespace halfsilver
