#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "bench/chart.h"

// Pieces of scripts that all charts share.
namespace halfsilver::bench {

// Blue, orange, green, light grey, purple, light blue: distinct also where colours are seen as few (after Okabe & Ito).
// The last, a dark grey, is for what belongs to none.
constexpr const char* kColors[] = {"#0072b2", "#e69f00", "#009e73", "#b8b8b8", "#cc79a7", "#56b4e9", "#555555"};
constexpr std::size_t kNoFamily = std::size(kColors) - 1;

std::string quoted(const std::string& text);
// Places of a logarithmic axis: 1, 2, 5, 10, ... over few decades, otherwise 1, 10, 100, ... Both ends are positive.
std::vector<double> logarithmicTicks(double low, double high);
// Size in pixels.
std::string terminal(ChartFormat format, double width, double height);

}  // namespace halfsilver::bench
