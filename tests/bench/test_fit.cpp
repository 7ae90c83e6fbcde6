#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/harness/fit.h"
#include "bench/modes/coverage/coverage.h"

namespace halfsilver::bench {
namespace {

std::vector<XY> line(int count, double slope, double intercept) {
  std::vector<XY> points;
  for (int i = 0; i < count; ++i) points.push_back({0.1 * i, intercept + slope * 0.1 * i});
  return points;
}

TEST(Fit, ALineIsFoundExactly) {
  const auto fit = fitLine(line(33, -2.5, 7));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->slope, -2.5, 1e-12);
  EXPECT_NEAR(fit->intercept, 7, 1e-12);
  EXPECT_NEAR(*fit->rSquared, 1, 1e-12);
  EXPECT_NEAR(fit->residual, 0, 1e-6);
  EXPECT_NEAR(fit->at(2), 2, 1e-12);
}

// By hand: means 1.5 and 2, sums of squares 5 (x), 7 (xy) and 10 (y).
TEST(Fit, KnownScatter) {
  const auto fit = fitLine(std::vector<XY>{{0, 0}, {1, 1}, {2, 3}, {3, 4}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->slope, 1.4, 1e-12);
  EXPECT_NEAR(fit->intercept, -0.1, 1e-12);
  EXPECT_NEAR(*fit->rSquared, 0.98, 1e-12);
  EXPECT_NEAR(fit->residual, std::sqrt(0.2 / 4), 1e-12);
}

TEST(Fit, NothingInCommonIsNoLine) {
  const auto fit = fitLine(std::vector<XY>{{-1, 1}, {0, 0}, {1, 1}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->slope, 0, 1e-12);
  EXPECT_NEAR(*fit->rSquared, 0, 1e-12);
}

TEST(Fit, ConstantDataHaveNothingToExplain) {
  const std::vector<XY> points = line(7, 0, 0.1);
  const auto fit = fitLine(points);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->slope, 0);
  EXPECT_EQ(fit->intercept, 0.1);
  EXPECT_FALSE(fit->rSquared);
  EXPECT_FALSE(largestJump(points, *fit));
}

TEST(Fit, TwoDifferentPlacesAreNeeded) {
  EXPECT_FALSE(fitLine({}));
  EXPECT_FALSE(fitLine(std::vector<XY>{{1, 2}}));
  EXPECT_FALSE(fitLine(std::vector<XY>{{1, 2}, {1, 3}, {1, 4}}));
  EXPECT_TRUE(fitLine(std::vector<XY>{{1, 2}, {2, 3}}));
}

TEST(Jump, IsFoundWhereItIs) {
  std::vector<XY> points = line(33, 10, 1);  // a step is 1
  for (std::size_t i = 12; i < points.size(); ++i) points[i].y += 6;
  const LinearFit steady{10, 1, 1.0, 0};
  const auto jump = largestJump(points, steady);
  ASSERT_TRUE(jump);
  EXPECT_EQ(jump->first, 11u);
  EXPECT_NEAR(jump->excess, 6, 1e-9);
  EXPECT_NEAR(jump->medianSteps, 6, 1e-9);
  EXPECT_NEAR(jumpAt(points, steady, 20)->excess, 0, 1e-9);
  // The line of the points themselves is a little steeper.
  const auto fit = fitLine(points);
  ASSERT_TRUE(fit);
  EXPECT_EQ(largestJump(points, *fit)->first, 11u);
  EXPECT_GT(largestJump(points, *fit)->medianSteps, 5);
}

TEST(Jump, DropsAndUnevenStepsCount) {
  const LinearFit flat{1, 0, 1.0, 0};
  // Every second step is twice as wide; on the line that is no jump.
  const std::vector<XY> uneven = {{0, 0}, {1, 1}, {3, 3}, {4, 4}, {6, 6}};
  EXPECT_NEAR(largestJump(uneven, flat)->excess, 0, 1e-12);
  const std::vector<XY> drop = {{0, 0}, {1, 1}, {2, -3}, {3, -2}};
  EXPECT_EQ(largestJump(drop, flat)->first, 1u);
  EXPECT_NEAR(largestJump(drop, flat)->medianSteps, -5, 1e-12);
}

TEST(ScatteredOrder, TakesEachOnceAndHidesATrend) {
  EXPECT_EQ(scatteredOrder(4), (std::vector<int>{0, 4, 2, 1, 3}));
  const std::vector<int> order = scatteredOrder(32);
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i <= 32; ++i) EXPECT_EQ(sorted[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(sorted.size(), 33u);
  // A cost that grows with time alone is no line over the numbers.
  std::vector<XY> drift;
  for (std::size_t i = 0; i < order.size(); ++i)
    drift.push_back({static_cast<double>(order[i]), static_cast<double>(i)});
  EXPECT_LT(*fitLine(drift)->rSquared, 0.1);
}

}  // namespace
}  // namespace halfsilver::bench
