#pragma once

#include <cstdint>
#include <optional>
#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

// How far a picture and its hits are from the reference's; see Comparison and LayerComparison.
struct ComparisonRecord {
  double rmse = 0;
  std::optional<double> psnrDb;  // nothing if the pictures are equal
  double maxError = 0;
  std::optional<std::uint64_t> yeeFailures;
  std::optional<double> yeeFailFraction;
  std::uint64_t pixels = 0;
  double hitError = 0, falseMiss = 0, falseHit = 0, wrongId = 0, selectedMismatch = 0, overflow = 0;
};
template <>
inline constexpr auto kFields<ComparisonRecord> =
    std::tuple{field("rmse", &ComparisonRecord::rmse),
               field("psnr_db", &ComparisonRecord::psnrDb),
               field("max_error", &ComparisonRecord::maxError),
               field("yee_failures", &ComparisonRecord::yeeFailures),
               field("yee_fail_fraction", &ComparisonRecord::yeeFailFraction),
               field("compared_pixels", &ComparisonRecord::pixels),
               field("hit_error", &ComparisonRecord::hitError),
               field("false_miss", &ComparisonRecord::falseMiss),
               field("false_hit", &ComparisonRecord::falseHit),
               field("wrong_id", &ComparisonRecord::wrongId),
               field("selected_mismatch", &ComparisonRecord::selectedMismatch),
               field("overflow", &ComparisonRecord::overflow)};

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
