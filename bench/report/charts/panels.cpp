#include <algorithm>
#include <cmath>
#include <sstream>

#include "bench/report/charts/chart.h"
#include "bench/report/charts/gnuplot.h"

namespace halfsilver::bench {
namespace {

// Upper end of an axis, with a margin. gnuplot finds none itself if there are no points or all are 0.
double limit(const Panel& panel, double Sample::*value) {
  double max = 0;
  for (const Curve& curve : panel.curves)
    for (const Sample& sample : curve.samples) max = std::max(max, sample.*value);
  return max > 0 ? 1.04 * max : 1;
}

// Range of the values above 0, with a margin on both sides.
Range logarithmicRange(const Panel& panel, double Sample::*value) {
  constexpr double kMargin = 1.4;
  Range range{1e30, 0};
  for (const Curve& curve : panel.curves)
    for (const Sample& sample : curve.samples)
      if (sample.*value > 0)
        range = {std::min(range.low, sample.*value / kMargin), std::max(range.high, kMargin * sample.*value)};
  if (!(range.high > 0)) return {};
  // At least a decade, so that small differences do not look large.
  const double missing = std::sqrt(std::max(1.0, 10 * range.low / range.high));
  return {range.low / missing, range.high * missing};
}

std::string decadeTicks(const Range& range) {
  std::ostringstream list;
  for (const double tick : logarithmicTicks(range.low, range.high)) list << (list.tellp() > 0 ? "," : "(") << tick;
  list << ')';
  return list.str();
}

std::string ticksOf(const Panel& panel) {
  if (panel.ticks.empty()) return "autofreq";
  std::string list;
  for (const Tick& tick : panel.ticks)
    list += (list.empty() ? "(" : ", ") + quoted(tick.label) + ' ' + std::to_string(tick.at);
  return list + ')';
}

}  // namespace

std::string gnuplotScript(const PanelGrid& grid, ChartFormat format) {
  const std::size_t rows = (grid.panels.size() + grid.columns - 1) / grid.columns;
  std::ostringstream script;
  script << terminal(format, 440.0 * static_cast<double>(grid.columns), 360.0 * static_cast<double>(rows))
         << "set multiplot layout " << rows << ',' << grid.columns << '\n'
         << "set grid lc rgb \"#dddddd\"\nset border 3\nset tics nomirror out\n"
         << "set bmargin 6\nset key bmargin center horizontal samplen 1.5 font \",10\"\n";
  for (std::size_t index = 0; index < grid.panels.size(); ++index) {
    const Panel& panel = grid.panels[index];
    script << "set title " << quoted(panel.title) << "\nset xlabel " << quoted(panel.xAxis) << "\nset ylabel "
           << quoted(panel.yAxis) << "\nset xtics " << ticksOf(panel) << '\n';
    if (panel.logarithmic) {
      const Range x = logarithmicRange(panel, &Sample::x), y = logarithmicRange(panel, &Sample::y);
      script << "set logscale xy 10\nset ytics " << decadeTicks(y) << "\nset format y \"%g\"\nset xrange [" << x.low
             << ':' << x.high << "]\nset yrange [" << y.low << ':' << y.high << "]\n";
    } else {
      script << "unset logscale\nset ytics autofreq\nset format y\nset xrange [0:" << limit(panel, &Sample::x)
             << "]\nset yrange [0:" << limit(panel, &Sample::high) << "]\n";
    }
    // Columns: x, y, low, high.
    std::string plots;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      const Curve& curve = panel.curves[i];
      const std::string data = "$panel" + std::to_string(index) + "curve" + std::to_string(i);
      const std::string color = std::string(" lc rgb \"") + kColors[curve.color % std::size(kColors)] + '"';
      const std::string title = curve.name.empty() ? " notitle" : std::string(" title ") + quoted(curve.name);
      script << data << " << END\n";
      for (const Sample& sample : curve.samples)
        script << sample.x << ' ' << sample.y << ' ' << sample.low << ' ' << sample.high << '\n';
      script << "NaN NaN NaN NaN\nEND\n";
      plots += plots.empty() ? "plot " : ", ";
      if (curve.measured && !curve.marks)
        plots += data + " with lines" + color + title;
      else if (curve.measured)
        plots += data + " with yerrorlines pt 7 ps 0.4" + color + title;
      else
        plots += data + " with lines dt 2" + color + title;
    }
    script << plots << '\n';
  }
  script << "unset multiplot\n";
  return script.str();
}

}  // namespace halfsilver::bench
