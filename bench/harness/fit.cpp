#include "bench/harness/fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/statistics.h"

namespace halfsilver::bench {

std::optional<LinearFit> fitLine(std::span<const XY> points) {
  if (points.empty()) return std::nullopt;
  const auto count = static_cast<double>(points.size());
  XY mean;
  for (const XY& point : points) mean = {mean.x + point.x / count, mean.y + point.y / count};
  double xx = 0, xy = 0, yy = 0;
  for (const XY& point : points) {
    const double dx = point.x - mean.x, dy = point.y - mean.y;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  // By comparison: sums of squares of equal values need not be 0.
  const auto [left, right] =
      std::minmax_element(points.begin(), points.end(), [](const XY& a, const XY& b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const XY& a, const XY& b) { return a.y < b.y; });
  if (left->x == right->x) return std::nullopt;
  if (low->y == high->y) return LinearFit{0, low->y, std::nullopt, 0};
  const double slope = xy / xx;
  const double unexplained = std::max(0.0, yy - slope * xy);  // sum of squares
  return LinearFit{slope, mean.y - slope * mean.x, 1 - unexplained / yy, std::sqrt(unexplained / count)};
}

std::optional<Jump> jumpAt(std::span<const XY> points, const LinearFit& fit, std::size_t first) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) steps.push_back(std::abs(points[i + 1].y - points[i].y));
  const double step = median(std::move(steps));
  if (!(step > 0)) return std::nullopt;
  const XY &from = points[first], &to = points[first + 1];
  const double excess = to.y - from.y - fit.slope * (to.x - from.x);
  return Jump{first, excess, excess / step};
}

double PowerLaw::at(double x) const { return factor * std::pow(x, exponent); }

std::optional<PowerLaw> fitPowerLaw(std::span<const XY> points) {
  constexpr std::size_t kMinPoints = 3;
  constexpr double kMaxFactor = 1.5;
  std::vector<XY> logarithms;
  for (const XY& point : points) logarithms.push_back({std::log(point.x), std::log(point.y)});
  for (std::size_t first = 0; first + kMinPoints <= points.size(); ++first) {
    const std::span<const XY> tail = std::span(logarithms).subspan(first);
    const std::optional<LinearFit> line = fitLine(tail);
    if (!line) return std::nullopt;
    const bool fits = std::all_of(tail.begin(), tail.end(), [&](const XY& point) {
      return std::abs(point.y - line->at(point.x)) <= std::log(kMaxFactor);
    });
    if (fits) return PowerLaw{line->slope, std::exp(line->intercept), line->rSquared, first};
  }
  return std::nullopt;
}

std::optional<Jump> largestJump(std::span<const XY> points, const LinearFit& fit) {
  std::optional<Jump> largest;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const std::optional<Jump> jump = jumpAt(points, fit, i);
    if (jump && (!largest || std::abs(jump->excess) > std::abs(largest->excess))) largest = jump;
  }
  return largest;
}

}  // namespace halfsilver::bench
