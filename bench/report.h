#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/chart.h"
#include "bench/points.h"
#include "bench/table.h"
#include "bench/workbench.h"

// What the reports of all modes share: points as text, and the files of a report.
namespace halfsilver::bench {

using PointList = std::vector<nlohmann::ordered_json>;

std::string number(double value, int digits);  // after the point
std::string percent(double share, int digits = 1);
std::string megabytes(double bytes);

std::string sceneOf(const nlohmann::ordered_json& point);
std::string presetOf(const nlohmann::ordered_json& point);
double memory(const nlohmann::ordered_json& point, const char* name);  // bytes, a member of "memory"

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
std::vector<ScenePicture> readPictures(const OutputFolder& folder, const std::vector<BenchScene>& scenes);
// The pictures side by side. `caption` tells what stands behind a scene's name and triangles.
std::string gallery(const std::vector<ScenePicture>& scenes, const PointList& points,
                    const std::function<std::string(const nlohmann::ordered_json&)>& caption);

// The chart and the text below it, or that it is missing.
std::string chartFigure(const std::optional<std::string>& svg, const std::string& explanation);

struct Report {
  std::string mode;                                                        // names the files
  std::vector<std::pair<std::string, Table>> tables;                       // name of the CSV file without ".csv"
  std::function<std::string(ChartFormat)> chart;                           // a script for gnuplot; may be empty
  std::function<std::string(const std::optional<std::string>& svg)> page;  // no chart where gnuplot is missing
};

// All files of a report, each whole before any appears. Warns on stderr where gnuplot is missing.
void writeReport(const OutputFolder& folder, const Report& report);

// Warns on stderr of points that lost fragments.
void warnOfLostFragments(const PointList& points);

}  // namespace halfsilver::bench
