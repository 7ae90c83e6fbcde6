#pragma once

#include <cstdint>
#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

// `preset` is the kind of antialiasing.
struct AntialiasingKey : PointKey<> {
  int before = 0;   // frames of the pan that are drawn first and do not count
  int frames = 0;   // that count
  int samples = 0;  // per pixel of the truth
};
template <>
inline constexpr auto kFields<AntialiasingKey> =
    std::tuple_cat(kFields<PointKey<>>,
                   std::tuple{field("frames_before", &AntialiasingKey::before),
                              field("frames", &AntialiasingKey::frames), field("samples", &AntialiasingKey::samples)});

// Of radiance, clipped to what a display shows at exposure 0 (0..1).
struct AntialiasingResult {
  double flickerMean = 0, flicker99 = 0;              // of all pixels, see Flicker
  double flickerTracedMean = 0, flickerTraced99 = 0;  // of those with a ray in any frame
  double rmse = 0;                                    // of all frames and pixels, against the truth
};
template <>
inline constexpr auto kFields<AntialiasingResult> = std::tuple{
    field("flicker_mean", &AntialiasingResult::flickerMean), field("flicker_99", &AntialiasingResult::flicker99),
    field("flicker_traced_mean", &AntialiasingResult::flickerTracedMean),
    field("flicker_traced_99", &AntialiasingResult::flickerTraced99), field("rmse", &AntialiasingResult::rmse)};

using AntialiasingPoint = Point<AntialiasingKey, AntialiasingResult>;

}  // namespace halfsilver::bench
