#include "bench/modes/stability/report.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/harness/output_folder.h"
#include "bench/harness/request.h"
#include "bench/report/page.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr double kMaxWrong = 5e-4, kMaxFlips = 1e-4;  // shares

constexpr int kDigits = 3;  // of percentages

std::string share(double value) { return percent(value, kDigits); }
std::string decimal(double value) { return number(value, 5); }

std::vector<std::string> methodsOf(StabilityPoints points) {
  std::vector<std::string> methods;
  for (const StabilityPoint& point : points)
    if (std::find(methods.begin(), methods.end(), point.preset) == methods.end()) methods.push_back(point.preset);
  return methods;
}

std::vector<std::string> scenesOf(StabilityPoints points) {
  std::vector<std::string> scenes;
  for (const StabilityPoint& point : points)
    if (scenes.empty() || scenes.back() != point.scene.file) scenes.push_back(point.scene.file);
  return scenes;
}

bool wrong(const StabilityResult& result) { return result.worstHitError > kMaxWrong; }
bool overflows(const StabilityResult& result) { return result.overflow > 0 || result.lostFragments > 0; }
bool flickers(const StabilityResult& result) { return result.flicker99 > 0 || result.flickerHits > kMaxFlips; }

// "survives", or why the method fails.
std::string verdict(const StabilityResult& result) {
  if (survives(result)) return "survives";
  std::string faults;
  const auto add = [&](bool applies, const std::string& fault) {
    if (applies) faults += (faults.empty() ? "" : ", ") + fault;
  };
  add(wrong(result), "wrong " + share(result.worstHitError));
  add(overflows(result), "overflow");
  add(flickers(result), "flickers");
  add(!result.repeatsExactly, "does not repeat");
  return faults;
}

Table survivors(StabilityPoints points) {
  Table table{{"Scene", "What is hard about it"}, {}};
  const std::vector<std::string> methods = methodsOf(points);
  table.columns.insert(table.columns.end(), methods.begin(), methods.end());
  for (const std::string& scene : scenesOf(points)) {
    std::vector<std::string> row(table.columns.size());
    row[0] = scene;
    for (const StabilityPoint& point : points) {
      if (point.scene.file != scene) continue;
      row[1] = point.cause;
      const auto at = std::find(methods.begin(), methods.end(), point.preset);
      row[2 + static_cast<std::size_t>(at - methods.begin())] = verdict(point);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

constexpr const char* kIntroduction =
    "Each scene of this part is the smallest that breaks some method, and is named after the cause. Every method draws "
    "it still and during a slow motion of the camera or of an object, and is compared with the reference ray by ray.";

constexpr const char* kMeasures =
    "<ul>\n<li><b>Wrong hits</b>: the share of the rays that hit although the reference misses, miss although it hits, "
    "or hit more than 0.1 % of the scene's diagonal away from it; still, and in the worst frame of the motion.</li>\n"
    "<li><b>Flicker</b>: how much a traced pixel changes from frame to frame beyond the change of the reference "
    "(display values 0 to 1), on average and for the worst hundredth; and the share of pixels that change between hit "
    "and miss although the reference does not. A constant error does not flicker.</li>\n"
    "<li><b>Repeats</b>: drawing the same frame again and again gives the same result to the bit.</li>\n"
    "<li><b>Survives</b>: at most 0.05 % wrong in every frame, no overflow, no flicker at the 99th percentile, at most "
    "0.01 % between hit and miss, repeats to the bit.</li>\n</ul>\n";

constexpr std::tuple kColumns{
    &StabilityResult::rays,          &StabilityResult::hitError,  &StabilityResult::falseMiss,
    &StabilityResult::worstHitError, &StabilityResult::overflow,  &StabilityResult::lostFragments,
    &StabilityResult::flickerMean,   &StabilityResult::flicker99, &StabilityResult::flickerHits,
    &StabilityResult::quietSteps,    &StabilityResult::steps,     &StabilityResult::repeatsExactly};

}  // namespace

bool survives(const StabilityResult& result) {
  return !wrong(result) && !overflows(result) && !flickers(result) && result.repeatsExactly;
}

Table stabilityTable(StabilityPoints points) {
  Table table{{"scene", "method", "rays", "wrong", "worst", "overflow", "flicker", "99 %", "hit/miss", "repeats", ""},
              {}};
  for (const StabilityPoint& point : points)
    table.rows.push_back({point.scene.file, point.preset, std::to_string(point.rays), share(point.hitError),
                          share(point.worstHitError), share(point.overflow), decimal(point.flickerMean),
                          decimal(point.flicker99), share(point.flickerHits), point.repeatsExactly ? "yes" : "no",
                          survives(point) ? "survives" : "fails"});
  return table;
}

Table stabilityCsv(StabilityPoints points) {
  Table table{{"scene", "cause", "method"}, {}};
  addKeys(table.columns, kColumns);
  table.columns.emplace_back("survives");
  for (const StabilityPoint& point : points) {
    std::vector<std::string> row = {point.scene.file, point.cause, point.preset};
    addValues(row, point, kColumns);
    row.emplace_back(survives(point) ? "true" : "false");
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string stabilityBody(StabilityPoints points, const std::map<std::string, std::string>& pictures) {
  std::string body =
      paragraph(std::string(kIntroduction) + " A motion has " + std::to_string(points.front().frames) + " steps.");
  body += heading("Who survives what") + toHtml(survivors(points)) + kMeasures;
  body += heading("The pictures") +
          paragraph("The reference, then each method; a method that survives shows the same picture.");
  for (const std::string& scene : scenesOf(points)) {
    body += "<h3>" + escapeHtml(scene);
    body += "</h3>\n<div class=\"scenes\">\n";
    const auto show = [&](const std::string& method, const std::string& caption) {
      const auto picture = pictures.find(pictureName(scene, method));
      if (picture != pictures.end()) body += thumbnail(picture->second, caption);
    };
    show(kReference, kReference);
    for (const StabilityPoint& point : points)
      if (point.scene.file == scene) {
        std::string caption = point.preset;
        caption += ": ";
        caption += verdict(point);
        show(point.preset, caption);
      }
    body += "</div>\n";
  }
  body += heading("All figures") + toHtml(stabilityTable(points));
  return body;
}

}  // namespace halfsilver::bench
