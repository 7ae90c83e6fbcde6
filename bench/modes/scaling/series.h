#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/harness/fit.h"
#include "bench/modes/scaling/point.h"

// The curves of the mode `scaling`, and the power laws through them.
namespace halfsilver::bench {

struct ScalingAxis {
  const char* name;   // in points and tables
  const char* label;  // of charts
  const char* help;   // what changes along it
};
extern const std::array<ScalingAxis, 6> kScalingAxes;

// The points of one axis and preset, in order of their values.
struct ScalingCurve {
  std::string axis, preset;
  std::vector<ScalingPoint> points;
};
using ScalingSeries = std::vector<ScalingCurve>;

// In order of first occurrence.
ScalingSeries scalingSeries(const std::vector<ScalingPoint>& points);

// What is wrong with a point: the error that ended it, fragments or rays that did not fit, warnings. Nothing if all is
// well; its time does not matter.
std::optional<std::string> fault(const ScalingPoint& point);
// Whether larger points of its series are skipped: it has a fault, or took longer than `timeLimit`, in seconds.
bool stops(const ScalingPoint& point, double timeLimit);

// A quantity that grows along an axis.
struct ScalingQuantity {
  const char* name;
  const char* unit;
  double (*of)(const TimedFrame&);
};
inline constexpr std::array<ScalingQuantity, 4> kScalingQuantities{{
    {"build", "ms", [](const TimedFrame& f) { return f.times.voxelize.median + f.times.build.median; }},
    {"trace", "ms", [](const TimedFrame& f) { return f.times.trace.median; }},
    {"frame", "ms", [](const TimedFrame& f) { return f.times.frame.median; }},
    {"structure", "MB", [](const TimedFrame& f) { return static_cast<double>(f.memory.structureTotal) / 1e6; }},
}};

// The points without a fault, as a law is fitted through them.
std::vector<XY> lawSamples(const ScalingCurve& curve, const ScalingQuantity& quantity);

}  // namespace halfsilver::bench
