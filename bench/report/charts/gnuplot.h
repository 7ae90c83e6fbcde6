#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "bench/report/charts/chart.h"

// Running gnuplot, and what all chart scripts share.
namespace halfsilver::bench {

// Blue, orange, green, light gray, purple, light blue: distinct to color-blind readers, too (after Okabe & Ito). The
// last, a dark gray, is neutral.
constexpr const char* kColors[] = {"#0072b2", "#e69f00", "#009e73", "#b8b8b8", "#cc79a7", "#56b4e9", "#555555"};
constexpr std::size_t kNeutralColor = std::size(kColors) - 1;

std::string quoted(const std::string& text);
struct Range {
  double low = 0.1, high = 1;
};

// Ticks of a logarithmic axis: 1, 2, 5, 10, ... over few decades, otherwise 1, 10, 100, ... Both ends are positive.
std::vector<double> logarithmicTicks(double low, double high);
// Size in pixels.
std::string terminal(ChartFormat format, double width, double height);

// What gnuplot writes for a script; nothing if gnuplot is not installed. Throws Error (failed) if it fails.
std::optional<std::string> runGnuplot(const std::string& script);

}  // namespace halfsilver::bench
