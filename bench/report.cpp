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
namespace {

constexpr const char* kIntroduction = R"(<p>Halfsilver draws a picture by rasterization and traces rays only where a
surface reflects. To find what a ray meets without ray-tracing hardware, the triangles are rasterized once more, from
three sides, into a <em>structure</em> that rays can walk through: a coarse grid of voxels, and an <em>A-buffer</em>,
which keeps a list of surface fragments for each texel. Methods differ in what a fragment is, where it is kept and how
rays search for it. A <em>preset</em> is a method with all its settings:</p>
<ul>
<li><b>halfsilver</b>: the default. A fragment is the number of its triangle (4 bytes), kept in one of three axes and
only for voxels that a ray asks for; the ray is tested against the triangle itself.</li>
<li><b>kastrati2017</b>: Kastrati &amp; Goswami 2017. A fragment holds the surface's attributes (32 bytes) and is kept
in the dominant axis of its voxel, in pages of four; rays compare depths.</li>
<li><b>hu2014</b>: Hu et al. 2014. The same fragments in all three axes, in sorted linked lists.</li>
<li><b>reference</b>: exact rays on the CPU (Embree). It traces the same rays, so a difference from it is an error of
the method.</li>
</ul>
)";

}  // namespace

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

std::string introduction() { return kIntroduction; }

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

std::vector<ScenePicture> readPictures(const OutputFolder& folder, const std::vector<BenchScene>& scenes,
                                       std::string (*nameOf)(const std::string&)) {
  std::vector<ScenePicture> pictures;
  for (const BenchScene& scene : scenes)
    pictures.push_back({scene.name, readBytes(folder / pictureFile(nameOf ? nameOf(scene.name) : scene.name))});
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

void writeReports(const OutputFolder& folder, std::span<const Report> reports, const std::string& page) {
  std::vector<std::pair<std::string, std::string>> texts;
  bool missing = false;
  for (const Report& report : reports) {
    for (const auto& [name, table] : report.tables) texts.emplace_back(name + ".csv", toCsv(table));
    if (!report.chart) continue;
    missing = missing || !report.chart->svg;
    if (report.chart->svg) texts.emplace_back(report.mode + ".svg", *report.chart->svg);
    if (report.chart->png) texts.emplace_back(report.mode + ".png", *report.chart->png);
  }
  texts.emplace_back("index.html", page);
  std::vector<AtomicFile> files;
  for (const auto& [name, text] : texts) files.emplace_back(folder / name).write(text);
  for (AtomicFile& file : files) file.commit();
  if (!missing) return;
  // Charts of an earlier run would not be those of these tables.
  for (const Report& report : reports)
    for (const char* extension : {".svg", ".png"})
      if (report.chart) std::filesystem::remove(folder / (report.mode + extension));
  std::cerr << "warning: gnuplot is not installed (Debian: gnuplot-nox); there are no charts\n";
}

std::vector<std::string> lostFragments(const PointList& points) {
  std::vector<std::string> warnings;
  for (const Json& point : points)
    if (point["lost_fragments"] != 0)
      warnings.push_back(sceneOf(point) + ", " + presetOf(point) + ": " + point["lost_fragments"].dump() +
                         " fragments found no room in the A-buffer");
  return warnings;
}

}  // namespace halfsilver::bench
