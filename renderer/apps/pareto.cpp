#include "apps/pareto.h"

#include <algorithm>
#include <tuple>

namespace halfsilver {
namespace {

auto order(const Cost& cost) { return std::tie(cost.milliseconds, cost.bytes, cost.error); }

bool beats(const Cost& a, const Cost& b) {
  return a.milliseconds <= b.milliseconds && a.bytes <= b.bytes && a.error <= b.error && order(a) != order(b);
}

}  // namespace

std::vector<std::size_t> paretoFront(std::span<const Cost> points) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::none_of(points.begin(), points.end(), [&](const Cost& other) { return beats(other, points[i]); }))
      front.push_back(i);
  std::stable_sort(front.begin(), front.end(),
                   [&](std::size_t a, std::size_t b) { return order(points[a]) < order(points[b]); });
  return front;
}

std::optional<std::size_t> fastestWithin(std::span<const Cost> points, double maxError) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(points[i].error <= maxError)) continue;
    const auto key = [&](std::size_t at) { return std::tie(points[at].milliseconds, points[at].bytes); };
    if (!best || key(i) < key(*best)) best = i;
  }
  return best;
}

bool clearlyBeaten(const Cost& point, std::span<const Cost> others) {
  return std::any_of(others.begin(), others.end(), [&](const Cost& other) {
    return other.bytes <= point.bytes && other.error <= point.error && 2 * other.milliseconds <= point.milliseconds &&
           order(other) != order(point);
  });
}

}  // namespace halfsilver
