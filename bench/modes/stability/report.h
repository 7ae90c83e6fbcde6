#pragma once

#include <map>
#include <span>
#include <string>

#include "bench/modes/stability/point.h"
#include "bench/report/table.h"

// The points of the mode `stability` as tables and the body of its page.
namespace halfsilver::bench {

using StabilityPoints = std::span<const StabilityPoint>;

// Whether a method passes: at most 0.05 % wrong hits in every frame, no overflow, no flicker at the 99th percentile, at
// most 0.01 % of the pixels flicker between hit and miss, and frames repeat to the bit.
bool survives(const StabilityResult& result);

Table stabilityTable(StabilityPoints points);  // for people
Table stabilityCsv(StabilityPoints points);    // plain numbers, one row per point
// `pictures`: bytes of PNGs by pictureName().
std::string stabilityBody(StabilityPoints points, const std::map<std::string, std::string>& pictures);

}  // namespace halfsilver::bench
