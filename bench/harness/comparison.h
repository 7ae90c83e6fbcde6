#pragma once

#include <cstdint>
#include <optional>
#include <tuple>

#include <halfsilver/image.h>
#include "bench/harness/fields.h"

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

// Of layers (Renderer::readLayers()) of one view of a scene of that diagonal.
ComparisonRecord errorOf(const Image& layers, const Image& truth, double diagonal);

}  // namespace halfsilver::bench
