#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "bench/report/charts/chart.h"
#include "bench/report/charts/gnuplot.h"

namespace halfsilver::bench {
namespace {

constexpr double kGroupGap = 0.8;  // bars

double sum(const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

Range axisRange(const StackedBars& chart) {
  double min = 1e30, max = 0;
  for (const Bar& bar : chart.bars) {
    const double top = sum(bar.parts);
    if (top > 0) min = std::min(min, top);
    max = std::max(max, top);
  }
  if (max <= 0) return {};
  return {std::pow(10.0, std::floor(std::log10(min)) - (std::log10(min) - std::floor(std::log10(min)) < 0.3)),
          max * 2.5};
}

// Center of each bar.
std::vector<double> positions(const StackedBars& chart) {
  std::vector<double> centers;
  double x = 0;
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    if (i > 0) x += 1 + (chart.bars[i].group != chart.bars[i - 1].group ? kGroupGap : 0);
    centers.push_back(x);
  }
  return centers;
}

}  // namespace

std::string gnuplotScript(const StackedBars& chart, ChartFormat format) {
  const std::vector<double> centers = positions(chart);
  const Range range = axisRange(chart);
  std::ostringstream script;
  const double width = std::max(800.0, 46 * (centers.empty() ? 1 : centers.back() + 2) + 120);
  script << terminal(format, width, 480) << "set title " << quoted(chart.title) << "\nset ylabel " << quoted(chart.axis)
         << '\n'
         << "set logscale y 10\nset yrange [" << range.low << ':' << range.high << "]\n"
         << "set xrange [-0.8:" << (centers.empty() ? 1 : centers.back()) + 0.8 << "]\n"
         << "set format y \"%g\"\nset grid ytics lc rgb \"#dddddd\"\nset border 3\nset tics nomirror out\n"
         << "set style fill solid 1 noborder\nset key outside top center horizontal maxrows 1 samplen 1 font "
            "\",10\"\nset bmargin 8\n";
  std::string tics;
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const Bar& bar = chart.bars[i];
    tics += (i ? ", " : "") + quoted(bar.name) + ' ' + std::to_string(centers[i]);
    script << "set label " << quoted(bar.label) << " at " << centers[i] << ',' << std::max(range.low, sum(bar.parts))
           << " center offset 0,0.5 font \",9\"\n";
    if (i > 0 && bar.group == chart.bars[i - 1].group) continue;
    std::size_t last = i;
    while (last + 1 < chart.bars.size() && chart.bars[last + 1].group == bar.group) ++last;
    script << "set label " << quoted(bar.group) << " at " << (centers[i] + centers[last]) / 2
           << ", screen 0.04 center font \",13\"\n";
  }
  script << "set xtics rotate by 35 right font \",10\" (" << tics << ")\n";
  // Columns: center, left, right, bottom, top.
  for (std::size_t part = 0; part < chart.parts.size(); ++part) {
    script << "$part" << part << " << END\n";
    for (std::size_t i = 0; i < chart.bars.size(); ++i) {
      const auto first = chart.bars[i].parts.begin();
      const double bottom = std::accumulate(first, first + static_cast<std::ptrdiff_t>(part), 0.0);
      const double top = bottom + chart.bars[i].parts[part];
      if (top > std::max(bottom, range.low))
        script << centers[i] << ' ' << centers[i] - 0.36 << ' ' << centers[i] + 0.36 << ' '
               << std::max(bottom, range.low) << ' ' << top << '\n';
    }
    script << "NaN NaN NaN NaN NaN\nEND\n";
  }
  script << "plot ";
  for (std::size_t part = 0; part < chart.parts.size(); ++part)
    script << (part ? ", " : "") << "$part" << part << " using 1:($4):2:3:4:5 with boxxyerror lc rgb \""
           << kColors[part % std::size(kColors)] << "\" title " << quoted(chart.parts[part]);
  script << '\n';
  return script.str();
}

}  // namespace halfsilver::bench
