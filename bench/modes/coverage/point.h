#pragma once

#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

struct CoverageKey : PointKey<> {
  int round = 0;  // all shares are measured in each round
};
template <>
inline constexpr auto kFields<CoverageKey> = std::tuple_cat(kFields<PointKey<>>,
                                                            std::tuple{field("round", &CoverageKey::round)});

using CoveragePoint = Point<CoverageKey, TimedFrame>;

}  // namespace halfsilver::bench
