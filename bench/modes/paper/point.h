#pragma once

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

// Frames that build their structure, as the papers' do.
struct PaperResult : TimedFrame {
  std::optional<ComparisonRecord> error;  // against exact rays for the same purpose; nothing without them
};
template <>
inline constexpr auto kFields<PaperResult> = std::tuple_cat(kFields<TimedFrame>,
                                                            std::tuple{field("error", &PaperResult::error)});

using PaperPoint = Point<PaperKey, PaperResult>;

}  // namespace halfsilver::bench
