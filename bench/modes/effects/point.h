#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

struct EffectKey : PointKey<> {
  std::string effect, method;
  int samples = 1;       // rays per pixel that choose at random; 1 if nothing is chosen
  int truthSamples = 1;  // of the picture that errors are measured against, over exact rays
};
template <>
inline constexpr auto kFields<EffectKey> = std::tuple_cat(kFields<PointKey<>>,
                                                          std::tuple{field("effect", &EffectKey::effect),
                                                                     field("method", &EffectKey::method),
                                                                     field("samples", &EffectKey::samples),
                                                                     field("truth_samples", &EffectKey::truthSamples)});

struct EffectResult : TimedFrame {
  std::uint64_t rays = 0;         // traced, of all kinds
  double microsecondsPerRay = 0;  // of the stage `trace`
  double rmse = 0;                // of radiance, clipped to what a display shows (0..1)
};
template <>
inline constexpr auto kFields<EffectResult> =
    std::tuple_cat(kFields<TimedFrame>, std::tuple{field("rays", &EffectResult::rays),
                                                   field("us_per_ray", &EffectResult::microsecondsPerRay),
                                                   field("rmse", &EffectResult::rmse)});

using EffectPoint = Point<EffectKey, EffectResult>;

}  // namespace halfsilver::bench
