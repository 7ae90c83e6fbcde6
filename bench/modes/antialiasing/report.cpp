#include "bench/modes/antialiasing/report.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/harness/output_folder.h"
#include "bench/report/page.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

std::string decimal(double value) { return number(value, 5); }

constexpr const char* kIntroduction =
    "Each scene is drawn during a slow pan, by a quarter of a pixel to the right and an eighth up per frame, once with "
    "one sample per pixel and once with frames joined over time. "
    "The truth of every frame is the mean of many samples in each pixel.";

constexpr const char* kMeasures =
    "<ul>\n<li><b>Flicker</b>: how much a pixel changes from frame to frame beyond the change of the truth (radiance "
    "clipped to 0 to 1), on average and for the worst hundredth; of all pixels, and of those that are traced. An edge "
    "that moves by less than a pixel changes the truth a little in every frame, and a picture of single samples "
    "by everything at once.</li>\n"
    "<li><b>Left</b>: flicker as a share of that without antialiasing.</li>\n"
    "<li><b>Error</b>: root of the mean squared difference from the truth. A blurred picture does not flicker but "
    "errs; "
    "antialiasing is worth something if both fall.</li>\n</ul>\n";

constexpr std::tuple kColumns{&AntialiasingResult::flickerMean, &AntialiasingResult::flicker99,
                              &AntialiasingResult::flickerTracedMean, &AntialiasingResult::flickerTraced99,
                              &AntialiasingResult::rmse};

}  // namespace

std::optional<double> flickerLeft(AntialiasingPoints points, const AntialiasingPoint& point) {
  const auto plain = std::find_if(points.begin(), points.end(), [&](const AntialiasingPoint& other) {
    return other.preset == kNone && other.scene.file == point.scene.file;
  });
  if (plain == points.end() || plain->flickerMean <= 0) return std::nullopt;
  return point.flickerMean / plain->flickerMean;
}

Table antialiasingTable(AntialiasingPoints points) {
  Table table{{"scene", "antialiasing", "flicker", "left", "99 %", "traced", "99 % traced", "error"}, {}};
  for (const AntialiasingPoint& point : points) {
    const std::optional<double> left = flickerLeft(points, point);
    table.rows.push_back({point.scene.file, point.preset, decimal(point.flickerMean), left ? percent(*left) : "",
                          decimal(point.flicker99), decimal(point.flickerTracedMean), decimal(point.flickerTraced99),
                          decimal(point.rmse)});
  }
  return table;
}

Table antialiasingCsv(AntialiasingPoints points) {
  Table table{{"scene", "antialiasing"}, {}};
  addKeys(table.columns, kColumns);
  for (const AntialiasingPoint& point : points) {
    std::vector<std::string> row = {point.scene.file, point.preset};
    addValues(row, point, kColumns);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string antialiasingBody(AntialiasingPoints points, const std::map<std::string, std::string>& pictures) {
  const AntialiasingPoint& first = points.front();
  std::string body = paragraph(std::string(kIntroduction) + " Measured are " + std::to_string(first.frames) +
                               " steps, after " + std::to_string(first.before) + " that do not count; the truth has " +
                               std::to_string(first.samples) + " samples.");
  body += toHtml(antialiasingTable(points)) + kMeasures;
  std::vector<Figure> figures;
  const auto show = [&](const std::string& scene, const std::string& kind) {
    const std::string name = pictureName(scene, kind);
    if (const auto picture = pictures.find(name); picture != pictures.end()) figures.push_back({picture->second, name});
  };
  for (const AntialiasingPoint& point : points) {
    show(point.scene.file, point.preset);
    if (&point == &points.back() || (&point + 1)->scene.file != point.scene.file) show(point.scene.file, kTruth);
  }
  return body + heading("The last frame") + gallery(figures);
}

}  // namespace halfsilver::bench
