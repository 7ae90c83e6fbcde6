#include "bench/coverage_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "apps/statistics.h"
#include "bench/fit.h"
#include "bench/page.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLinear = 0.98;         // R^2 from which on a curve counts as a line
constexpr double kJump = 3;              // median steps from which on a step counts as a jump
constexpr double kSmallShare = 0.04;     // of the screen: "3 %"
constexpr double kMostSmallCost = 0.25;  // of the whole screen's, that 3 % may cost
constexpr std::array kStages = {"voxelize", "build", "trace"};

double time(const Json& point, const char* stage, const char* which = "median") {
  return point["time_ms"][stage][which].get<double>();
}

double reflections(const Json& point) {
  double sum = 0;
  for (const char* stage : kStages) sum += time(point, stage);
  return sum;
}

double coverage(const Json& point) { return point["pixels"]["coverage"].get<double>(); }
double fraction(const Json& point) { return point["settings"]["select.fraction"].get<double>(); }

// What is fitted over coverage.
struct Quantity {
  const char* name;
  const char* unit;
  double (*of)(const Json&);
};
constexpr std::array<Quantity, 5> kQuantities{{
    {"trace", "ms", [](const Json& p) { return time(p, "trace"); }},
    {"voxelize + build + trace", "ms", reflections},
    {"frame", "ms", [](const Json& p) { return time(p, "frame"); }},
    {"structure", "MB", [](const Json& p) { return memory(p, "structure_total") / 1e6; }},
    {"pool used", "MB", [](const Json& p) { return memory(p, "pool_used") / 1e6; }},
}};
constexpr const Quantity& kTrace = kQuantities[0];
constexpr const Quantity& kReflections = kQuantities[1];
constexpr const Quantity& kFrame = kQuantities[2];
constexpr const Quantity& kStructure = kQuantities[3];
constexpr const Quantity& kPool = kQuantities[4];

std::vector<XY> samples(const CoverageCurve& curve, const Quantity& quantity) {
  std::vector<XY> result;
  for (const Json& point : curve.points) result.push_back({coverage(point), quantity.of(point)});
  return result;
}

struct Fit {
  std::vector<XY> points;
  std::optional<LinearFit> line;
  std::optional<Jump> jump;
  std::optional<double> smallShare;  // cost of the smallest share above none, by that of the largest
};

Fit fit(const CoverageCurve& curve, const Quantity& quantity) {
  Fit result{samples(curve, quantity), {}, {}, {}};
  result.line = fitLine(result.points);
  if (result.line) result.jump = largestJump(result.points, *result.line);
  const double whole = quantity.of(curve.points.back());
  for (const Json& point : curve.points)
    if (fraction(point) > 0 && fraction(point) <= kSmallShare && fraction(curve.points.back()) == 1 && whole > 0)
      result.smallShare = quantity.of(point) / whole;
  return result;
}

const CoverageCurve* sibling(const CoverageCurves& curves, const CoverageCurve& curve, std::string_view pattern) {
  const auto found = std::find_if(curves.begin(), curves.end(), [&](const CoverageCurve& c) {
    return c.scene == curve.scene && c.preset == curve.preset && c.pattern == pattern;
  });
  return found == curves.end() ? nullptr : &*found;
}

std::string rSquaredText(const Fit& fit) {
  if (!fit.line) return "";
  return fit.line->rSquared ? number(*fit.line->rSquared, 4) : "constant";
}

std::string between(const Fit& fit) {
  return percent(fit.points[fit.jump->first].x) + " and " + percent(fit.points[fit.jump->first + 1].x);
}

Table fitTable(const CoverageCurves& curves) {
  Table table{{"Scene", "Method", "Pattern", "What", "R²", "off the line", "at 0 %", "100 % adds", "", "3 % : 100 %",
               "Largest jump between", "median steps"},
              {}};
  for (const CoverageCurve& curve : curves)
    for (const Quantity& quantity : kQuantities) {
      const Fit f = fit(curve, quantity);
      table.rows.push_back({curve.scene, curve.preset, curve.pattern, quantity.name, rSquaredText(f),
                            f.line ? number(f.line->residual, 2) : "", f.line ? number(f.line->intercept, 2) : "",
                            f.line ? number(f.line->slope, 2) : "", quantity.unit,
                            f.smallShare ? percent(*f.smallShare) : "", f.jump ? between(f) : "",
                            f.jump ? number(f.jump->medianSteps, 1) : ""});
    }
  return table;
}

