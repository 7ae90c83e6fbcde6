#include "bench/scaling_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "bench/fit.h"
#include "bench/page.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Axis {
  const char* name;   // in points and tables
  const char* label;  // of charts and the page
  const char* what;   // is done along it
};
constexpr std::array<Axis, 6> kAxes{{
    {"finer", "triangles, finer and finer", "One surface is divided into finer and finer triangles."},
    {"more", "triangles, more and more objects",
     "Objects of 98 triangles are added at a fixed distance from each other, and the mirror below them grows: a "
     "larger "
     "world around the same place. Objects that are packed into a fixed space instead would get smaller, which is what "
     "finer triangles are."},
    {"pixels", "pixels", "The picture gets larger."},
    {"coverage", "% of the pixels traced", "More of the pixels are traced, scattered evenly, on all surfaces."},
    {"lights", "lights", "A sun, then point lights; all cast shadows."},
    {"bounces", "bounces", "Rays go on from mirror to mirror."},
}};

struct Quantity {
  const char* name;
  const char* unit;
  double (*of)(const Json&);
};

double time(const Json& point, const char* stage) { return point["time_ms"][stage]["median"].get<double>(); }

constexpr std::array<Quantity, 4> kQuantities{{
    {"build", "ms", [](const Json& p) { return time(p, "voxelize") + time(p, "build"); }},
    {"trace", "ms", [](const Json& p) { return time(p, "trace"); }},
    {"frame", "ms", [](const Json& p) { return time(p, "frame"); }},
    {"structure", "MB", [](const Json& p) { return memory(p, "structure_total") / 1e6; }},
}};

bool measured(const Json& point) { return !point.contains("failed"); }

// Where the curve runs: the triangles that the scene really has.
double valueOf(const Json& point) {
  const bool triangles = point["axis"] == "finer" || point["axis"] == "more";
  return (triangles && point.contains("triangles") ? point["triangles"] : point["value"]).get<double>();
}

std::string cell(const Json& point, const char* name) {
  return point.contains(name) ? point[name].dump() : std::string();
}

// "31.6k", "10M", "3.13"
std::string shortNumber(double value) {
  const bool mega = value >= 999500, kilo = !mega && value >= 1000;
  const double scaled = value / (mega ? 1e6 : kilo ? 1e3 : 1);
  std::string text = number(scaled, scaled >= 99.5 || scaled == std::floor(scaled) ? 0 : scaled >= 9.95 ? 1 : 2);
  return text += mega ? "M" : kilo ? "k" : "";
}

// What a law is fitted through: without points that do not count.
std::vector<XY> samples(const ScalingCurve& curve, const Quantity& quantity) {
  std::vector<XY> result;
  for (const Json& point : curve.points)
    if (!fault(point) && quantity.of(point) > 0) result.push_back({valueOf(point), quantity.of(point)});
  return result;
}

std::string lawText(const ScalingCurve& curve, const Quantity& quantity) {
  const std::vector<XY> points = samples(curve, quantity);
  const std::optional<PowerLaw> law = fitPowerLaw(points);
  if (!law) return "none";
  std::string text = number(law->exponent, 2);
  if (law->first > 0) text += " from " + shortNumber(points[law->first].x);
  return text;
}

std::string seconds(double limit) {
  std::ostringstream text;
  text << limit;
  return text.str();
}

std::string howItStops(const Json& point, double timeLimit) {
  if (const std::optional<std::string> why = fault(point)) return *why;
  return "took " + number(point["seconds"].get<double>(), 1) + " s, above the limit of " + seconds(timeLimit) +
         " s: larger ones were not tried";
}

Table figures(const ScalingSeries& series) {
  Table table{{"Axis", "Method", "Value", "Triangles", "Pixels traced", "Build, ms", "Trace, ms", "Frame, ms",
               "Structure, MB", "Fragments", ""},
              {}};
  for (const ScalingCurve& curve : series)
    for (const Json& point : curve.points) {
      std::vector<std::string> row = {curve.axis, curve.preset, shortNumber(point["value"].get<double>()),
                                      cell(point, "triangles")};
      if (measured(point)) {
        row.push_back(point["pixels"]["selected"].dump());
        for (const Quantity& quantity : kQuantities) row.push_back(number(quantity.of(point), 2));
        row.push_back(point["memory"]["fragments_stored"].dump());
      }
      row.resize(table.columns.size());
      row.back() = fault(point).value_or("");
      table.rows.push_back(std::move(row));
    }
  return table;
}

constexpr const char* kIntroduction =
    "This part shows how time and memory grow with what a scene or a picture has more of, one thing at a time, while "
    "what the picture shows stays alike, and where each method stops working, and how.";

