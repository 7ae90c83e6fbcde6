#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "bench/modes/coverage/report.h"
#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

constexpr double kLinear = 0.98;        // R^2 from which on a curve counts as a line
constexpr double kJump = 3;             // median steps from which on a step counts as a jump
constexpr double kMaxSmallCost = 0.25;  // of the whole screen's cost, for 3 % of the screen

std::string between(const CoverageFit& fit) {
  return percent(fit.points[fit.jump->first].x) + " and " + percent(fit.points[fit.jump->first + 1].x);
}

Table fitTable(const CoverageCurves& curves) {
  Table table{{"Scene", "Method", "Pattern", "What", "R²", "off the line", "at 0 %", "100 % adds", "", "3 % : 100 %",
               "Largest jump between", "median steps"},
              {}};
  for (const CoverageCurve& curve : curves)
    for (const CoverageQuantity& quantity : kCoverageQuantities) {
      const CoverageFit f = fitCurve(curve, quantity);
      table.rows.push_back({curve.scene, curve.preset, curve.pattern, quantity.name, rSquaredText(f),
                            f.line ? number(f.line->residual, 2) : "", f.line ? number(f.line->intercept, 2) : "",
                            f.line ? number(f.line->slope, 2) : "", quantity.unit, smallShareText(f),
                            f.jump ? between(f) : "", f.jump ? number(f.jump->medianSteps, 1) : ""});
    }
  return table;
}

// What a jump of the growing region comes from, judged by the same step of the scattered pixels.
std::string reading(const CoverageCurve& region, const CoverageFit& f, const std::optional<Jump>& scattered) {
  double spread = 0;
  for (const std::size_t i : {f.jump->first, f.jump->first + 1})
    spread = std::max(spread, spreadOf(region.points[i].times.trace));
  if (std::abs(f.jump->medianSteps) < kJump) return "no jump";
  if (std::abs(f.jump->excess) < spread) return "within the spread of the measurement";
  if (scattered && std::abs(scattered->medianSteps) >= kJump && scattered->excess * f.jump->excess > 0)
    return "in both patterns: the number of rays";
  return "in the region alone: the pixels that enter it there";
}

Table jumpTable(const CoverageCurves& curves) {
  Table table{{"Scene", "Method", "Between", "ms off the line", "median steps", "the same step, scattered", "Reading"},
              {}};
  for (const CoverageCurve& curve : curves) {
    if (curve.pattern != kRegion) continue;
    const CoverageFit f = fitCurve(curve, kTrace);
    if (!f.jump) continue;
    std::optional<Jump> scattered;
    if (const CoverageCurve* other = sibling(curves, curve, kScattered)) {
      const CoverageFit otherFit = fitCurve(*other, kTrace);
      if (otherFit.line && f.jump->first + 1 < otherFit.points.size())
        scattered = jumpAt(otherFit.points, *otherFit.line, f.jump->first);
    }
    table.rows.push_back({curve.scene, curve.preset, between(f), number(f.jump->excess, 2),
                          number(f.jump->medianSteps, 1), scattered ? number(scattered->medianSteps, 1) : "",
                          reading(curve, f, scattered)});
  }
  return table;
}

// A line for each curve that `remark` has something to say about.
template <class Remark>
std::vector<std::string> remarks(const CoverageCurves& curves, const CoverageQuantity& quantity, Remark remark) {
  std::vector<std::string> lines;
  for (const CoverageCurve& curve : curves)
    if (const std::string text = remark(curve, fitCurve(curve, quantity)); !text.empty())
      lines.push_back(curve.scene + ", " + curve.preset + ", " + curve.pattern + ": " + text);
  return lines;
}

