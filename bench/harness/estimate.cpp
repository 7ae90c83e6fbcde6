#include "bench/harness/estimate.h"

#include <cmath>

namespace halfsilver::bench {

void Estimate::done(double work, double seconds) {
  done_ += work;
  seconds_ += seconds;
}

std::string Estimate::left() const {
  if (!(done_ > 0)) return "";
  const double seconds = seconds_ / done_ * (planned_ - done_);
  if (seconds < 90) return "about " + std::to_string(std::lround(seconds)) + " s left";
  if (seconds < 90 * 60) return "about " + std::to_string(std::lround(seconds / 60)) + " min left";
  return "about " + std::to_string(std::lround(seconds / 3600)) + " h left";
}

}  // namespace halfsilver::bench