constexpr const char* kMethod =
    "<ul>\n"
    "<li>All methods trace the same rays: those of the reflective pixels, on the axis coverage those of a share of "
    "all pixels. So does hu2014, which in its paper traces all.</li>\n"
    "<li>The structure is built anew in every frame, as for a scene that moves. The papers' methods have the "
    "same voxels and 256 x 256 texels at every size, fewer than in the papers, whose 1024 x 1024 would hide what grows "
    "behind what they take anyway; the default has voxels in proportion to the triangles.</li>\n"
    "<li>Build: voxelize and build. The default builds between the steps of its trace what rays ask for, so a part of "
    "its build grows with the rays.</li>\n"
    "<li>Frame: the GPU's time for the whole picture, shadow maps left out, as they stay while lights and scene "
    "do.</li>\n"
    "<li>A point is the median of three frames after one or more that are not counted; one that takes more than a "
    "second is one frame.</li>\n"
    "<li>A frame cannot be stopped halfway, so a point may take longer than the limit; larger ones of the same method "
    "and axis are then not tried.</li>\n"
    "</ul>\n";

constexpr const char* kExponents =
    "An exponent of 1 means: ten times as much of it takes ten times as long; 0: it does not matter. It is the slope "
    "of "
    "a straight line by least squares through the logarithms, through the longest run of points up to the largest in "
    "which none is off by more than a half; \"from\" says where that run begins, if not at the first point, as "
    "small "
    "ones are ruled by what every frame takes. None: there are no such three points.";

}  // namespace

ScalingSeries scalingSeries(const PointList& points) {
  ScalingSeries series;
  for (const Json& point : points) {
    const std::string axis = point["axis"].get<std::string>(), preset = presetOf(point);
    auto curve = std::find_if(series.begin(), series.end(),
                              [&](const ScalingCurve& c) { return c.axis == axis && c.preset == preset; });
    if (curve == series.end()) curve = series.insert(series.end(), {axis, preset, {}});
    curve->points.push_back(point);
  }
  for (ScalingCurve& curve : series)
    std::stable_sort(curve.points.begin(), curve.points.end(),
                     [](const Json& a, const Json& b) { return a["value"] < b["value"]; });
  return series;
}

std::optional<std::string> fault(const Json& point) {
  if (!measured(point)) return point["failed"].get<std::string>();
  if (point["lost_fragments"] != 0)
    return point["lost_fragments"].dump() + " fragments found no room, " + point["overflow"].dump() +
           " rays met such a place";
  if (point["overflow"] != 0) return point["overflow"].dump() + " rays overflowed";
  std::string warnings;
  for (const Json& warning : point["warnings"]) warnings += (warnings.empty() ? "" : "; ") + warning.get<std::string>();
  if (warnings.empty()) return std::nullopt;
  return warnings;
}

bool stops(const Json& point, double timeLimit) { return fault(point) || point["seconds"].get<double>() > timeLimit; }