std::string linearity(const CoverageCurves& curves) {
  const std::vector<std::string> bent = remarks(curves, kTrace, [](const CoverageCurve& curve, const CoverageFit& f) {
    if (!f.line || !f.line->rSquared || *f.line->rSquared >= kLinear) return std::string();
    std::string text = "R² ";
    text += rSquaredText(f);
    text += ", points lie ";
    text += number(f.line->residual, 2) + " ms off the line, the rounds of a point differ by ";
    return text + number(medianSpread(curve), 2) + " ms";
  });
  std::string text = "The time of the trace counts as linear if R² is at least ";
  text += number(kLinear, 2);
  if (bent.empty()) return paragraph(text + ": all curves are.");
  return paragraph(text +
                   ". These curves are not. If points lie no further off the line than the rounds of a point differ, "
                   "the measurement is noisy; otherwise the curve bends.") +
         bullets(bent);
}

std::string smallShares(const CoverageCurves& curves) {
  std::string html = paragraph(
      "Tracing only what reflects pays off if 3 % of the screen costs at most a quarter of what the whole screen "
      "costs.");
  for (const CoverageQuantity* quantity : {&kReflections, &kStructure}) {
    const std::vector<std::string> dear = remarks(curves, *quantity, [](const CoverageCurve&, const CoverageFit& f) {
      return f.smallShare && *f.smallShare > kMaxSmallCost ? percent(*f.smallShare) : std::string();
    });
    const std::string name = quantity->name;
    html += dear.empty() ? paragraph(name + ": it does for all curves.")
                         : paragraph(name + ": it costs more for") + bullets(dear);
  }
  return html;
}

constexpr const char* kIntroduction =
    "<p>This part shows what it saves to trace only where a surface reflects. The share of the screen that is traced "
    "grows from none to all of it, once as a <b>region</b>, a rectangle that grows from the center, and once "
    "<b>scattered</b> evenly. All surfaces are traced, whether they reflect or not, and the structure is rebuilt in "
    "every frame, as for a moving scene.</p>\n";

constexpr const char* kMethod =
    "<ul>\n"
    "<li>All points are measured in three rounds, each after a frame that is not counted. A point is the "
    "median of its rounds; bars extend from the fastest to the slowest.</li>\n"
    "<li>Shares that are measured in succession are far apart (0, all, 1/2, 1/4, 3/4, ...), and the patterns "
    "alternate: a machine that slowly warms up or gets other work scatters the points and does not look like a "
    "trend.</li>\n"
    "<li>The axis shows the share that was actually traced. Pixels without a surface are never traced, so it may end "
    "below 100 %.</li>\n"
    "<li>Frame: the GPU's time for the whole picture without shadow maps, which are kept while lights and scene stay "
    "the same.</li>\n"
    "<li>Structure: all GPU memory of the method; pool used: the part of it that holds lists of triangles or "
    "fragments.</li>\n"
    "</ul>\n";

constexpr const char* kFits =
    "A straight line through each curve by least squares: what it costs to trace nothing, and what the whole screen "
    "adds. R² is the share of the variance that the line explains; off the line is the root mean square distance from "
    "it. 3 % : 100 % is the cost of 1/32 of the screen over the cost of all of it. A jump is the part of a step "
    "between neighboring points that the line does not predict, in units of the curve's median step.";

constexpr const char* kJumps =
    "The step of each growing region's trace that is furthest off its line. A growing region takes in new parts of the "
    "picture, and rays cost more if they pass much geometry; scattered pixels see all parts of the picture at every "
    "share. So a jump in the region alone comes from the pixels that entered it, while a jump from exhausted caches or "
    "memory would be in both. Steps below three median steps are not called jumps. The paper (M. F. Kastrati, "
    "P. Goswami, Selective rasterized ray-traced reflections on the GPU, 2017, figure 7) saw a jump between 34.4 % and "
    "37.5 % on Sponza and left open which of the two it was.";

}  // namespace

std::string coverageBody(const CoverageCurves& curves, const std::vector<Figure>& pictures,
                         const std::optional<std::string>& svg) {
  return kIntroduction + gallery(pictures) + heading("Time and memory over coverage") +
         chartFigure(svg, "Dashed: the straight line that fits best.") + kMethod + heading("Straight lines") +
         linearity(curves) + smallShares(curves) + toHtml(fitTable(curves)) + paragraph(kFits) + heading("Jumps") +
         toHtml(jumpTable(curves)) + paragraph(kJumps);
}

}  // namespace halfsilver::bench
