#include "bench/modes/speed/lanes.h"

#include <algorithm>

namespace halfsilver::bench {

double lanesAtWork(std::span<const RayWork> work, std::size_t lanes) {
  double done = 0, possible = 0;
  for (std::size_t first = 0; first < work.size(); first += lanes) {
    double slowest = 0;
    for (const RayWork& ray : work.subspan(first, std::min(lanes, work.size() - first))) {
      const double each = static_cast<double>(ray.steps) + ray.tests;
      done += each;
      slowest = std::max(slowest, each);
    }
    possible += slowest * static_cast<double>(lanes);
  }
  return possible > 0 ? done / possible : 1;
}

}  // namespace halfsilver::bench
