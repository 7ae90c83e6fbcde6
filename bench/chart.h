#pragma once

#include <cstddef>
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

struct Sample {
  double x = 0, y = 0;
  double low = 0, high = 0;  // of an error bar
};

struct Curve {
  std::string name;  // in the key; one without a name is not in it
  std::vector<Sample> samples;
  std::size_t color = 0;  // of a fixed palette
  bool measured = true;   // marks with error bars along a line; otherwise a dashed line
};

struct Tick {
  double at = 0;
  std::string label;
};

struct Panel {
  std::string title, xAxis, yAxis;
  std::vector<Curve> curves;
  bool logarithmic = false;      // both axes, around the samples above 0; otherwise they begin at 0
  std::vector<Tick> ticks = {};  // of the x axis; gnuplot's own where there are none
};

// Charts of curves side by side, row by row.
struct PanelGrid {
  std::size_t columns = 1;
  std::vector<Panel> panels;
};

struct Mark {
  double x = 0, y = 0;
  double radius = 1;  // of a mark of medium size
  std::size_t color = 0;
  bool hollow = false;
  bool ringed = false;
  std::string label;  // beside it; left out where there is no room for it
};

struct ScatterPanel {
  std::string title, xAxis, yAxis;
  std::vector<Mark> marks;
  std::vector<Sample> front;  // in the order of x: a line in steps
};

// Marks over two logarithmic axes. A y of exactly 0 has a row of its own below the axis.
struct ScatterGrid {
  std::size_t columns = 1;
  std::vector<std::vector<Mark>> legend;  // rows of marks, each with its label; places are not used
  std::vector<ScatterPanel> panels;
};

enum class ChartFormat { svg, png };

// Writes the picture to gnuplot's standard output.
std::string gnuplotScript(const StackedBars& chart, ChartFormat format);
std::string gnuplotScript(const PanelGrid& grid, ChartFormat format);
std::string gnuplotScript(const ScatterGrid& grid, ChartFormat format);

// What gnuplot writes for a script; nothing where gnuplot is not installed. Throws Error (failed) where it fails.
std::optional<std::string> runGnuplot(const std::string& script);

}  // namespace halfsilver::bench
