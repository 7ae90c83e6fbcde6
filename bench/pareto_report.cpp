#include "bench/pareto_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/pareto.h"
#include "apps/statistics.h"
#include "bench/gnuplot.h"
#include "bench/page.h"
#include "bench/request.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNoise = 0.05;  // share of a frame's time; what is closer is not told apart

constexpr std::array kAccuracies = {Accuracy::hits, Accuracy::picture};

Spread spreadOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {median(values), *least, *most};
}

std::size_t sharedRounds(const ParetoPoint& a, const ParetoPoint& b) {
  return std::min(a.frames.size(), b.frames.size());
}

std::optional<double> errorOf(const ParetoPoint& point, Accuracy accuracy) {
  if (accuracy == Accuracy::picture) return point.perceptible ? point.perceptible : point.rmse;
  // Who traces less is wrong about fewer rays: no accuracy to be proud of.
  return point.rays < 1 ? std::nullopt : point.hitError;
}

bool competes(const ParetoPoint& point, Accuracy accuracy) { return point.beside.empty() && errorOf(point, accuracy); }

bool beats(const ParetoPoint& a, const ParetoPoint& b, Accuracy accuracy) {
  if (sharedRounds(a, b) == 0 || *errorOf(a, accuracy) > *errorOf(b, accuracy)) return false;
  const Spread ratio = pairedRatio(a, b);
  return ratio.most < 1 && ratio.median <= 1 - kNoise;
}

std::optional<std::size_t> defaultOf(const ParetoScene& scene) {
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    if (scene.points[i].name == kDefaultPreset) return i;
  return std::nullopt;
}

ParetoPoint fromJson(const Json& point) {
  ParetoPoint result{presetOf(point), point["family"], point["knob"], point["beside"], {}, 0, 0, {}, {}, 0, point};
  const Json& error = point["error"];
  const auto optional = [&](const char* name) {
    return error[name].is_null() ? std::nullopt : std::optional(error[name].get<double>());
  };
  result.bytes = memory(point, "structure_total");
  result.rays = error["rays_of_reference"].get<double>();
  result.hitError = optional("hit_error");
  result.perceptible = optional("yee_fail_fraction");
  result.rmse = error["rmse"].get<double>();
  return result;
}

bool perceptionKnown(std::span<const ParetoScene> scenes) {
  return scenes.front().points.front().perceptible.has_value();
}

const char* accuracyName(Accuracy accuracy, std::span<const ParetoScene> scenes) {
  if (accuracy == Accuracy::hits) return "wrong hits";
  return perceptionKnown(scenes) ? "perceptible pixels" : "difference of the pictures (RMSE)";
}

bool contains(const std::vector<std::size_t>& list, std::size_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

// "1.25 (1.19 to 1.31)"
std::string spreadText(const Spread& spread, int digits) {
  std::string text = number(spread.median, digits);
  text += " (";
  text += number(spread.least, digits);
  text += " to ";
  text += number(spread.most, digits);
  return text + ')';
}

std::string optionalPercent(const std::optional<double>& share) { return share ? percent(*share, 3) : ""; }

// "on the front", "within the noise", or who beats it.
std::string standing(const ParetoScene& scene, std::size_t at, Accuracy accuracy) {
  const ParetoPoint& point = scene.points[at];
  if (!point.beside.empty()) return "beside: " + point.beside;
  if (!competes(point, accuracy)) return "traces fewer rays";
  if (contains(frontOf(scene, accuracy), at)) return "on the front";
  if (const auto other = beatenBy(scene, at, accuracy)) return "behind " + scene.points[*other].name;
  return "within the noise";
}

std::string verdict(const ParetoScene& scene, Accuracy accuracy) {
  std::string text = scene.name;
  text += ", time against ";
  text += accuracyName(accuracy, {&scene, 1});
  text += ": ";
  const std::optional<std::size_t> at = defaultOf(scene);
  if (!at) return text + "the default was not measured.";
  if (!competes(scene.points[*at], accuracy)) return text + "nothing reflects here.";
  const ParetoPoint& own = scene.points[*at];
  if (const auto other = beatenBy(scene, *at, accuracy)) {
    const ParetoPoint& better = scene.points[*other];
    text += "the default is not on the front. ";
    text += better.name;
    text += " takes ";
    text += spreadText(pairedRatio(better, own), 2);
    text += " times as long and is ";
    text += *errorOf(better, accuracy) < *errorOf(own, accuracy) ? "more accurate." : "as accurate.";
    return text;
  }
  text += "the default is on the front of the GPU methods";
  if (!contains(frontOf(scene, accuracy), *at)) text += ", within the noise";
  return text + ": nothing that is as accurate was faster in every round and by " + percent(kNoise, 0) + " or more.";
}

Table variantTable(const ParetoScene& scene) {
  Table table{{"Variant", "Frame, ms", "Times the default, same round", "Rounds", "Structure, MB", "Rays traced",
               "Wrong hits", "Perceptible pixels", "RMSE", "By hits", "By picture"},
              {}};
  const std::optional<std::size_t> own = defaultOf(scene);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const ParetoPoint& point = scene.points[i];
    table.rows.push_back({point.name, spreadText(frameTime(point), 1),
                          own ? spreadText(pairedRatio(point, scene.points[*own]), 2) : "",
                          std::to_string(point.frames.size()), megabytes(point.bytes), percent(point.rays),
                          optionalPercent(point.hitError), optionalPercent(point.perceptible), number(point.rmse, 5),
                          standing(scene, i, Accuracy::hits), standing(scene, i, Accuracy::picture)});
  }
  return table;
}

