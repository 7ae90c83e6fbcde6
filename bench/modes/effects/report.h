#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "bench/modes/effects/point.h"
#include "bench/report/charts/chart.h"
#include "bench/report/table.h"

// The points of the mode `effects` as tables, chart and page.
namespace halfsilver::bench {

constexpr const char* kExactRays = "exact";

using EffectPoints = std::span<const EffectPoint>;

Table effectsTable(EffectPoints points);  // for people
Table effectsCsv(EffectPoints points);    // plain numbers, one row per point
// A panel per scene: time against error, a color per effect; hollow over exact rays.
ScatterGrid effectsChart(EffectPoints points);
// `pictures`: bytes of PNGs by name.
std::string effectsBody(EffectPoints points, const std::map<std::string, std::string>& pictures,
                        const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
