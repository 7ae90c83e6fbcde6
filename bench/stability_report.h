#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/report.h"
#include "bench/table.h"

// What is said about the points of stability: table and text.
namespace halfsilver::bench {

// Whether a method gets through: at most 0.05 % wrong hits in every frame, no overflow, no flicker at the 99th
// percentile or between hit and miss beyond 0.01 % of the pixels, repeats to the bit.
bool survives(const nlohmann::ordered_json& point);

Table stabilityTable(const PointList& points);
Table stabilityCsv(const PointList& points);
// `pictures`: bytes of PNGs by pictureName().
std::string stabilityBody(const PointList& points, const std::map<std::string, std::string>& pictures);
// Of a scene by a method.
std::string pictureName(const std::string& scene, const std::string& method);

}  // namespace halfsilver::bench