// What a bounce more costs and brings, against the reference with the most.
Table bounceTable(std::span<const ParetoScene> scenes) {
  Table table{{"Scene", "Bounces", "Frame, ms", "Times one bounce", "Perceptible pixels", "RMSE"}, {}};
  for (const ParetoScene& scene : scenes) {
    const std::optional<std::size_t> own = defaultOf(scene);
    for (const ParetoPoint& point : scene.points) {
      if (!own || !point.measured.contains("error_of_bounces")) continue;
      const Json& error = point.measured["error_of_bounces"];
      const Json& perceptible = error["yee_fail_fraction"];
      table.rows.push_back({scene.name, point.measured["settings"]["trace.bounces"].dump(),
                            spreadText(frameTime(point), 1), spreadText(pairedRatio(point, scene.points[*own]), 2),
                            perceptible.is_null() ? "" : percent(perceptible.get<double>(), 3),
                            number(error["rmse"].get<double>(), 5)});
    }
  }
  return table;
}

ScatterPanel panel(const ParetoScene& scene, Accuracy accuracy, const std::vector<std::string>& families) {
  const bool shares = accuracy == Accuracy::hits || perceptionKnown({&scene, 1});
  ScatterPanel panel{scene.name, "frame, ms", accuracyName(accuracy, {&scene, 1}), {}, {}};
  if (shares) panel.yAxis += ", %";
  const double unit = shares ? 100 : 1;
  const std::vector<std::size_t> front = frontOf(scene, accuracy);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const ParetoPoint& point = scene.points[i];
    const std::optional<double> error = errorOf(point, accuracy);
    if (!error) continue;
    const bool own = point.name == kDefaultPreset;
    Mark mark{frameTime(point).median, unit * *error, markRadius(point.bytes), 0, !point.beside.empty(), own, ""};
    mark.color = static_cast<std::size_t>(std::find(families.begin(), families.end(), point.family) - families.begin());
    if (own)
      mark.label = "default";
    else if (contains(front, i) || mark.hollow || point.rays < 1)
      mark.label = point.knob.empty() ? point.family : point.knob;
    panel.marks.push_back(std::move(mark));
  }
  for (const std::size_t i : front)
    panel.front.push_back({frameTime(scene.points[i]).median, unit * *errorOf(scene.points[i], accuracy), 0, 0});
  return panel;
}

std::vector<std::string> familiesOf(std::span<const ParetoScene> scenes) {
  std::vector<std::string> families;
  for (const ParetoScene& scene : scenes)
    for (const ParetoPoint& point : scene.points)
      if (std::find(families.begin(), families.end(), point.family) == families.end()) families.push_back(point.family);
  return families;
}

constexpr const char* kIntroduction =
    "<p>What a frame takes is set here against how right it is: every method and preset over its knobs, and the "
    "default among them. No filled "
    "mark is both further left and further down than the <em>front</em>: who sits on it is beaten by no other in time "
    "and accuracy at once.</p>\n";

constexpr const char* kCaption =
    "Both axes are logarithmic; a row below the axis, set off by the dotted line, holds the marks whose error is "
    "exactly "
    "0. The radius of a mark grows by the same for each tenfold memory of the structure. Filled marks compete, hollow "
    "ones "
    "stand beside the comparison. The line is the front of the medians. Named are the default, the front, what "
    "stands beside and what traces fewer rays, where there is room; all names are in the tables.";

