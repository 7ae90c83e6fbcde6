#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <halfsilver/image.h>
#include <halfsilver/ray_reader.h>
#include "frame/ray_tally.h"
#include "frame/surface_reader.h"

namespace halfsilver {

// Puts a frame together as an image of the contract's layers, rows from the top. `linear` is the blended picture before
// tone mapping (RGBA32F, the G-buffer's size); `batches` are the first bounce, empty if nothing was traced. hit.n* is
// the interpolated vertex normal (or the stored one) on the ray's side. `work` is that of the rays of one batch, or
// empty; `answers` (ANSWER_...) are those of the rays of each batch, or empty. Waits for the GPU.
Image assembleLayers(const FrameView& view, const gl::Texture& linear, std::span<const RayBatch> batches,
                     std::span<const shared::RayWork> work, std::span<const std::vector<std::uint32_t>> answers,
                     const SurfaceReader& surfaces, RayReader& reader);

// The layers with what is known of each kind of ray that there is: rays.*, hits.* and distance.*, the mean in meters.
Image withTally(Image layers, const RayTally& tally, double diagonal);

}  // namespace halfsilver
