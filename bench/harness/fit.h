#pragma once

#include <cstddef>
#include <optional>
#include <span>

// Straight lines and power laws through measured points, and jumps off them.
namespace halfsilver::bench {

struct XY {
  double x = 0, y = 0;
};

struct LinearFit {
  double slope = 0, intercept = 0;
  std::optional<double> rSquared;  // 0..1; nothing if all y are equal: there is nothing to explain
  double residual = 0;             // root mean square distance from the line, in units of y

  double at(double x) const { return intercept + slope * x; }
};

// Least squares. Nothing unless there are two different x.
std::optional<LinearFit> fitLine(std::span<const XY> points);

// y = factor x^exponent
struct PowerLaw {
  double exponent = 0, factor = 1;
  std::optional<double> rSquared;  // of the line through the logarithms, see LinearFit
  std::size_t first = 0;           // the law holds from this point to the last

  double at(double x) const;
};

// The law at the largest x: fits the longest tail of at least three points in which none is off by more than a factor
// of 1.5. Nothing if there is no such tail. Points are in order of x; all numbers are positive.
std::optional<PowerLaw> fitPowerLaw(std::span<const XY> points);

// The rise from one point to the next, beyond what the line predicts.
struct Jump {
  std::size_t first = 0;   // the point before it
  double excess = 0;       // over the line's own rise, in units of y; negative if the rise falls short
  double medianSteps = 0;  // the same in units of the median absolute step between neighbors
};

// The jump after point `first`. Nothing if the median step is 0.
std::optional<Jump> jumpAt(std::span<const XY> points, const LinearFit& fit, std::size_t first);
// The largest jump, up or down. Points are in order of x, at least two.
std::optional<Jump> largestJump(std::span<const XY> points, const LinearFit& fit);

}  // namespace halfsilver::bench