std::string methodNotes() {
  std::string rounds =
      "A round draws every variant of a scene once, in turn, each after a frame that is not counted: a slow moment of "
      "the machine does not fall on one of them alone. Times are medians of the rounds, from the fastest to the "
      "slowest; multiples of the default are taken within each round. There are up to five rounds (two in a quick "
      "run), as many as fit ";
  rounds += number(kParetoSeconds, 0);
  rounds += " s of measured frames of a variant, but never fewer than two.";
  std::string behind = "A variant is behind another where that has no more error and was faster in every round and by ";
  behind += percent(kNoise, 0);
  behind += " or more; \"within the noise\" means that only the medians put it behind.";
  return bullets(
      {"Frame: the GPU's time for the whole picture, shadow maps left out, as they stay while lights and scene do. All "
       "structures are built anew in every frame, as where the scene moves; \"kept\" shows a frame of the default "
       "where nothing moved.",
       rounds,
       "Wrong hits: of the rays that the variant and the reference both traced, the share that hits where the "
       "reference "
       "misses, misses where it hits, or hits further than 0.1 % of the scene's diagonal from it. A pixel that was not "
       "traced has no wrong hit, it is a matter of the picture: variants that trace fewer rays than the reference are "
       "not in the charts and on the front of the hits. Who traces more (hu2014: all pixels) is judged by the "
       "reference's rays alone. Hits are those of the first bounce.",
       "Pictures are compared with the reference's, every reflective pixel traced. Perceptible pixels: the share that "
       "fails the comparison of Yee et al. 2001 on linear radiance; RMSE: root mean square difference of the display "
       "values, 0 to 1.",
       "More bounces are another picture: such variants are compared with the reference of as many bounces and stand "
       "beside the others. What the bounces bring is told further down.",
       behind});
}

}  // namespace

std::vector<ParetoScene> paretoScenes(const PointList& points) {
  std::vector<ParetoScene> scenes;
  for (const Json& json : points) {
    auto scene = std::find_if(scenes.begin(), scenes.end(),
                              [&](const ParetoScene& candidate) { return candidate.name == sceneOf(json); });
    if (scene == scenes.end()) scene = scenes.insert(scene, {sceneOf(json), {}});
    auto point = std::find_if(scene->points.begin(), scene->points.end(),
                              [&](const ParetoPoint& candidate) { return candidate.name == presetOf(json); });
    if (point == scene->points.end()) point = scene->points.insert(point, fromJson(json));
    point->frames.push_back(json["time_ms"]["frame"]["median"].get<double>());
  }
  return scenes;
}

Spread frameTime(const ParetoPoint& point) { return spreadOf(point.frames); }

Spread pairedRatio(const ParetoPoint& point, const ParetoPoint& other) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < sharedRounds(point, other); ++i) ratios.push_back(point.frames[i] / other.frames[i]);
  return spreadOf(ratios);
}

std::vector<std::size_t> frontOf(const ParetoScene& scene, Accuracy accuracy) {
  std::vector<std::size_t> competitors;
  std::vector<Cost> costs;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (!competes(scene.points[i], accuracy)) continue;
    competitors.push_back(i);
    costs.push_back({frameTime(scene.points[i]).median, 0, *errorOf(scene.points[i], accuracy)});
  }
  std::vector<std::size_t> front;
  for (const std::size_t i : paretoFront(costs)) front.push_back(competitors[i]);
  return front;
}

std::optional<std::size_t> beatenBy(const ParetoScene& scene, std::size_t point, Accuracy accuracy) {
  std::optional<std::size_t> best;
  if (!competes(scene.points[point], accuracy)) return best;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const ParetoPoint& other = scene.points[i];
    if (!competes(other, accuracy) || !beats(other, scene.points[point], accuracy)) continue;
    if (!best || frameTime(other).median < frameTime(scene.points[*best]).median) best = i;
  }
  return best;
}

double markRadius(double bytes) { return 0.6 + 0.5 * std::log10(std::max(1.0, bytes / 1e6)); }

std::vector<std::string> paretoVerdicts(const ParetoScene& scene) {
  std::vector<std::string> texts;
  for (const Accuracy accuracy : kAccuracies) texts.push_back(verdict(scene, accuracy));
  return texts;
}

