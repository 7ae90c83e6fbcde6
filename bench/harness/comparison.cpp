#include "bench/harness/comparison.h"

#include <cmath>

#include <halfsilver/io.h>

namespace halfsilver::bench {

ComparisonRecord errorOf(const Image& layers, const Image& truth, double diagonal) {
  const Comparison comparison = compareImages({layers, true, diagonal}, {truth, true, diagonal});
  ComparisonRecord record;
  record.rmse = comparison.rmse;
  if (std::isfinite(comparison.psnrDb)) record.psnrDb = comparison.psnrDb;
  record.maxError = comparison.maxError;
  if (const auto& perceptual = comparison.perceptual) {
    record.yeeFailures = perceptual->failures;
    record.yeeFailFraction = perceptual->fraction;
  }
  const LayerComparison hits = comparison.layers.value_or(LayerComparison());
  record.pixels = hits.pixels;
  record.hitError = hits.hitError;
  record.falseMiss = hits.falseMiss;
  record.falseHit = hits.falseHit;
  record.wrongId = hits.wrongId;
  record.selectedMismatch = hits.selectedMismatch;
  record.overflow = hits.overflow;
  return record;
}

}  // namespace halfsilver::bench
