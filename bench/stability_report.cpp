#include "bench/stability_report.h"

#include <algorithm>
#include <cstdio>

#include "bench/page.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostWrong = 5e-4, kMostFlips = 1e-4;  // shares

constexpr int kDigits = 3;  // of percentages

std::string share(const Json& value) { return percent(value.get<double>(), kDigits); }
std::string decimal(const Json& value) { return number(value.get<double>(), 5); }

std::vector<std::string> methodsOf(const PointList& points) {
  std::vector<std::string> methods;
  for (const Json& point : points)
    if (std::find(methods.begin(), methods.end(), presetOf(point)) == methods.end()) methods.push_back(presetOf(point));
  return methods;
}

std::vector<std::string> scenesOf(const PointList& points) {
  std::vector<std::string> scenes;
  for (const Json& point : points)
    if (scenes.empty() || scenes.back() != sceneOf(point)) scenes.push_back(sceneOf(point));
  return scenes;
}

// What a method falls to, in a few words.
std::string verdict(const Json& point) {
  if (survives(point)) return "survives";
  std::string faults;
  const auto fault = [&](bool has, const std::string& what) {
    if (!has) return;
    if (!faults.empty()) faults += ", ";
    faults += what;
  };
  fault(point["worst_hit_error"].get<double>() > kMostWrong, "wrong " + share(point["worst_hit_error"]));
  fault(point["overflow"].get<double>() > 0 || point["lost_fragments"].get<std::uint64_t>() > 0, "overflow");
  fault(point["flicker_99"].get<double>() > 0 || point["flicker_hits"].get<double>() > kMostFlips, "flickers");
  fault(!point["repeats_to_the_bit"].get<bool>(), "does not repeat");
  return faults;
}

Table survivors(const PointList& points) {
  Table table{{"Scene", "What is hard about it"}, {}};
  const std::vector<std::string> methods = methodsOf(points);
  table.columns.insert(table.columns.end(), methods.begin(), methods.end());
  for (const std::string& scene : scenesOf(points)) {
    std::vector<std::string> row(table.columns.size());
    row[0] = scene;
    for (const Json& point : points) {
      if (sceneOf(point) != scene) continue;
      row[1] = point["cause"].get<std::string>();
      const auto at = std::find(methods.begin(), methods.end(), presetOf(point));
      row[2 + static_cast<std::size_t>(at - methods.begin())] = verdict(point);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

constexpr const char* kIntroduction =
    "Each scene of this part is the smallest that breaks some method, and is named for the cause. Every method draws "
    "it still and over a slow move of the camera or of an object, and is compared with the reference ray for ray.";

constexpr const char* kMeasures =
    "<ul>\n<li><b>Wrong hits</b>: the share of the rays that hit where the reference misses, miss where it hits, or "
    "hit "
    "further than 0.1 % of the scene's diagonal from it; still, and in the worst frame of the move.</li>\n"
    "<li><b>Flicker</b>: how much a traced pixel changes from frame to frame beyond the change of the reference "
    "(display values 0 to 1), on average and for the worst hundredth; and the share of pixels that change between hit "
    "and miss where the reference does not. A constant error does not flicker.</li>\n"
    "<li><b>Repeats</b>: the same frame drawn again and again is the same to the bit.</li>\n"
    "<li><b>Survives</b>: at most 0.05 % wrong in every frame, no overflow, no flicker at the 99th percentile, at most "
    "0.01 % between hit and miss, repeats to the bit.</li>\n</ul>\n";

}  // namespace

bool survives(const Json& point) {
  return point["worst_hit_error"].get<double>() <= kMostWrong && point["overflow"].get<double>() == 0 &&
         point["lost_fragments"].get<std::uint64_t>() == 0 && point["flicker_99"].get<double>() == 0 &&
         point["flicker_hits"].get<double>() <= kMostFlips && point["repeats_to_the_bit"].get<bool>();
}

Table stabilityTable(const PointList& points) {
  Table table{{"scene", "method", "rays", "wrong", "worst", "overflow", "flicker", "99 %", "hit/miss", "repeats", ""},
              {}};
  for (const Json& point : points)
    table.rows.push_back({sceneOf(point), presetOf(point), point["rays"].dump(), share(point["hit_error"]),
                          share(point["worst_hit_error"]), share(point["overflow"]), decimal(point["flicker_mean"]),
                          decimal(point["flicker_99"]), share(point["flicker_hits"]),
                          point["repeats_to_the_bit"].get<bool>() ? "yes" : "no",
                          survives(point) ? "survives" : "fails"});
  return table;
}

Table stabilityCsv(const PointList& points) {
  constexpr const char* values[] = {"rays",         "hit_error",      "false_miss",   "worst_hit_error",
                                    "overflow",     "lost_fragments", "flicker_mean", "flicker_99",
                                    "flicker_hits", "quiet_steps",    "steps",        "repeats_to_the_bit"};
  Table table{{"scene", "cause", "method"}, {}};
  table.columns.insert(table.columns.end(), std::begin(values), std::end(values));
  table.columns.emplace_back("survives");
  for (const Json& point : points) {
    std::vector<std::string> row = {sceneOf(point), point["cause"].get<std::string>(), presetOf(point)};
    for (const char* value : values) row.push_back(point[value].dump());
    row.emplace_back(survives(point) ? "true" : "false");
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string stabilityBody(const PointList& points, const std::map<std::string, std::string>& pictures) {
  std::string body =
      paragraph(std::string(kIntroduction) + " A move has " + points.front()["frames"].dump() + " steps.");
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
    for (const Json& point : points)
      if (sceneOf(point) == scene) {
        std::string caption = presetOf(point);
        caption += ": ";
        caption += verdict(point);
        show(presetOf(point), caption);
      }
    body += "</div>\n";
  }
  body += heading("All figures") + toHtml(stabilityTable(points));
  return body;
}

std::string pictureName(const std::string& scene, const std::string& method) {
  std::string name = scene;
  name += ' ';
  name += method;
  return name;
}

}  // namespace halfsilver::bench
