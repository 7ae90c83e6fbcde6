#pragma once

#include <cstddef>
#include <optional>
#include <span>

// Straight lines through measured points, and where the points leave them.
namespace halfsilver::bench {

struct XY {
  double x = 0, y = 0;
};

struct LinearFit {
  double slope = 0, intercept = 0;
  std::optional<double> rSquared;  // 0..1; nothing where all y are equal, as there is nothing to explain
  double residual = 0;             // root of the mean square of what the line leaves, in units of y

  double at(double x) const { return intercept + slope * x; }
};

// Least squares. Nothing where there are no two different x.
std::optional<LinearFit> fitLine(std::span<const XY> points);

// y = factor x^exponent
struct PowerLaw {
  double exponent = 0, factor = 1;
  std::optional<double> rSquared;  // of the line through the logarithms, see LinearFit
  std::size_t first = 0;           // the law holds from this point to the last

  double at(double x) const;
};

// The law of the largest x: of the longest run of points up to the last, at least three, in which none is off by more
// than a half. Nothing where there is no such run. Points are in order of x; all numbers are positive.
std::optional<PowerLaw> fitPowerLaw(std::span<const XY> points);

// A rise from a point to its neighbour, beside what the line foretells for them.
struct Jump {
  std::size_t first = 0;   // the point before it
  double excess = 0;       // rise above the line's, in units of y; negative where it falls short
  double medianSteps = 0;  // the same in units of the median of all steps between neighbours, without their signs
};

// The jump behind point `first`. Nothing where the median step is 0.
std::optional<Jump> jumpAt(std::span<const XY> points, const LinearFit& fit, std::size_t first);
// The one that leaves the line most, up or down. Points are in order of x, at least two.
std::optional<Jump> largestJump(std::span<const XY> points, const LinearFit& fit);

}  // namespace halfsilver::bench
