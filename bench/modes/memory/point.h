#pragma once

#include <optional>
#include <tuple>

#include "bench/harness/comparison.h"
#include "bench/harness/point.h"

namespace halfsilver::bench {

struct MemoryResult : FrameRecord {
  double singleOverThree = 0;             // see singleOverThree()
  std::optional<ComparisonRecord> error;  // nothing without the reference
};
template <>
inline constexpr auto kFields<MemoryResult> =
    std::tuple_cat(kFields<FrameRecord>, std::tuple{field("single_over_three", &MemoryResult::singleOverThree),
                                                    field("error", &MemoryResult::error)});

using MemoryPoint = Point<PointKey<>, MemoryResult>;

}  // namespace halfsilver::bench
