#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/harness/fit.h"
#include "bench/modes/coverage/point.h"

// The curves of the mode `coverage`, and the straight lines through them.
namespace halfsilver::bench {

inline constexpr std::string_view kRegion = "region", kScattered = "scattered";

// The points of one scene, preset and pattern, in order of the share of the screen that was asked for.
struct CoverageCurve {
  std::string scene, preset, pattern;
  std::vector<CoveragePoint> points;
};
using CoverageCurves = std::vector<CoverageCurve>;

// In order of first occurrence. The rounds become one point: its times are their median, minimum and maximum.
CoverageCurves coverageCurves(const std::vector<CoveragePoint>& points);

// The curve of the same scene and preset with this pattern; null if there is none.
const CoverageCurve* sibling(const CoverageCurves& curves, const CoverageCurve& curve, std::string_view pattern);

double shareOf(const CoveragePoint& point);  // of the screen, as asked for

// A quantity that is fitted over coverage.
struct CoverageQuantity {
  const char* name;
  const char* unit;
  double (*of)(const CoveragePoint&);
};
inline constexpr std::array<CoverageQuantity, 5> kCoverageQuantities{{
    {"trace", "ms", [](const CoveragePoint& p) { return p.times.trace.median; }},
    {"voxelize + build + trace", "ms",
     [](const CoveragePoint& p) { return p.times.voxelize.median + p.times.build.median + p.times.trace.median; }},
    {"frame", "ms", [](const CoveragePoint& p) { return p.times.frame.median; }},
    {"structure", "MB", [](const CoveragePoint& p) { return static_cast<double>(p.memory.structureTotal) / 1e6; }},
    {"pool used", "MB", [](const CoveragePoint& p) { return static_cast<double>(p.memory.poolUsed) / 1e6; }},
}};
inline constexpr const CoverageQuantity& kTrace = kCoverageQuantities[0];
inline constexpr const CoverageQuantity& kReflections = kCoverageQuantities[1];
inline constexpr const CoverageQuantity& kFrame = kCoverageQuantities[2];
inline constexpr const CoverageQuantity& kStructure = kCoverageQuantities[3];
inline constexpr const CoverageQuantity& kPool = kCoverageQuantities[4];

struct CoverageFit {
  std::vector<XY> points;  // x: coverage
  std::optional<LinearFit> line;
  std::optional<Jump> jump;          // the largest
  std::optional<double> smallShare;  // cost of the smallest share above 0 (at most 4 %) over that of the whole screen
};
CoverageFit fitCurve(const CoverageCurve& curve, const CoverageQuantity& quantity);

double spreadOf(const Timing& timing);            // of the rounds
double medianSpread(const CoverageCurve& curve);  // of the trace times of all points

}  // namespace halfsilver::bench
