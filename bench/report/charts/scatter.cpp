#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "bench/report/charts/chart.h"
#include "bench/report/charts/gnuplot.h"

// Charts of marks. Positions are computed here, in pixels, so that labels overlap neither marks nor each other.
namespace halfsilver::bench {
namespace {

constexpr double kPanelWidth = 550, kPanelHeight = 430;             // pixels
constexpr double kLeft = 75, kRight = 20, kTop = 45, kBottom = 65;  // margins of a panel
constexpr double kLegendRow = 26, kLegendColumn = 175;
constexpr double kRadius = 5.5;              // of a mark of medium size
constexpr double kLetter = 6.6, kLine = 12;  // of a label
constexpr double kBetweenLabels = 5;
constexpr double kBelowAxis = 90, kZero = 40;  // height below the axis; of that, the row for 0

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

// From values to pixels, rows from the top.
class Plane {
 public:
  Plane(const ScatterPanel& panel, double left, double top)
      : area_{left + kLeft, top + kTop, left + kPanelWidth - kRight, top + kPanelHeight - kBottom} {
    double minY = 1e300, maxY = 0, minX = 1e300, maxX = 0;
    for (const Mark& mark : panel.marks) {
      if (mark.y > 0) minY = std::min(minY, mark.y);
      maxY = std::max(maxY, mark.y);
      minX = std::min(minX, mark.x);
      maxX = std::max(maxX, mark.x);
    }
    if (maxY <= 0) minY = maxY = 1;
    if (maxX <= 0) minX = maxX = 1;
    low_ = std::floor(std::log10(minY) - 0.05);
    high_ = std::max(std::ceil(std::log10(maxY) + 0.05), low_ + 1);
    lowX_ = std::log10(minX) - 0.1;
    highX_ = std::max(std::log10(maxX) + 0.2, lowX_ + 0.6);
  }

  const Box& area() const { return area_; }
  double x(double value) const {
    return area_.left + (std::log10(value) - lowX_) / (highX_ - lowX_) * (area_.right - area_.left);
  }
  double y(double value) const { return value > 0 ? height(std::log10(value)) : area_.bottom - kZero; }
  double breakLine() const { return area_.bottom - kBelowAxis + 5; }

  // gnuplot commands for the axes.
  std::string axes() const {
    std::ostringstream text;
    const double pixel = (high_ - low_) / (height(low_) - height(high_));  // decades
    const double bottom = low_ - kBelowAxis * pixel;
    text << "set xrange [" << std::pow(10, lowX_) << ':' << std::pow(10, highX_) << "]\nset yrange ["
         << std::pow(10, bottom) << ':' << std::pow(10, high_) << "]\nset ytics (\"0\" "
         << std::pow(10, bottom + kZero * pixel) << ticks(low_, high_) << ")\nset xtics (\"\" " << std::pow(10, lowX_)
         << ticks(lowX_, highX_) << ")\n";
    return text.str();
  }

 private:
  double height(double logarithm) const {
    return area_.top + (high_ - logarithm) / (high_ - low_) * (area_.bottom - kBelowAxis - area_.top);
  }
  // Each after a comma; `low` and `high` are exponents of ten.
  static std::string ticks(double low, double high) {
    std::ostringstream text;
    for (const double tick : logarithmicTicks(std::pow(10, low), std::pow(10, high))) text << ", " << tick;
    return text.str();
  }

  Box area_;
  double low_ = 0, high_ = 1, lowX_ = 0, highX_ = 1;  // exponents of ten
};

Box around(const Mark& mark, const Plane& plane) {
  const double radius = kRadius * (mark.radius + (mark.ringed ? 0.6 : 0)), x = plane.x(mark.x), y = plane.y(mark.y);
  return {x - radius, y - radius, x + radius, y + radius};
}

bool inside(const Box& box, const Box& area) {
  return box.left >= area.left && box.right <= area.right && box.top >= area.top && box.bottom <= area.bottom;
}

// The first free position for a label: beside its mark, or some lines above or below it.
std::optional<Box> place(const Mark& mark, const Plane& plane, const std::vector<Box>& taken) {
  const Box own = around(mark, plane);
  const double width = kLetter * static_cast<double>(mark.label.size()) + kBetweenLabels;
  const double x = plane.x(mark.x), y = plane.y(mark.y);
  for (const int line : {0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6, -7, 7, -8, 8})
    for (const double left : {own.right + 3, own.left - 3 - width, x - width / 2}) {
      const double middle = y + line * (kLine + 1);
      const Box box{left, middle - kLine / 2, left + width, middle + kLine / 2};
      const auto hits = [&](const Box& other) { return box.overlaps(other); };
      if (inside(box, plane.area()) && std::none_of(taken.begin(), taken.end(), hits)) return box;
    }
  return std::nullopt;
}

// Writes drawing commands in pixels of a picture of known size.
class Canvas {
 public:
  // gnuplot scales points differently in each format.
  Canvas(std::ostream& script, ChartFormat format, double width, double height)
      : script_(&script), pointSize_(format == ChartFormat::svg ? 0.9 : 1.75), width_(width), height_(height) {}

