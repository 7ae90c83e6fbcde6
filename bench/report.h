#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/chart.h"
#include "bench/points.h"
#include "bench/table.h"
#include "bench/workbench.h"

// What the reports of all modes share: points as text, and the files of a report.
namespace halfsilver::bench {

std::string number(double value, int digits);  // after the point
std::string percent(double share, int digits = 1);
std::string megabytes(double bytes);

std::string sceneOf(const nlohmann::ordered_json& point);
std::string presetOf(const nlohmann::ordered_json& point);
double memory(const nlohmann::ordered_json& point, const char* name);  // bytes, a member of "memory"

// What Halfsilver and its presets are, for someone who sees them for the first time; HTML.
std::string introduction();
// "Measured with Halfsilver 0.1 on ...": what all points of a report have in common.
std::string measuredWith(const nlohmann::ordered_json& point);

struct ScenePicture {
  std::string name;
  std::string png;  // bytes; empty where it is missing
};

// File of a picture in the folder: "builtin:sphere" is in builtin-sphere.png.
std::string pictureFile(const std::string& name);
// The last frame as a picture in the folder.
void keepPicture(const OutputFolder& folder, const std::string& name, const Workbench& bench);
std::string readBytes(const std::filesystem::path& file);  // nothing where it is missing
// `nameOf` tells a picture's name by its scene's; without it they are the same.
std::vector<ScenePicture> readPictures(const OutputFolder& folder, const std::vector<BenchScene>& scenes,
                                       std::string (*nameOf)(const std::string&) = nullptr);
// The pictures side by side. `caption` tells what stands behind a scene's name and triangles.
std::string gallery(const std::vector<ScenePicture>& scenes, const PointList& points,
                    const std::function<std::string(const nlohmann::ordered_json&)>& caption);

// A chart's files; nothing where gnuplot is missing.
struct ChartFiles {
  std::optional<std::string> svg, png;
};

// Of any of the charts in chart.h.
template <class Chart>
ChartFiles drawChart(const Chart& chart) {
  return {runGnuplot(gnuplotScript(chart, ChartFormat::svg)), runGnuplot(gnuplotScript(chart, ChartFormat::png))};
}

// The chart and the text below it, or that it is missing.
std::string chartFigure(const std::optional<std::string>& svg, const std::string& explanation);

// What a mode says about its points.
struct Report {
  std::string mode = {};                              // names the chart's files
  std::string title;                                  // of the page
  std::vector<std::pair<std::string, Table>> tables;  // name of the CSV file without ".csv"
  std::optional<ChartFiles> chart;                    // nothing for a mode without one
  std::string body;                                   // of the page, HTML; stands below introduction()
  Table summary;                                      // for a terminal
  std::vector<std::string> warnings = {};             // one line each
};

// All files of the reports, each whole before any appears. Warns on stderr where gnuplot is missing.
void writeReports(const OutputFolder& folder, std::span<const Report> reports, const std::string& page);

// A line for each point that lost fragments.
std::vector<std::string> lostFragments(const PointList& points);

}  // namespace halfsilver::bench
