#include "apps/tune_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include <halfsilver/io.h>
#include "apps/program.h"

namespace halfsilver {
namespace {

constexpr const char* kHeading = "        ms          MB  hit_error  runs  settings\n";
constexpr const char* kMeaning =
    "ms: GPU time of voxelize + build + trace, built from scratch (abuffer.keep=false), median of the runs; one run if "
    "another point is clearly better.";

std::vector<Cost> costs(const std::vector<TunePoint>& points) {
  std::vector<Cost> result;
  for (const TunePoint& point : points) result.push_back(point.cost);
  return result;
}

std::string row(const TuneReport& report, std::size_t index) {
  const TunePoint& point = report.points[index];
  char numbers[96];
  std::snprintf(numbers, sizeof(numbers), "%10.3f  %10.3f  %9.6f  %4zu  ", point.cost.milliseconds,
                static_cast<double>(point.cost.bytes) / 1e6, point.cost.error, point.runs);
  return std::string(numbers) + point.candidate.text() + (index == report.choice ? "  <- chosen\n" : "\n");
}

std::string number(const char* pattern, double value) {
  char text[32];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
}

std::string summary(const TuneReport& report) {
  return report.view + ", " + std::to_string(report.triangles) + " triangles, " + std::to_string(report.width) + 'x' +
         std::to_string(report.height) + ", " + number("%.2f", 100 * report.coverage) + " % of the pixels traced";
}

// Names may contain what a comment must not: control characters and bytes that are not UTF-8.
std::string comment(const std::string& text) {
  const std::string quoted = nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return std::string("# ").append(quoted, 1, quoted.size() - 2) + '\n';
}

}  // namespace

std::string tuneTable(const TuneReport& report) {
  const std::vector<Cost> all = costs(report.points);
  const std::vector<std::size_t> front = paretoFront(all);
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return all[a].milliseconds < all[b].milliseconds; });
  std::string table = summary(report) + ", " + report.device.renderer + " (" + report.context + ")\n  " + kHeading;
  for (const std::size_t index : order)
    table += (std::find(front.begin(), front.end(), index) != front.end() ? "* " : "  ") + row(report, index);
  table += "*: on the Pareto front: no other point is at least as good in time, memory and error\n";
  table += kMeaning;
  table += '\n';
  for (const std::string& line : report.skipped) table += "skipped: " + line + '\n';
  return table;
}

std::string tuneConfig(const TuneReport& report) {
  const TunePoint& chosen = report.points[report.choice];
  std::string text = "# The fastest settings with hit_error at most " + number("%g", report.maxError) + '\n';
  text += comment("halfsilver tune " + std::string(version()) + ": " + summary(report));
  text += comment(report.device.renderer + ", OpenGL " + report.device.version + " (" + report.context + ')');
  text += comment(kMeaning);
  text += "# The Pareto front of time, memory and error:\n";
  text += std::string("# ") + kHeading;
  for (const std::size_t index : paretoFront(costs(report.points))) text += std::string("# ") + row(report, index);
  std::vector<std::string> always = chosen.candidate.tuned;
  always.emplace_back("trace.method");
  return text + '\n' + settingsText(chosen.candidate.settings, always);
}

}  // namespace halfsilver
