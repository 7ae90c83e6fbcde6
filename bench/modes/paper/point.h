#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "bench/harness/comparison.h"
#include "bench/harness/point.h"

namespace halfsilver::bench {

struct PaperKey : PointKey<> {
  std::string row;  // "Table 2: Sphere, selective"
};
template <>
inline constexpr auto kFields<PaperKey> = std::tuple_cat(kFields<PointKey<>>, std::tuple{field("row", &PaperKey::row)});

// Pixels with a surface, of a picture with shadow.method = refined, whose light is off by more than a thousandth.
struct ShadowDoubts {
  std::uint64_t pixels = 0;  // with a surface
  std::uint64_t marked = 0, wrongMarked = 0, wrongUnmarked = 0;
};
template <>
inline constexpr auto kFields<ShadowDoubts> = std::tuple{
    field("pixels", &ShadowDoubts::pixels), field("marked", &ShadowDoubts::marked),
    field("wrong_marked", &ShadowDoubts::wrongMarked), field("wrong_unmarked", &ShadowDoubts::wrongUnmarked)};

// Frames that build their structure, as the papers' do.
struct PaperResult : TimedFrame {
  std::optional<ComparisonRecord> error;  // against exact rays for the same purpose; nothing without them
  std::optional<ShadowDoubts> shadows;    // against rays everywhere
  std::uint64_t shadowRays = 0;
  std::uint64_t resampled = 0, interpolated = 0;  // pixels, see FrameReport
};
template <>
inline constexpr auto kFields<PaperResult> = std::tuple_cat(
    kFields<TimedFrame>,
    std::tuple{field("error", &PaperResult::error), field("shadows", &PaperResult::shadows),
               field("shadow_rays", &PaperResult::shadowRays), field("resampled", &PaperResult::resampled),
               field("interpolated", &PaperResult::interpolated)});

using PaperPoint = Point<PaperKey, PaperResult>;

}  // namespace halfsilver::bench
