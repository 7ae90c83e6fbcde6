#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/charts/chart.h"
#include "bench/report/charts/gnuplot.h"
#include "bench/report/table.h"

// The files of a report.
namespace halfsilver::bench {

// A chart's files; nothing if gnuplot is not installed.
struct ChartFiles {
  std::optional<std::string> svg, png;
};

// Of any of the charts in charts/chart.h.
template <class Chart>
ChartFiles drawChart(const Chart& chart) {
  return {runGnuplot(gnuplotScript(chart, ChartFormat::svg)), runGnuplot(gnuplotScript(chart, ChartFormat::png))};
}

// What is said about a set of points.
struct Report {
  std::string name = {};                              // of the chart's files
  std::string title;                                  // of the page
  std::vector<std::pair<std::string, Table>> tables;  // each with the name of its CSV file without ".csv"
  std::optional<ChartFiles> chart;                    // nothing if the report has none
  std::string body;                                   // of the page, HTML
  Table summary;                                      // for a terminal
  std::vector<std::string> warnings = {};             // one line each
};

// Writes all files of the reports and the page; none appears until all are complete. Warns on stderr if gnuplot is not
// installed.
void writeReports(const std::filesystem::path& folder, std::span<const Report> reports, const std::string& page);

}  // namespace halfsilver::bench
