#pragma once

#include <cstdint>
#include <optional>

#include "core/image.h"
#include "io/images.h"

// How far an image is from a reference.
namespace halfsilver {

// Of layer files. All are shares of the pixels selected in either file (0 where there are none); a pixel is hit where
// its hit.T is at least 0.
struct LayerComparison {
  std::uint64_t pixels = 0;     // selected in either file
  double hitError = 0;          // hit in one file only, or hit.T further apart than 0.1 % of the scene's diagonal
  double falseMiss = 0;         // hit in the reference only
  double falseHit = 0;          // hit in the image only
  double wrongId = 0;           // hit in both, hit.id differs
  double selectedMismatch = 0;  // selected in one file only
  double overflow = 0;          // given up (hit.T -3) in the image
};

struct Comparison {
  double rmse = 0;      // over R, G, B of all pixels, in the files' own values (PNG: display values 0..1)
  double psnrDb = 0;    // 20 log10(peak / rmse), peak = the larger of 1 and the largest value; infinite when equal
  double maxError = 0;  // largest difference of one channel
  std::optional<PerceptualDifference> perceptual;
  std::optional<LayerComparison> layers;  // where both files have the channels selected.Y, hit.T and hit.id
};

// `diagonal` in metres. Throws Error (badInput) where the sizes differ or a channel is missing.
LayerComparison compareLayers(const Image& image, const Image& reference, double diagonal);

// `diagonal` (metres) overrides what the files say. Throws Error: badInput where the sizes differ, a file has no colour
// or holds values that are not finite, or the files' diagonals differ; usage where layers are compared and no diagonal
// is known.
Comparison compareImages(const ImageFile& image, const ImageFile& reference, std::optional<double> diagonal = {});

}  // namespace halfsilver