Table paretoCsv(std::span<const ParetoScene> scenes) {
  Table table{{"scene",
               "variant",
               "family",
               "knob",
               "beside",
               "rounds",
               "frame_ms",
               "frame_ms_min",
               "frame_ms_max",
               "over_default",
               "over_default_min",
               "over_default_max",
               "structure_total",
               "peak",
               "rays",
               "rays_of_reference",
               "hit_error",
               "false_miss",
               "false_hit",
               "yee_fail_fraction",
               "rmse",
               "on_front_of_hits",
               "on_front_of_pictures",
               "overflow",
               "lost_fragments"},
              {}};
  for (const ParetoScene& scene : scenes) {
    const std::optional<std::size_t> own = defaultOf(scene);
    std::array<std::vector<std::size_t>, kAccuracies.size()> fronts;
    for (std::size_t i = 0; i < kAccuracies.size(); ++i) fronts[i] = frontOf(scene, kAccuracies[i]);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      const ParetoPoint& point = scene.points[i];
      std::vector<std::string> row = {scene.name, point.name,   point.family,
                                      point.knob, point.beside, std::to_string(point.frames.size())};
      const auto addSpread = [&](const Spread& spread) {
        for (const double value : {spread.median, spread.least, spread.most}) row.push_back(number(value, 4));
      };
      addSpread(frameTime(point));
      addSpread(own ? pairedRatio(point, scene.points[*own]) : Spread());
      for (const char* name : {"structure_total", "peak"}) row.push_back(point.measured["memory"][name].dump());
      for (const char* name :
           {"rays", "rays_of_reference", "hit_error", "false_miss", "false_hit", "yee_fail_fraction", "rmse"}) {
        const Json& value = point.measured["error"][name];
        row.push_back(value.is_null() ? "" : value.dump());
      }
      for (const auto& front : fronts) row.emplace_back(contains(front, i) ? "true" : "false");
      for (const char* name : {"overflow", "lost_fragments"}) row.push_back(point.measured[name].dump());
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table paretoSummary(std::span<const ParetoScene> scenes) {
  Table table{{"scene", "variant", "frame ms", "times default", "structure MB", "wrong hits", "perceptible", "RMSE",
               "by hits", "by picture"},
              {}};
  for (const ParetoScene& scene : scenes) {
    const std::optional<std::size_t> own = defaultOf(scene);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      const ParetoPoint& point = scene.points[i];
      table.rows.push_back({scene.name, point.name, number(frameTime(point).median, 1),
                            own ? number(pairedRatio(point, scene.points[*own]).median, 2) : "", megabytes(point.bytes),
                            optionalPercent(point.hitError), optionalPercent(point.perceptible), number(point.rmse, 5),
                            standing(scene, i, Accuracy::hits), standing(scene, i, Accuracy::picture)});
    }
  }
  return table;
}

ScatterGrid paretoChart(std::span<const ParetoScene> scenes) {
  const std::vector<std::string> families = familiesOf(scenes);
  ScatterGrid grid{kAccuracies.size(), {{}, {}}, {}};
  for (std::size_t i = 0; i < families.size(); ++i) grid.legend[0].push_back({0, 0, 1, i, false, false, families[i]});
  constexpr std::size_t grey = kNoFamily;
  for (const double size : {1e6, 1e7, 1e8, 1e9})
    grid.legend[1].push_back({0, 0, markRadius(size), grey, false, false, number(size / 1e6, 0) + " MB"});
  grid.legend[1].push_back({0, 0, 1, grey, true, false, "beside the comparison"});
  grid.legend[1].push_back({0, 0, 1, 0, false, true, "the default"});
  for (const ParetoScene& scene : scenes)
    for (const Accuracy accuracy : kAccuracies) grid.panels.push_back(panel(scene, accuracy, families));
  return grid;
}

std::string paretoBody(std::span<const ParetoScene> scenes, const std::vector<ScenePicture>& pictures,
                       const std::optional<std::string>& svg) {
  PointList firsts;
  std::vector<std::string> verdicts;
  for (const ParetoScene& scene : scenes) {
    firsts.push_back(scene.points.front().measured);
    for (std::string& text : paretoVerdicts(scene)) verdicts.push_back(std::move(text));
  }
  const auto coverage = [](const Json& point) {
    std::string text = ", ";
    text += percent(point["pixels"]["coverage"].get<double>());
    return text + " of the pixels reflect";
  };
  std::string body = kIntroduction + gallery(pictures, firsts, coverage);
  body += heading("Where the default stands") + bullets(verdicts);
  body += heading("Time against accuracy") + chartFigure(svg, kCaption) + methodNotes();
  for (const ParetoScene& scene : scenes) body += heading(scene.name) + toHtml(variantTable(scene));
  body += heading("What more bounces bring") +
          paragraph("Against the reference with four bounces: what is still missing in the picture.") +
          toHtml(bounceTable(scenes));
  return body;
}

}  // namespace halfsilver::bench
