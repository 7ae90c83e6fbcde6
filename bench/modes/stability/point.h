#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

struct StabilityKey : PointKey<> {
  int frames = 0;  // of the motion, after the first
};
template <>
inline constexpr auto kFields<StabilityKey> = std::tuple_cat(kFields<PointKey<>>,
                                                             std::tuple{field("frames", &StabilityKey::frames)});

// Shares of the rays, if nothing else is said.
struct StabilityResult {
  std::string cause;                   // what is hard about the scene; empty unless it is a failure scene
  std::uint64_t rays = 0;              // of the still frame
  double hitError = 0, falseMiss = 0;  // of the still frame, see LayerComparison
  double worstHitError = 0;            // of any frame
  double overflow = 0;                 // of any frame
  std::uint64_t lostFragments = 0;     // of any frame, a count
  double flickerMean = 0, flicker99 = 0, flickerHits = 0;  // see Flicker
  std::uint64_t quietSteps = 0, steps = 0;                 // counts
  bool repeatsExactly = false;                             // the still frame, drawn again and again
};
template <>
inline constexpr auto kFields<StabilityResult> =
    std::tuple{field("cause", &StabilityResult::cause),
               field("rays", &StabilityResult::rays),
               field("hit_error", &StabilityResult::hitError),
               field("false_miss", &StabilityResult::falseMiss),
               field("worst_hit_error", &StabilityResult::worstHitError),
               field("overflow", &StabilityResult::overflow),
               field("lost_fragments", &StabilityResult::lostFragments),
               field("flicker_mean", &StabilityResult::flickerMean),
               field("flicker_99", &StabilityResult::flicker99),
               field("flicker_hits", &StabilityResult::flickerHits),
               field("quiet_steps", &StabilityResult::quietSteps),
               field("steps", &StabilityResult::steps),
               field("repeats_to_the_bit", &StabilityResult::repeatsExactly)};

using StabilityPoint = Point<StabilityKey, StabilityResult>;

}  // namespace halfsilver::bench
