#pragma once

#include <cstdint>
#include <optional>

#include <halfsilver/image.h>
#include "bench/mode.h"

namespace halfsilver::bench {

// Time against accuracy, all methods over their knobs: pareto.csv, .json, .svg and .png.
Mode paretoMode();

// In how many rounds a variant is drawn whose frame takes so long: as many as fit a limit, but never fewer than two.
int roundsFor(double frameMilliseconds, bool quick);

// Hits of a method that may trace fewer pixels than the reference, or more. The errors are shares of the rays that both
// traced: a pixel that was not traced is a matter of the picture, no wrong hit.
struct CommonRays {
  std::uint64_t rays = 0;                               // that both traced
  double share = 0;                                     // of the reference's rays
  std::optional<double> hitError, falseMiss, falseHit;  // see LayerComparison; nothing without rays
};

// `diagonal` in metres. Throws Error (badInput) where the sizes differ or a channel is missing.
CommonRays compareCommonRays(Image image, Image reference, double diagonal);

}  // namespace halfsilver::bench