// What a jump of the growing region comes from, told by the same step of the scattered pixels.
std::string reading(const CoverageCurve& region, const Fit& f, const std::optional<Jump>& scattered) {
  double spread = 0;
  for (const std::size_t i : {f.jump->first, f.jump->first + 1})
    spread = std::max(spread, time(region.points[i], "trace", "max") - time(region.points[i], "trace", "min"));
  if (std::abs(f.jump->medianSteps) < kJump) return "no jump";
  if (std::abs(f.jump->excess) < spread) return "within the spread of the measurement";
  if (scattered && std::abs(scattered->medianSteps) >= kJump && scattered->excess * f.jump->excess > 0)
    return "in both patterns: the number of rays";
  return "in the region alone: what comes into it there";
}

Table jumpTable(const CoverageCurves& curves) {
  Table table{{"Scene", "Method", "Between", "ms off the line", "median steps", "the same step, scattered", "Reading"},
              {}};
  for (const CoverageCurve& curve : curves) {
    if (curve.pattern != "region") continue;
    const Fit f = fit(curve, kTrace);
    if (!f.jump) continue;
    std::optional<Jump> scattered;
    if (const CoverageCurve* other = sibling(curves, curve, "scattered")) {
      const Fit otherFit = fit(*other, kTrace);
      if (otherFit.line && f.jump->first + 1 < otherFit.points.size())
        scattered = jumpAt(otherFit.points, *otherFit.line, f.jump->first);
    }
    table.rows.push_back({curve.scene, curve.preset, between(f), number(f.jump->excess, 2),
                          number(f.jump->medianSteps, 1), scattered ? number(scattered->medianSteps, 1) : "",
                          reading(curve, f, scattered)});
  }
  return table;
}

// A line for each curve that `remark` has something to say of.
template <class Remark>
std::vector<std::string> remarks(const CoverageCurves& curves, const Quantity& quantity, Remark remark) {
  std::vector<std::string> lines;
  for (const CoverageCurve& curve : curves)
    if (const std::string text = remark(curve, fit(curve, quantity)); !text.empty())
      lines.push_back(curve.scene + ", " + curve.preset + ", " + curve.pattern + ": " + text);
  return lines;
}

// By how much the rounds of a point differ: the median of all points.
double spread(const CoverageCurve& curve) {
  std::vector<double> spreads;
  for (const Json& point : curve.points) spreads.push_back(time(point, "trace", "max") - time(point, "trace", "min"));
  return median(std::move(spreads));
}

std::string linearity(const CoverageCurves& curves) {
  const std::vector<std::string> bent = remarks(curves, kTrace, [](const CoverageCurve& curve, const Fit& f) {
    if (!f.line || !f.line->rSquared || *f.line->rSquared >= kLinear) return std::string();
    std::string text = "R² ";
    text += rSquaredText(f);
    text += ", points lie ";
    text += number(f.line->residual, 2) + " ms off the line, the rounds of a point differ by ";
    return text + number(spread(curve), 2) + " ms";
  });
  std::string text = "The time of the trace counts as a line where R² is at least ";
  text += number(kLinear, 2);
  if (bent.empty()) return paragraph(text + ": everywhere.");
  return paragraph(text +
                   ". These curves are none. Where points lie no further off than the rounds of a point differ, it is "
                   "the measurement that scatters; else the curve bends.") +
         bullets(bent);
}

std::string smallShares(const CoverageCurves& curves) {
  std::string html = paragraph(
      "Tracing only what reflects pays where 3 % of the screen cost at most a quarter of what all of it costs.");
  for (const Quantity* quantity : {&kReflections, &kStructure}) {
    const std::vector<std::string> dear = remarks(curves, *quantity, [](const CoverageCurve&, const Fit& f) {
      return f.smallShare && *f.smallShare > kMostSmallCost ? percent(*f.smallShare) : std::string();
    });
    const std::string name = quantity->name;
    html += dear.empty() ? paragraph(name + ": so everywhere.") : paragraph(name + ": more in") + bullets(dear);
  }
  return html;
}

Json oneOfRounds(std::span<const Json> rounds) {
  Json point = rounds.front();
  for (auto& [stage, times] : point["time_ms"].items()) {
    std::vector<double> all;
    for (const Json& round : rounds) all.push_back(time(round, stage.c_str()));
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    times = {{"median", median(all)}, {"min", *least}, {"max", *most}, {"runs", all.size()}};
  }
  return point;
}

Curve chartCurve(const std::string& name, const CoverageCurve& curve, const Quantity& quantity, const char* stage,
                 std::size_t color) {
  Curve result{name, {}, color};
  for (const Json& point : curve.points) {
    const double y = quantity.of(point);
    result.samples.push_back(
        {100 * coverage(point), y, stage ? time(point, stage, "min") : y, stage ? time(point, stage, "max") : y});
  }
  return result;
}

