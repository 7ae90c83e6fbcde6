#include "bench/report.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "bench/page.h"
#include "io/atomic_file.h"

namespace halfsilver::bench {

using Json = nlohmann::ordered_json;

std::string number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::string percent(double share, int digits) { return number(100 * share, digits) + " %"; }
std::string megabytes(double bytes) { return number(bytes / 1e6, bytes < 1e7 ? 2 : 1); }

std::string sceneOf(const Json& point) { return point["scene"]["file"].get<std::string>(); }
std::string presetOf(const Json& point) { return point["preset"].get<std::string>(); }
double memory(const Json& point, const char* name) { return point["memory"][name].get<double>(); }

std::string measuredWith(const Json& point) {
  const Json& device = point["device"];
  return "Measured with Halfsilver " + point["version"].get<std::string>() + " on " +
         device["renderer"].get<std::string>() + " (" + device["version"].get<std::string>() + ", " +
         device["context"].get<std::string>() + "), pictures of " + point["size"][0].dump() + " x " +
         point["size"][1].dump() + " pixels. All sizes are in MB, 10^6 bytes.";
}

std::string pictureFile(const std::string& name) {
  std::string file = name;
  for (char& c : file)
    if (c == ':' || c == ' ') c = '-';
  file += ".png";
  return file;
}

std::string readBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void keepPicture(const OutputFolder& folder, const std::string& name, const Workbench& bench) {
  AtomicFile file(folder / pictureFile(name));
  file.write(bench.thumbnail());
  file.commit();
}

std::vector<ScenePicture> readPictures(const OutputFolder& folder, const std::vector<BenchScene>& scenes) {
  std::vector<ScenePicture> pictures;
  for (const BenchScene& scene : scenes) pictures.push_back({scene.name, readBytes(folder / pictureFile(scene.name))});
  return pictures;
}

std::string gallery(const std::vector<ScenePicture>& scenes, const PointList& points,
                    const std::function<std::string(const Json&)>& caption) {
  std::string html = "<div class=\"scenes\">\n";
  for (const ScenePicture& scene : scenes) {
    const auto point =
        std::find_if(points.begin(), points.end(), [&](const Json& p) { return sceneOf(p) == scene.name; });
    if (scene.png.empty() || point == points.end()) continue;
    std::string text = scene.name + ", " + (*point)["scene"]["triangles"].dump() + " triangles";
    text += caption(*point);
    for (const Json& mirror : (*point)["scene"]["mirrors"]) text += ", mirror " + mirror.get<std::string>();
    html += thumbnail(scene.png, text);
  }
  return html + "</div>\n";
}

std::string chartFigure(const std::optional<std::string>& svg, const std::string& explanation) {
  if (!svg) return paragraph("gnuplot was not installed where this page was made: the chart is missing.");
  return inlineSvg(*svg) + paragraph(explanation);
}

void writeReport(const OutputFolder& folder, const Report& report) {
  std::optional<std::string> svg, png;
  if (report.chart) {
    svg = runGnuplot(report.chart(ChartFormat::svg));
    png = runGnuplot(report.chart(ChartFormat::png));
  }
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& [name, table] : report.tables) texts.emplace_back(name + ".csv", toCsv(table));
  if (svg) texts.emplace_back(report.mode + ".svg", *svg);
  if (png) texts.emplace_back(report.mode + ".png", *png);
  texts.emplace_back("index.html", report.page(svg));
  std::vector<AtomicFile> files;
  for (const auto& [name, text] : texts) files.emplace_back(folder / name).write(text);
  for (AtomicFile& file : files) file.commit();
  if (svg || !report.chart) return;
  // Charts of an earlier run would not be those of this table.
  for (const char* extension : {".svg", ".png"}) std::filesystem::remove(folder / (report.mode + extension));
  std::cerr << "warning: gnuplot is not installed (Debian: gnuplot-nox); there are no charts\n";
}

void warnOfLostFragments(const PointList& points) {
  for (const Json& point : points)
    if (point["lost_fragments"] != 0)
      std::cerr << "warning: " << sceneOf(point) << ", " << presetOf(point) << ": " << point["lost_fragments"]
                << " fragments found no room in the A-buffer\n";
}

}  // namespace halfsilver::bench
