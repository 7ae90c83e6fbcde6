#pragma once

#include <optional>
#include <string>
#include <vector>

// Charts as scripts for gnuplot.
namespace halfsilver::bench {

struct Bar {
  std::string group, name;    // bars of one group stand together
  std::vector<double> parts;  // from the bottom, one for each of StackedBars::parts
  std::string label;          // above the bar
};

// Stacked bars over a logarithmic axis: tops can be compared, parts of different bars cannot.
struct StackedBars {
  std::string title, axis;
  std::vector<std::string> parts;
  std::vector<Bar> bars;
};

enum class ChartFormat { svg, png };

// Writes the picture to gnuplot's standard output.
std::string gnuplotScript(const StackedBars& chart, ChartFormat format);

// What gnuplot writes for a script; nothing where gnuplot is not installed. Throws Error (failed) where it fails.
std::optional<std::string> runGnuplot(const std::string& script);

}  // namespace halfsilver::bench
