#include "bench/modes/scaling/series.h"

#include <algorithm>

namespace halfsilver::bench {
namespace {

constexpr const char* kFiner = "finer";
constexpr const char* kMore = "more";

// The position on the axis: along the axes of triangles, those that the scene really has.
double valueOf(const ScalingPoint& point) {
  const bool triangles = point.axis == kFiner || point.axis == kMore;
  return triangles && point.triangles ? static_cast<double>(*point.triangles) : point.value;
}

}  // namespace

const std::array<ScalingAxis, 6> kScalingAxes{{
    {kFiner, "triangles, finer and finer", "One surface is divided into finer and finer triangles."},
    {kMore, "triangles, more and more objects",
     "Objects of 98 triangles are added at a fixed distance from each other, and the mirror below them grows: a larger "
     "and larger world around the same place. Objects packed into a fixed space would shrink instead, which amounts to "
     "finer triangles."},
    {"pixels", "pixels", "The picture gets larger."},
    {"coverage", "% of the pixels traced", "More of the pixels are traced, scattered evenly, on all surfaces."},
    {"lights", "lights", "A sun, then point lights; all cast shadows."},
    {"bounces", "bounces", "Rays are reflected from mirror to mirror."},
}};

ScalingSeries scalingSeries(const std::vector<ScalingPoint>& points) {
  ScalingSeries series;
  for (const ScalingPoint& point : points) {
    auto curve = std::find_if(series.begin(), series.end(),
                              [&](const ScalingCurve& c) { return c.axis == point.axis && c.preset == point.preset; });
    if (curve == series.end()) curve = series.insert(series.end(), {point.axis, point.preset, {}});
    curve->points.push_back(point);
  }
  for (ScalingCurve& curve : series)
    std::stable_sort(curve.points.begin(), curve.points.end(),
                     [](const ScalingPoint& a, const ScalingPoint& b) { return a.value < b.value; });
  return series;
}

std::optional<std::string> fault(const ScalingPoint& point) {
  if (point.failed || !point.frame) return point.failed.value_or("nothing was measured");
  const TimedFrame& frame = *point.frame;
  if (frame.lostFragments > 0)
    return std::to_string(frame.lostFragments) + " fragments did not fit, " + std::to_string(frame.overflow) +
           " rays met such a place";
  if (frame.overflow > 0) return std::to_string(frame.overflow) + " rays overflowed";
  std::string warnings;
  for (const std::string& warning : frame.warnings) warnings += (warnings.empty() ? "" : "; ") + warning;
  if (warnings.empty()) return std::nullopt;
  return warnings;
}

bool stops(const ScalingPoint& point, double timeLimit) { return fault(point) || point.seconds > timeLimit; }

std::vector<XY> lawSamples(const ScalingCurve& curve, const ScalingQuantity& quantity) {
  std::vector<XY> samples;
  for (const ScalingPoint& point : curve.points)
    if (!fault(point) && quantity.of(*point.frame) > 0) samples.push_back({valueOf(point), quantity.of(*point.frame)});
  return samples;
}

}  // namespace halfsilver::bench
