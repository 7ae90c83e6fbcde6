#include <algorithm>

#include "bench/modes/scaling/report.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

Table figures(const ScalingSeries& series) {
  Table table{{"Axis", "Method", "Value", "Triangles", "Pixels traced", "Build, ms", "Trace, ms", "Frame, ms",
               "Structure, MB", "Fragments", ""},
              {}};
  for (const ScalingCurve& curve : series)
    for (const ScalingPoint& point : curve.points) {
      std::vector<std::string> row = {curve.axis, curve.preset, shortNumber(point.value), exactText(point.triangles)};
      if (!point.failed && point.frame) {
        row.push_back(std::to_string(point.frame->pixels.selected));
        for (const ScalingQuantity& quantity : kScalingQuantities) row.push_back(number(quantity.of(*point.frame), 2));
        row.push_back(std::to_string(point.frame->memory.fragmentsStored));
      }
      row.resize(table.columns.size());
      row.back() = fault(point).value_or("");
      table.rows.push_back(std::move(row));
    }
  return table;
}

constexpr const char* kIntroduction =
    "This part shows how time and memory grow with the size of a scene or a picture, one dimension at a time, while "
    "what the picture shows stays alike, and where and how each method stops working.";

constexpr const char* kMethod =
    "<ul>\n"
    "<li>All methods trace the same rays: those of the reflective pixels, on the axis coverage those of a share of "
    "all pixels. So does hu2014, which in its paper traces all.</li>\n"
    "<li>The structure is rebuilt in every frame, as for a moving scene. The papers' methods have the same voxels and "
    "256 x 256 texels at every size, fewer than in the papers, whose 1024 x 1024 would hide the growth behind the "
    "fixed "
    "cost; the default has voxels in proportion to the triangles.</li>\n"
    "<li>Build: voxelize and build. The default builds what rays ask for between the steps of its trace, so a part of "
    "its build grows with the rays.</li>\n"
    "<li>Frame: the GPU's time for the whole picture without shadow maps, which are kept while lights and scene stay "
    "the same.</li>\n"
    "<li>A point is the median of three frames after one or more that are not counted; a point that takes more than a "
    "second is one frame.</li>\n"
    "<li>A frame cannot be interrupted, so a point may take longer than the limit; larger ones of the same method and "
    "axis are then skipped.</li>\n"
    "</ul>\n";

constexpr const char* kExponents =
    "An exponent of 1 means that ten times as much takes ten times as long, 0 that it does not matter. It is the slope "
    "of a straight line by least squares through the logarithms of the largest points: as many as possible, so that "
    "none is off by more than a factor of 1.5. \"from\" says where they begin if not at the first point, since small "
    "points are dominated by the fixed cost of a frame. None: there are no three such points.";

}  // namespace

std::string scalingBody(const ScalingSeries& series, const std::vector<Figure>& pictures, double timeLimit,
                        const std::optional<std::string>& svg) {
  std::string body = paragraph(kIntroduction) + gallery(pictures);
  std::vector<std::string> axes;
  for (const ScalingAxis& axis : kScalingAxes)
    if (std::any_of(series.begin(), series.end(), [&](const ScalingCurve& c) { return c.axis == axis.name; }))
      axes.push_back(std::string(axis.name) + ": " + axis.help);
  body += heading("What grows") + bullets(axes) + kMethod;
  body += heading("Exponents") + toHtml(exponentsTable(series)) + paragraph(kExponents);
  body += chartFigure(svg, "Both axes are logarithmic, so a power law is a straight line. Dashed: the fitted laws.");
  body += heading("Where it ends") + toHtml(limitsTable(series, timeLimit)) +
          paragraph(
              "A point ends its axis if it fails with an error, loses fragments or rays for lack of room, warns that "
              "something was left out, or takes longer than " +
              secondsText(timeLimit) + " s.");
  body += heading("All laws") + toHtml(exponentsCsv(series)) +
          paragraph(
              "r_squared is the share of the variance of the logarithms that the line explains; from and to are the "
              "first and the last point that it was fitted through.");
  body += heading("All points") + toHtml(figures(series));
  return body;
}

}  // namespace halfsilver::bench
