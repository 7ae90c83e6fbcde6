#include "bench/chart.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <sstream>

#include <halfsilver/error.h>
#include "bench/gnuplot.h"

namespace halfsilver::bench {
namespace {

constexpr double kGroupGap = 0.8;  // bars

double sum(const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

struct Range {
  double low = 0.1, high = 1;
};

Range axisRange(const StackedBars& chart) {
  double least = 1e30, most = 0;
  for (const Bar& bar : chart.bars) {
    const double top = sum(bar.parts);
    if (top > 0) least = std::min(least, top);
    most = std::max(most, top);
  }
  if (most <= 0) return {};
  return {std::pow(10.0, std::floor(std::log10(least)) - (std::log10(least) - std::floor(std::log10(least)) < 0.3)),
          most * 2.5};
}

// End of an axis with a little room. Given, as gnuplot finds none where there are no points or all are 0.
double limit(const Panel& panel, double Sample::*value) {
  double most = 0;
  for (const Curve& curve : panel.curves)
    for (const Sample& sample : curve.samples) most = std::max(most, sample.*value);
  return most > 0 ? 1.04 * most : 1;
}

// The values above 0 with some room on both sides.
Range logarithmicRange(const Panel& panel, double Sample::*value) {
  constexpr double kRoom = 1.4;
  Range range{1e30, 0};
  for (const Curve& curve : panel.curves)
    for (const Sample& sample : curve.samples)
      if (sample.*value > 0)
        range = {std::min(range.low, sample.*value / kRoom), std::max(range.high, kRoom * sample.*value)};
  if (!(range.high > 0)) return {};
  // At least a decade, so that what hardly differs does not look as if it did.
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

// Centre of each bar.
std::vector<double> positions(const StackedBars& chart) {
  std::vector<double> centers;
  double x = 0;
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    if (i > 0) x += 1 + (chart.bars[i].group != chart.bars[i - 1].group ? kGroupGap : 0);
    centers.push_back(x);
  }
  return centers;
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporaryFile() {
  File file(std::tmpfile(), std::fclose);
  if (!file) throw Error(ErrorKind::failed, "no temporary file for gnuplot");
  return file;
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
  // Columns: centre, left, right, bottom, top.
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
      if (curve.measured)
        plots += data + " with yerrorlines pt 7 ps 0.4" + color + title;
      else
        plots += data + " with lines dt 2" + color + title;
    }
    script << plots << '\n';
  }
  script << "unset multiplot\n";
  return script.str();
}

std::optional<std::string> runGnuplot(const std::string& script) {
  const File input = temporaryFile(), output = temporaryFile();
  std::fwrite(script.data(), 1, script.size(), input.get());
  std::rewind(input.get());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(output.get()), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  char name[] = "gnuplot";
  char* arguments[] = {name, nullptr};
  pid_t child = 0;
  const int spawned = ::posix_spawnp(&child, name, &actions, nullptr, arguments, ::environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (spawned != 0) return std::nullopt;
  if (::waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(ErrorKind::failed, "gnuplot failed to draw a chart");
  std::fseek(output.get(), 0, SEEK_END);
  std::string result(static_cast<std::size_t>(std::max(0L, std::ftell(output.get()))), '\0');
  std::rewind(output.get());
  result.resize(std::fread(result.data(), 1, result.size(), output.get()));
  return result;
}

}  // namespace halfsilver::bench