std::optional<Curve> fittedCurve(const CoverageCurve& curve, const Quantity& quantity, std::size_t color) {
  const Fit f = fit(curve, quantity);
  if (!f.line) return std::nullopt;
  Curve result{"", {}, color, false};
  for (const double x : {f.points.front().x, f.points.back().x})
    result.samples.push_back({100 * x, f.line->at(x), f.line->at(x), f.line->at(x)});
  return result;
}

constexpr const char* kIntroduction =
    "<p>This part shows what it saves to trace only where a surface reflects: the share of the screen that is traced "
    "goes from nothing to all, once as a <b>region</b>, a rectangle that grows from the centre, and once "
    "<b>scattered</b> evenly. All surfaces are traced, whether they reflect or not, and the structure is built anew in "
    "every frame, as for a scene that moves.</p>\n";

constexpr const char* kMethod =
    "<ul>\n"
    "<li>All points are measured in three rounds, each after a frame that is not counted. A point is the "
    "median of its rounds; bars reach from the fastest to the slowest.</li>\n"
    "<li>The shares are not measured one after the other but far apart (0, all, 1/2, 1/4, 3/4, ...), both patterns in "
    "turn: a machine that slowly warms up or gets other work scatters the points and does not look like a trend.</li>\n"
    "<li>The axis shows the share that was traced in the end. Pixels without a surface are never traced, so it may end "
    "below 100 %.</li>\n"
    "<li>Frame: the GPU's time for the whole picture, shadow maps left out, as they stay while lights and scene "
    "do.</li>\n"
    "<li>Structure: all GPU memory of the method; pool used: the part of it that holds lists of triangles or "
    "fragments.</li>\n"
    "</ul>\n";

constexpr const char* kFits =
    "A straight line through each curve by least squares: what it costs to trace nothing, and what the whole screen "
    "adds. "
    "R² is the share of the differences between the points that the line explains, off the line the root of the mean "
    "square of what it leaves. 3 % : 100 % is what 1/32 of the "
    "screen costs by what all of it costs. A jump is a step between neighbours beyond what the line foretells, in "
    "units "
    "of the median step of the curve.";

constexpr const char* kJumps =
    "The largest step of each growing region's trace off its line. A growing region takes in new parts of the picture, "
    "and rays are dearer where they pass much geometry; scattered pixels see all parts of the picture at every share. "
    "So "
    "a jump in the region alone comes from the pixels that entered it, while one from caches or memory that ran out "
    "would be in both. Steps below three median steps are not called jumps. The paper (M. F. Kastrati, P. Goswami, "
    "Selective rasterized ray-traced reflections on the GPU, 2017, figure 7) saw a jump between 34.4 % and 37.5 % on "
    "Sponza and left open which of the two it was.";

}  // namespace

CoverageCurves coverageCurves(const PointList& points) {
  CoverageCurves curves;
  for (const Json& point : points) {
    const CoverageCurve of{sceneOf(point), presetOf(point), point["settings"]["select.pattern"].get<std::string>(), {}};
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const CoverageCurve& c) {
      return c.scene == of.scene && c.preset == of.preset && c.pattern == of.pattern;
    });
    if (curve == curves.end()) curve = curves.insert(curves.end(), of);
    curve->points.push_back(point);
  }
  for (CoverageCurve& curve : curves) {
    std::stable_sort(curve.points.begin(), curve.points.end(),
                     [](const Json& a, const Json& b) { return fraction(a) < fraction(b); });
    PointList merged;
    for (auto first = curve.points.begin(); first != curve.points.end();) {
      const auto last =
          std::find_if(first, curve.points.end(), [&](const Json& p) { return fraction(p) != fraction(*first); });
      merged.push_back(oneOfRounds({first, last}));
      first = last;
    }
    curve.points = std::move(merged);
  }
  return curves;
}

