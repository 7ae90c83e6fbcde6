#include "apps/pareto.h"

#include <gtest/gtest.h>

#include <limits>

namespace halfsilver {
namespace {

using Indices = std::vector<std::size_t>;

TEST(Pareto, KeepsWhatNothingBeatsInOrderOfTime) {
  const Cost points[] = {
      {30, 10, 0},      // slow and exact
      {10, 100, 0.1},   // fast, large and wrong
      {20, 50, 0.01},   // between
      {30, 10, 0.001},  // as the first, with errors
      {20, 51, 0.01},   // as the third, larger
      {40, 9, 0.5},     // smallest
      {50, 200, 1},     // beaten by all
  };
  EXPECT_EQ(paretoFront(points), (Indices{1, 2, 0, 5}));
}

TEST(Pareto, EqualPointsStayTogetherAndOneIsAFront) {
  const Cost equal[] = {{2, 2, 0.2}, {1, 3, 0.2}, {2, 2, 0.2}};
  EXPECT_EQ(paretoFront(equal), (Indices{1, 0, 2}));
  EXPECT_EQ(paretoFront(std::span(equal, 1)), (Indices{0}));
  EXPECT_EQ(paretoFront({}), Indices{});
}

// Whatever is measured: no point of the front beats another, and each other point is beaten by one of the front.
TEST(Pareto, TheFrontCoversAGridOfPoints) {
  std::vector<Cost> points;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 6; ++z)
        if (x + y + z >= 7) points.push_back({double(x), static_cast<std::uint64_t>(y), z / 10.0});
  const Indices front = paretoFront(points);
  std::size_t least = 0;
  for (const Cost& p : points) least += p.milliseconds + static_cast<double>(p.bytes) + 10 * p.error < 7.5;
  EXPECT_EQ(front.size(), least);
  EXPECT_GT(least, 10u);
  for (const std::size_t i : front)
    EXPECT_LT(points[i].milliseconds + static_cast<double>(points[i].bytes) + 10 * points[i].error, 7.5);
}

TEST(FastestWithin, LooksAtTheErrorThenTimeThenMemory) {
  const Cost points[] = {{30, 10, 0}, {10, 100, 0.1}, {20, 50, 0.01}, {20, 40, 0.01}, {20, 40, 0.005}};
  EXPECT_EQ(fastestWithin(points, 1), 1u);
  EXPECT_EQ(fastestWithin(points, 0.1), 1u);
  EXPECT_EQ(fastestWithin(points, 0.05), 3u);
  EXPECT_EQ(fastestWithin(points, 0.005), 4u);
  EXPECT_EQ(fastestWithin(points, 0), 0u);
  EXPECT_EQ(fastestWithin(std::span(points).subspan(1), 0), std::nullopt);
  EXPECT_EQ(fastestWithin({}, 1), std::nullopt);
}

TEST(ClearlyBeaten, NeedsHalfTheTimeAndNoOtherLoss) {
  const Cost point{100, 50, 0.01};
  const auto by = [&](const Cost& other) { return clearlyBeaten(point, std::span(&other, 1)); };
  EXPECT_TRUE(by({50, 50, 0.01}));
  EXPECT_TRUE(by({1, 1, 0}));
  EXPECT_FALSE(by({51, 1, 0}));
  EXPECT_FALSE(by({10, 51, 0}));
  EXPECT_FALSE(by({10, 50, 0.02}));
  EXPECT_FALSE(by(point));
  // Not even if no time is known.
  const Cost untold{std::numeric_limits<double>::infinity(), 50, 0.01}, instant{0, 50, 0.01};
  EXPECT_FALSE(clearlyBeaten(untold, std::span(&untold, 1)));
  EXPECT_FALSE(clearlyBeaten(instant, std::span(&instant, 1)));
  EXPECT_FALSE(clearlyBeaten(point, {}));
}

}  // namespace
}  // namespace halfsilver