Table scalingCsv(const ScalingSeries& series) {
  constexpr std::array stages = {"gbuffer", "select", "voxelize", "build", "trace", "shade", "frame"};
  constexpr std::array counts = {"structure_total",  "pool_reserved", "fragments",
                                 "fragments_stored", "gbuffer",       "peak"};
  Table table{{"axis", "preset", "value", "triangles", "lights", "width", "height", "bounces", "selected"}, {}};
  for (const char* stage : stages) table.columns.push_back(std::string(stage) + "_ms");
  table.columns.insert(table.columns.end(), counts.begin(), counts.end());
  for (const char* name : {"lost_fragments", "overflow", "seconds", "fault"}) table.columns.emplace_back(name);
  for (const ScalingCurve& curve : series)
    for (const Json& point : curve.points) {
      std::vector<std::string> row = {curve.axis,
                                      curve.preset,
                                      point["value"].dump(),
                                      cell(point, "triangles"),
                                      point["scene"]["lights"].dump(),
                                      point["size"][0].dump(),
                                      point["size"][1].dump(),
                                      point["settings"]["trace.bounces"].dump(),
                                      measured(point) ? point["pixels"]["selected"].dump() : ""};
      for (const char* stage : stages) row.push_back(measured(point) ? number(time(point, stage), 4) : "");
      for (const char* name : counts) row.push_back(measured(point) ? point["memory"][name].dump() : "");
      for (const char* name : {"lost_fragments", "overflow", "seconds"}) row.push_back(cell(point, name));
      row.push_back(fault(point).value_or(""));
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table exponentsCsv(const ScalingSeries& series) {
  Table table{{"axis", "preset", "quantity", "exponent", "r_squared", "from", "to", "points"}, {}};
  for (const ScalingCurve& curve : series)
    for (const Quantity& quantity : kQuantities) {
      const std::vector<XY> points = samples(curve, quantity);
      const std::optional<PowerLaw> law = fitPowerLaw(points);
      std::vector<std::string> row = {curve.axis, curve.preset, quantity.name};
      if (law)
        row.insert(row.end(), {number(law->exponent, 4), law->rSquared ? number(*law->rSquared, 4) : "",
                               number(points[law->first].x, 3), number(points.back().x, 3),
                               std::to_string(points.size() - law->first)});
      row.resize(table.columns.size());
      table.rows.push_back(std::move(row));
    }
  return table;
}

Table exponentsTable(const ScalingSeries& series) {
  Table table{{"axis", "method"}, {}};
  for (const Quantity& quantity : kQuantities) table.columns.emplace_back(quantity.name);
  for (const ScalingCurve& curve : series) {
    std::vector<std::string> row = {curve.axis, curve.preset};
    for (const Quantity& quantity : kQuantities) row.push_back(lawText(curve, quantity));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table limitsTable(const ScalingSeries& series, double timeLimit) {
  Table table{{"axis", "method", "works up to", "ends at", "how"}, {}};
  for (const ScalingCurve& curve : series) {
    std::vector<std::string> row = {curve.axis, curve.preset, "", "", "no end was found"};
    for (const Json& point : curve.points) {
      const std::string value = shortNumber(point["value"].get<double>());
      if (!fault(point)) row[2] = value;
      if (!stops(point, timeLimit)) continue;
      row[3] = value;
      row[4] = howItStops(point, timeLimit);
      break;
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

PanelGrid scalingChart(const ScalingSeries& series) {
  PanelGrid grid{3, {}};
  for (const Axis& axis : kAxes)
    for (const Quantity& quantity : {kQuantities[0], kQuantities[1], kQuantities[3]}) {
      Panel panel{std::string(quantity.name) + " by " + axis.name,
                  axis.label,
                  std::string(quantity.name) + ", " + quantity.unit,
                  {},
                  true,
                  {}};
      std::size_t color = 0;
      for (const ScalingCurve& curve : series) {
        if (curve.axis != axis.name) continue;
        const std::vector<XY> points = samples(curve, quantity);
        Curve marks{curve.preset, {}, color, true};
        for (const XY& point : points) marks.samples.push_back({point.x, point.y, point.y, point.y});
        panel.curves.push_back(std::move(marks));
        if (const std::optional<PowerLaw> law = fitPowerLaw(points)) {
          Curve line{"", {}, color, false};
          for (const double x : {points[law->first].x, points.back().x})
            line.samples.push_back({x, law->at(x), law->at(x), law->at(x)});
          panel.curves.push_back(std::move(line));
        }
        for (const Json& point : curve.points) {
          const double value = point["value"].get<double>();
          const auto same = [&](const Tick& tick) { return tick.at == value; };
          if (std::none_of(panel.ticks.begin(), panel.ticks.end(), same))
            panel.ticks.push_back({value, shortNumber(value)});
        }
        ++color;
      }
      if (!panel.curves.empty()) grid.panels.push_back(std::move(panel));
    }
  return grid;
}

std::string scalingBody(const ScalingSeries& series, const std::vector<ScenePicture>& pictures, double timeLimit,
                        const std::optional<std::string>& svg) {
  std::string body = paragraph(kIntroduction) + "<div class=\"scenes\">\n";
  for (const ScenePicture& picture : pictures)
    if (!picture.png.empty()) body += thumbnail(picture.png, picture.name);
  body += "</div>\n";
  std::vector<std::string> axes;
  for (const Axis& axis : kAxes)
    if (std::any_of(series.begin(), series.end(), [&](const ScalingCurve& c) { return c.axis == axis.name; }))
      axes.push_back(std::string(axis.name) + ": " + axis.what);
  body += heading("What grows") + bullets(axes) + kMethod;
  body += heading("Exponents") + toHtml(exponentsTable(series)) + paragraph(kExponents);
  body += chartFigure(svg, "Both axes are logarithmic, so a power law is a straight line. Dashed: the fitted laws.");
  body += heading("Where it ends") + toHtml(limitsTable(series, timeLimit)) +
          paragraph(
              "A point stops its axis where it ends with an error, loses fragments or rays for lack of room, "
              "warns of something left out, or takes longer than " +
              seconds(timeLimit) + " s.");
  body += heading("All laws") + toHtml(exponentsCsv(series)) +
          paragraph(
              "r_squared is the share of the differences between the logarithms that the line explains; from and "
              "to tell the points that it was fitted through.");
  body += heading("All points") + toHtml(figures(series));
  return body;
}

}  // namespace halfsilver::bench
