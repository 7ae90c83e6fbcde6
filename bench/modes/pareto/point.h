#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

struct ParetoKey : PointKey<> {
  std::string family, knob;  // see Variant
  std::string beside;
  int round = 0;  // every variant of a scene is drawn in each round
};
template <>
inline constexpr auto kFields<ParetoKey> = std::tuple_cat(
    kFields<PointKey<>>, std::tuple{field("family", &ParetoKey::family), field("knob", &ParetoKey::knob),
                                    field("beside", &ParetoKey::beside), field("round", &ParetoKey::round)});

// How far a picture is from the reference's.
struct PictureErrors {
  double rmse = 0;                    // display values 0..1
  std::optional<double> perceptible;  // share of the pixels (Yee et al. 2001); nothing without OpenImageIO
};
template <>
inline constexpr auto kFields<PictureErrors> =
    std::tuple{field("rmse", &PictureErrors::rmse), field("yee_fail_fraction", &PictureErrors::perceptible)};

// Hits of a method that may trace fewer pixels than the reference, or more. The errors are shares of the rays that both
// traced: a pixel that was not traced is an error of the picture, not a wrong hit.
struct CommonRays {
  std::uint64_t rays = 0;                               // that both traced
  double share = 0;                                     // of the reference's rays
  std::optional<double> hitError, falseMiss, falseHit;  // see LayerComparison; nothing without rays
};
template <>
inline constexpr auto kFields<CommonRays> =
    std::tuple{field("rays", &CommonRays::rays), field("rays_of_reference", &CommonRays::share),
               field("hit_error", &CommonRays::hitError), field("false_miss", &CommonRays::falseMiss),
               field("false_hit", &CommonRays::falseHit)};

struct ParetoErrors : PictureErrors, CommonRays {};
template <>
inline constexpr auto kFields<ParetoErrors> = std::tuple_cat(kFields<PictureErrors>, kFields<CommonRays>);

struct ParetoResult : TimedFrame {
  std::optional<ParetoErrors> errors;            // in the first round
  std::optional<PictureErrors> errorsOfBounces;  // against the reference with the most bounces
};
template <>
inline constexpr auto kFields<ParetoResult> = std::tuple_cat(
    kFields<TimedFrame>, std::tuple{field("error", &ParetoResult::errors, Empty::omitted),
                                    field("error_of_bounces", &ParetoResult::errorsOfBounces, Empty::omitted)});

// One variant in one round.
using ParetoPoint = Point<ParetoKey, ParetoResult>;

}  // namespace halfsilver::bench
