#pragma once

#include <cstddef>
#include <string>
#include <vector>

// Charts as scripts for gnuplot.
namespace halfsilver::bench {

struct Bar {
  std::string group, name;    // bars of one group stand together
  std::vector<double> parts;  // from the bottom, one per StackedBars::parts
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
  double low = 0, high = 0;  // of the error bar
};

struct Curve {
  std::string name;  // in the key; empty: not in the key
  std::vector<Sample> samples;
  std::size_t color = 0;  // index into a fixed palette
  bool measured = true;   // a line with marks and error bars; otherwise a dashed line
  bool marks = true;      // false: of what is measured only the line, for many samples
};

struct Tick {
  double at = 0;
  std::string label;
};

struct Panel {
  std::string title, xAxis, yAxis;
  std::vector<Curve> curves;
  bool logarithmic = false;      // both axes, around the samples above 0; otherwise the axes begin at 0
  std::vector<Tick> ticks = {};  // of the x axis; empty: gnuplot's own
};

// Charts of curves side by side, row by row.
struct PanelGrid {
  std::size_t columns = 1;
  std::vector<Panel> panels;
};

struct Mark {
  double x = 0, y = 0;
  double radius = 1;  // 1: a mark of medium size
  std::size_t color = 0;
  bool hollow = false;
  bool ringed = false;
  std::string label;  // beside the mark; left out if there is no room
};

struct ScatterPanel {
  std::string title, xAxis, yAxis;
  std::vector<Mark> marks;
  std::vector<Sample> front;  // in order of x; drawn as a staircase
};

// Marks over two logarithmic axes. Marks whose y is exactly 0 have their own row below the axis.
struct ScatterGrid {
  std::size_t columns = 1;
  std::vector<std::vector<Mark>> legend;  // rows of marks, each with its label; x and y are not used
  std::vector<ScatterPanel> panels;
};

enum class ChartFormat { svg, png };

// The script makes gnuplot write the picture to its standard output.
std::string gnuplotScript(const StackedBars& chart, ChartFormat format);
std::string gnuplotScript(const PanelGrid& grid, ChartFormat format);
std::string gnuplotScript(const ScatterGrid& grid, ChartFormat format);

}  // namespace halfsilver::bench