Table coverageCsv(const CoverageCurves& curves) {
  Table table{{"scene", "preset", "pattern", "fraction", "coverage"}, {}};
  constexpr std::array stages = {"voxelize", "build", "trace", "frame"};
  constexpr std::array counts = {"structure_total", "pool_reserved", "pool_used", "voxels", "heads", "peak"};
  for (const char* stage : stages)
    for (const char* which : {"", "_min", "_max"}) table.columns.push_back(std::string(stage) + "_ms" + which);
  table.columns.insert(table.columns.end(), counts.begin(), counts.end());
  for (const char* name : {"overflow", "lost_fragments"}) table.columns.emplace_back(name);
  for (const CoverageCurve& curve : curves)
    for (const Json& point : curve.points) {
      std::vector<std::string> row = {curve.scene, curve.preset, curve.pattern, number(fraction(point), 5),
                                      number(coverage(point), 6)};
      for (const char* stage : stages)
        for (const char* which : {"median", "min", "max"}) row.push_back(number(time(point, stage, which), 4));
      for (const char* name : counts) row.push_back(point["memory"][name].dump());
      for (const char* name : {"overflow", "lost_fragments"}) row.push_back(point[name].dump());
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table fitsCsv(const CoverageCurves& curves) {
  Table table{{"scene", "preset", "pattern", "quantity", "unit", "slope", "intercept", "r_squared", "residual",
               "small_share_over_whole", "jump_from", "jump_to", "jump_excess", "jump_median_steps"},
              {}};
  for (const CoverageCurve& curve : curves)
    for (const Quantity& quantity : kQuantities) {
      const Fit f = fit(curve, quantity);
      std::vector<std::string> row = {curve.scene, curve.preset, curve.pattern, quantity.name, quantity.unit};
      const auto add = [&](bool known, auto value) { row.push_back(known ? number(value(), 6) : ""); };
      add(f.line.has_value(), [&] { return f.line->slope; });
      add(f.line.has_value(), [&] { return f.line->intercept; });
      add(f.line && f.line->rSquared, [&] { return *f.line->rSquared; });
      add(f.line.has_value(), [&] { return f.line->residual; });
      add(f.smallShare.has_value(), [&] { return *f.smallShare; });
      add(f.jump.has_value(), [&] { return f.points[f.jump->first].x; });
      add(f.jump.has_value(), [&] { return f.points[f.jump->first + 1].x; });
      add(f.jump.has_value(), [&] { return f.jump->excess; });
      add(f.jump.has_value(), [&] { return f.jump->medianSteps; });
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table coverageSummary(const CoverageCurves& curves) {
  Table table{{"scene", "method", "pattern", "R^2 of trace", "3 % : 100 % of time", "of memory"}, {}};
  for (const CoverageCurve& curve : curves) {
    const Fit trace = fit(curve, kTrace), all = fit(curve, kReflections), held = fit(curve, kStructure);
    table.rows.push_back({curve.scene, curve.preset, curve.pattern, rSquaredText(trace),
                          all.smallShare ? percent(*all.smallShare) : "",
                          held.smallShare ? percent(*held.smallShare) : ""});
  }
  return table;
}

PanelGrid coverageChart(const CoverageCurves& curves) {
  PanelGrid grid{3, {}};
  const std::string xAxis = "% of the screen traced";
  for (const CoverageCurve& region : curves) {
    if (region.pattern != "region") continue;
    const std::string title = region.scene + ", " + region.preset;
    Panel trace{title, xAxis, "trace, ms", {}}, total{title, xAxis, "frame, ms", {}},
        held{title, xAxis, "structure, MB", {}};
    std::size_t color = 0;
    for (const char* pattern : {"region", "scattered"}) {
      const CoverageCurve* curve = sibling(curves, region, pattern);
      if (!curve) continue;
      trace.curves.push_back(chartCurve(pattern, *curve, kTrace, "trace", color));
      if (const std::optional<Curve> line = fittedCurve(*curve, kTrace, color)) trace.curves.push_back(*line);
      total.curves.push_back(chartCurve(pattern, *curve, kFrame, "frame", color));
      held.curves.push_back(chartCurve(pattern, *curve, kStructure, nullptr, color));
      held.curves.push_back(chartCurve(std::string(pattern) + ", pool used", *curve, kPool, nullptr, color + 2));
      ++color;
    }
    for (Panel& panel : std::array{trace, total, held}) grid.panels.push_back(std::move(panel));
  }
  return grid;
}

std::string coverageBody(const CoverageCurves& curves, const std::vector<ScenePicture>& scenes,
                         const std::optional<std::string>& svg) {
  PointList whole;  // the points of the largest share
  for (const CoverageCurve& curve : curves) whole.push_back(curve.points.back());
  const auto caption = [](const Json& point) {
    return std::string(", a surface in ") + percent(coverage(point)) + " of the pixels";
  };
  return kIntroduction + gallery(scenes, whole, caption) + heading("Time and memory over coverage") +
         chartFigure(svg, "Dashed: the straight line that fits best.") + kMethod + heading("Straight lines") +
         linearity(curves) + smallShares(curves) + toHtml(fitTable(curves)) + paragraph(kFits) + heading("Jumps") +
         toHtml(jumpTable(curves)) + paragraph(kJumps);
}

}  // namespace halfsilver::bench
