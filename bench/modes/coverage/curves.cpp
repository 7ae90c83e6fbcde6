#include "bench/modes/coverage/curves.h"

#include <algorithm>
#include <span>
#include <utility>

#include "apps/statistics.h"

namespace halfsilver::bench {
namespace {

constexpr double kSmallShare = 0.04;  // of the screen: "3 %"

std::string patternOf(const CoveragePoint& point) {
  return std::string(point.settings.select.pattern == SelectPattern::region ? kRegion : kScattered);
}

CoveragePoint mergeRounds(std::span<const CoveragePoint> rounds) {
  CoveragePoint point = rounds.front();
  const auto merge = [&](Timing Times::*stage) {
    std::vector<double> all;
    for (const CoveragePoint& round : rounds) all.push_back((round.times.*stage).median);
    const auto [min, max] = std::minmax_element(all.begin(), all.end());
    point.times.*stage = {median(all), *min, *max, all.size(), 0};
  };
  std::apply([&](const auto&... stages) { (merge(stages.member), ...); }, kFields<Times>);
  return point;
}

}  // namespace

double shareOf(const CoveragePoint& point) { return static_cast<double>(point.settings.select.fraction); }

CoverageCurves coverageCurves(const std::vector<CoveragePoint>& points) {
  CoverageCurves curves;
  for (const CoveragePoint& point : points) {
    const CoverageCurve of{point.scene.file, point.preset, patternOf(point), {}};
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const CoverageCurve& c) {
      return c.scene == of.scene && c.preset == of.preset && c.pattern == of.pattern;
    });
    if (curve == curves.end()) curve = curves.insert(curves.end(), of);
    curve->points.push_back(point);
  }
  for (CoverageCurve& curve : curves) {
    std::stable_sort(curve.points.begin(), curve.points.end(),
                     [](const CoveragePoint& a, const CoveragePoint& b) { return shareOf(a) < shareOf(b); });
    std::vector<CoveragePoint> merged;
    for (auto first = curve.points.begin(); first != curve.points.end();) {
      const auto last = std::find_if(first, curve.points.end(),
                                     [&](const CoveragePoint& p) { return shareOf(p) != shareOf(*first); });
      merged.push_back(mergeRounds({first, last}));
      first = last;
    }
    curve.points = std::move(merged);
  }
  return curves;
}

const CoverageCurve* sibling(const CoverageCurves& curves, const CoverageCurve& curve, std::string_view pattern) {
  const auto found = std::find_if(curves.begin(), curves.end(), [&](const CoverageCurve& c) {
    return c.scene == curve.scene && c.preset == curve.preset && c.pattern == pattern;
  });
  return found == curves.end() ? nullptr : &*found;
}

CoverageFit fitCurve(const CoverageCurve& curve, const CoverageQuantity& quantity) {
  CoverageFit result;
  for (const CoveragePoint& point : curve.points) result.points.push_back({point.pixels.coverage, quantity.of(point)});
  result.line = fitLine(result.points);
  if (result.line) result.jump = largestJump(result.points, *result.line);
  const CoveragePoint& whole = curve.points.back();
  for (const CoveragePoint& point : curve.points)
    if (shareOf(point) > 0 && shareOf(point) <= kSmallShare && shareOf(whole) == 1 && quantity.of(whole) > 0)
      result.smallShare = quantity.of(point) / quantity.of(whole);
  return result;
}

double spreadOf(const Timing& timing) { return timing.max - timing.min; }

double medianSpread(const CoverageCurve& curve) {
  std::vector<double> spreads;
  for (const CoveragePoint& point : curve.points) spreads.push_back(spreadOf(point.times.trace));
  return median(std::move(spreads));
}

}  // namespace halfsilver::bench
