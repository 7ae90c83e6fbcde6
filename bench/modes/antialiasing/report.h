#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "bench/modes/antialiasing/point.h"
#include "bench/report/table.h"

// The points of the mode `antialiasing` as tables and the body of its page.
namespace halfsilver::bench {

constexpr const char* kNone = "none";
constexpr const char* kTemporal = "temporal";
constexpr const char* kTruth = "truth";

using AntialiasingPoints = std::span<const AntialiasingPoint>;

// Flicker as a share of that without antialiasing, of all pixels; nothing if the scene has no such point or no flicker.
std::optional<double> flickerLeft(AntialiasingPoints points, const AntialiasingPoint& point);

Table antialiasingTable(AntialiasingPoints points);  // for people
Table antialiasingCsv(AntialiasingPoints points);    // plain numbers, one row per point
// `pictures`: bytes of PNGs by pictureName().
std::string antialiasingBody(AntialiasingPoints points, const std::map<std::string, std::string>& pictures);

}  // namespace halfsilver::bench