  std::string at(double x, double y) const {
    std::ostringstream text;
    text << "screen " << x / width_ << ", screen " << 1 - y / height_;
    return text.str();
  }
  void label(const std::string& text, double x, double y) const {
    *script_ << "set label " << quoted(text) << " at " << at(x, y) << " left font \",9\"\n";
  }
  void line(double x0, double y0, double x1, double y1, const char* style) const {
    *script_ << "set arrow from " << at(x0, y0) << " to " << at(x1, y1) << " nohead " << style << '\n';
  }
  void mark(const Mark& mark, double x, double y) const {
    const auto point = [&](const char* type, double radius, const std::string& color) {
      *script_ << "set label \"\" at " << at(x, y) << " point " << type << " ps " << pointSize_ * radius << " lc rgb \""
               << color << "\" front\n";
    };
    const std::string color = kColors[mark.color % std::size(kColors)];
    if (!mark.hollow) point("pt 7", mark.radius, "#60" + color.substr(1));
    point("pt 6", mark.radius, color);
    if (mark.ringed) point("pt 6 lw 2", mark.radius + 0.6, "#000000");
  }
  void margins(const Box& area) const {
    *script_ << "set lmargin at screen " << area.left / width_ << "\nset rmargin at screen " << area.right / width_
             << "\nset tmargin at screen " << 1 - area.top / height_ << "\nset bmargin at screen "
             << 1 - area.bottom / height_ << '\n';
  }

 private:
  std::ostream* script_;
  double pointSize_;  // of a mark of medium size
  double width_, height_;
};

// The steps of a front as boxes without width or height.
std::vector<Box> steps(const Plane& plane, const std::vector<Sample>& front) {
  std::vector<Box> lines;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const double x = plane.x(front[i].x), y = plane.y(front[i].y);
    const bool last = i + 1 == front.size();
    const double next = last ? plane.area().right : plane.x(front[i + 1].x);
    lines.push_back({x, y, next, y});
    if (!last) lines.push_back({next, y, next, plane.y(front[i + 1].y)});
  }
  return lines;
}

void drawPanel(const Canvas& canvas, const Plane& plane, const ScatterPanel& panel) {
  canvas.line(plane.area().left, plane.breakLine(), plane.area().right, plane.breakLine(),
              "dt 3 lc rgb \"#888888\" back");
  std::vector<Box> taken = steps(plane, panel.front);
  for (const Box& line : taken)
    canvas.line(line.left, line.top, line.right, line.bottom, "lw 1.5 lc rgb \"#444444\" back");
  std::vector<const Mark*> marks;
  for (const Mark& mark : panel.marks) {
    marks.push_back(&mark);
    taken.push_back(around(mark, plane));
  }
  // Large ones first, so that small ones stay visible.
  std::stable_sort(marks.begin(), marks.end(), [](const Mark* a, const Mark* b) { return a->radius > b->radius; });
  for (const Mark* mark : marks) canvas.mark(*mark, plane.x(mark->x), plane.y(mark->y));
  for (const Mark& mark : panel.marks) {
    if (mark.label.empty()) continue;
    const std::optional<Box> box = place(mark, plane, taken);
    if (!box) continue;
    taken.push_back(*box);
    const double middle = (box->top + box->bottom) / 2, x = plane.x(mark.x), y = plane.y(mark.y);
    canvas.label(mark.label, box->left, middle);
    if (std::abs(middle - y) > 1)
      canvas.line(x, y, std::clamp(x, box->left, box->right), middle < y ? box->bottom : box->top,
                  "lw 0.5 lc rgb \"#888888\" front");
  }
}

}  // namespace

std::string gnuplotScript(const ScatterGrid& grid, ChartFormat format) {
  const std::size_t rows = (grid.panels.size() + grid.columns - 1) / grid.columns;
  const double header = kLegendRow * static_cast<double>(grid.legend.size());
  const double width = kPanelWidth * static_cast<double>(grid.columns);
  const double height = header + kPanelHeight * static_cast<double>(rows);
  std::ostringstream script;
  const Canvas canvas(script, format, width, height);
  script << terminal(format, width, height) << "set multiplot\nunset key\nset grid lc rgb \"#dddddd\"\n"
         << "set border 3\nset tics nomirror out\nset logscale xy 10\nset format \"%g\"\n";
  for (std::size_t index = 0; index < grid.panels.size(); ++index) {
    const ScatterPanel& panel = grid.panels[index];
    const std::size_t panelColumn = index % grid.columns, panelRow = index / grid.columns;
    const Plane plane(panel, kPanelWidth * static_cast<double>(panelColumn),
                      header + kPanelHeight * static_cast<double>(panelRow));
    script << "unset label\nunset arrow\nset title " << quoted(panel.title) << "\nset xlabel " << quoted(panel.xAxis)
           << "\nset ylabel " << quoted(panel.yAxis) << '\n'
           << plane.axes();
    canvas.margins(plane.area());
    if (index == 0)
      for (std::size_t row = 0; row < grid.legend.size(); ++row)
        for (std::size_t column = 0; column < grid.legend[row].size(); ++column) {
          const Mark& mark = grid.legend[row][column];
          const double x = 30 + kLegendColumn * static_cast<double>(column);
          const double y = kLegendRow * (0.6 + static_cast<double>(row));
          canvas.mark(mark, x, y);
          canvas.label(mark.label, x + 16, y);
        }
    drawPanel(canvas, plane, panel);
    script << "plot 1e-300 notitle\n";  // outside the axes, which gnuplot draws only with a plot
  }
  script << "unset multiplot\n";
  return script.str();
}

}  // namespace halfsilver::bench
