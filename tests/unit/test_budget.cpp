#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <halfsilver/budget.h>
#include <halfsilver/shared_structs.h>

namespace halfsilver {
namespace {

// A model of a renderer: the contributions of its pixels are spread evenly over the octaves from 2^-8 to 1; time and
// memory depend on the number of rays.
struct Machine {
  double pixels = 100000;
  double fixedTime = 4, timePerRay = 2e-4;      // 24 ms with all rays
  double fixedBytes = 1e6, bytesPerRoot = 1e4;  // 4.2 MB with all rays
  double buildTime = 0;                         // of a frame that builds
  double noise = 0;                             // of the time, relative
  std::mt19937 random{7};
  double built = 0;  // most rays since the structure was forgotten

  FrameReport draw(float minContribution, bool forget) {
    if (forget) built = 0;
    FrameReport report;
    report.pixels = report.reflecting = static_cast<std::uint64_t>(pixels);
    const int first = CONTRIBUTION_CLASSES / 2;
    report.contributions.assign(CONTRIBUTION_CLASSES, 0);
    for (int i = first; i < CONTRIBUTION_CLASSES; ++i)
      report.contributions[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(pixels / first);
    const double octaves = minContribution > 0 ? std::clamp(-std::log2(minContribution), 0.0f, 8.0f) : 8.0;
    const double rays = std::floor(pixels * octaves / 8);
    report.selected = static_cast<std::uint64_t>(rays);
    const double build = rays > built ? buildTime : 0;
    built = std::max(built, rays);
    std::uniform_real_distribution<double> factor(1 - noise, 1 + noise);
    const double trace = rays * timePerRay * factor(random);
    report.times = {{"build", build}, {"trace", trace}, {"frame", fixedTime + build + trace}};
    report.memory.structureTotal = static_cast<std::uint64_t>(fixedBytes + bytesPerRoot * std::sqrt(built));
    return report;
  }
};

double frameTime(const FrameReport& report) { return report.times.back().milliseconds; }

struct History {
  std::vector<FrameReport> frames;
  std::vector<float> thresholds;  // of each frame
  int forgotten = 0;
};

History run(Machine& machine, Budget& budget, int frames) {
  History result;
  for (int i = 0; i < frames; ++i) {
    const bool forget = budget.forgetStructures();
    result.forgotten += forget;
    result.thresholds.push_back(budget.minContribution());
    result.frames.push_back(machine.draw(budget.minContribution(), forget));
    budget.learn(result.frames.back());
  }
  return result;
}

int changes(const std::vector<float>& thresholds) {
  int count = 0;
  for (std::size_t i = 1; i < thresholds.size(); ++i) count += thresholds[i] != thresholds[i - 1];
  return count;
}

TEST(ContributionThreshold, KeepsAsManyAsAskedFor) {
  std::vector<std::uint32_t> counts(CONTRIBUTION_CLASSES, 0);
  counts[CONTRIBUTION_CLASSES - 1] = 10;   // 2^(-1/16) .. 1
  counts[CONTRIBUTION_CLASSES - 17] = 20;  // an octave below
  EXPECT_EQ(contributionThreshold(counts, 30), 0);
  EXPECT_EQ(contributionThreshold(counts, 1000), 0);
  EXPECT_EQ(contributionThreshold(counts, 0), 1);
  EXPECT_FLOAT_EQ(contributionThreshold(counts, 5), std::exp2(-0.5f / 16));
  EXPECT_FLOAT_EQ(contributionThreshold(counts, 10), 0.5f);
  EXPECT_FLOAT_EQ(contributionThreshold(counts, 20), std::exp2(-1 - 0.5f / 16));
  EXPECT_EQ(contributionThreshold({}, 5), 0);
}

TEST(Budget, NothingIsDroppedIfAllFits) {
  Machine machine;
  Budget budget({.milliseconds = 25, .bytes = 5e6});
  const History result = run(machine, budget, 10);
  EXPECT_EQ(changes(result.thresholds), 0);
  EXPECT_EQ(result.frames.back().selected, 100000u);
  EXPECT_EQ(result.forgotten, 0);
  EXPECT_TRUE(budget.held());
  EXPECT_TRUE(budget.atRest());
}

TEST(Budget, TheTimeLimitHoldsFromTheSecondFrameOn) {
  Machine machine;
  Budget budget({.milliseconds = 12});
  const History result = run(machine, budget, 30);
  EXPECT_GT(frameTime(result.frames[0]), 12);
  for (std::size_t i = 1; i < result.frames.size(); ++i) EXPECT_LE(frameTime(result.frames[i]), 12) << i;
  EXPECT_TRUE(budget.atRest());
  // Not far below what is possible: 40,000 rays take 12 ms.
  EXPECT_GT(result.frames.back().selected, 28000u);
  EXPECT_LE(changes(result.thresholds), 3);
}

// A frame of 24 ms with all of its 100,000 pixels: a tenth contribute about 2^-1, the others about 2^-5.
FrameReport twoKinds() {
  FrameReport report = Machine().draw(0, false);
  std::fill(report.contributions.begin(), report.contributions.end(), 0);
  report.contributions[16 * 11 + 8] = 90000;
  report.contributions[16 * 15 + 8] = 10000;
  return report;
}

TEST(Budget, TheLeastVisibleIsDroppedFirst) {
  Budget budget({.milliseconds = 12});
  budget.learn(twoKinds());  // room for 30,000: all of the first kind and a few of the second
  EXPECT_GT(budget.minContribution(), std::exp2(-5 + 8.5f / 16));
  EXPECT_LT(budget.minContribution(), std::exp2(-5 + 9.0f / 16));
  Budget smaller({.milliseconds = 5.5});
  smaller.learn(twoKinds());  // room for a few thousand of the first
  EXPECT_GT(smaller.minContribution(), std::exp2(-1 + 8.0f / 16));
  EXPECT_LT(smaller.minContribution(), std::exp2(-1 + 9.0f / 16));
}

TEST(Budget, WhatContributesNothingIsDroppedAsAWholeAndStaysAway) {
  Budget budget({.milliseconds = 12});
  FrameReport report = twoKinds();
  report.contributions[0] = 100000;  // twice as many pixels, half of them not reflecting
  report.selected *= 2;
  report.times = {{"trace", 40}, {"frame", 44}};
  budget.learn(report);
  EXPECT_GT(budget.minContribution(), 0);
  Budget enough({.milliseconds = 30});
  enough.learn(report);
  const float least = enough.minContribution();
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 2e-5f);
  FrameReport without = twoKinds();
  without.contributions[0] = 100000;
  without.times = {{"trace", 2}, {"frame", 6}};
  for (int i = 0; i < 20; ++i) enough.learn(without);
  EXPECT_EQ(enough.minContribution(), least);
  EXPECT_EQ(enough.dropped(), 0u);
  EXPECT_TRUE(enough.atRest());
}

TEST(Budget, PixelsBelowTheUsersThresholdDoNotCountAsDropped) {
  Machine machine;
  Budget budget({.milliseconds = 12, .minContribution = 0.01f});
  run(machine, budget, 30);
  const FrameReport last = machine.draw(budget.minContribution(), false);
  double most = 0;
  for (std::size_t i = 16 * 9 + 5; i < last.contributions.size(); ++i) most += last.contributions[i];
  EXPECT_NEAR(static_cast<double>(budget.dropped()), most - static_cast<double>(last.selected), 1000);
  EXPECT_GT(budget.dropped(), 20000u);
  Machine fast;
  Budget large({.milliseconds = 100, .minContribution = 0.01f});
  run(fast, large, 5);
  EXPECT_EQ(large.dropped(), 0u);
}

TEST(Budget, RejectedTimesTeachNothing) {
  Machine machine;
  Budget budget({.milliseconds = 12});
  run(machine, budget, 30);
  const float before = budget.minContribution();
  FrameReport report = machine.draw(before, false);
  report.times.back().milliseconds = -1;
  for (int i = 0; i < 50; ++i) budget.learn(report);
  EXPECT_EQ(budget.minContribution(), before);
}

TEST(Budget, SlowFramesBetweenRoomyOnesKeepPixelsAway) {
  Machine machine;
  Budget budget({.milliseconds = 12});
  run(machine, budget, 30);
  for (int i = 0; i < 30; ++i) {
    machine.timePerRay = i % 3 == 2 ? 4e-4 : 1e-4;
    const float before = budget.minContribution();
    budget.learn(machine.draw(before, false));
    EXPECT_GE(budget.minContribution(), before) << i;
  }
}

TEST(Budget, MemoryThatRaysDoNotUseDropsNoRays) {
  Machine machine;
  machine.fixedBytes = 9e8;
  Budget budget({.bytes = 1e8});
  const History result = run(machine, budget, 40);
  EXPECT_FALSE(budget.held());
  EXPECT_TRUE(budget.atRest());
  EXPECT_EQ(result.frames.back().selected, 100000u);
}

TEST(Budget, NoiseDoesNotMakeItSwing) {
  Machine machine;
  machine.noise = 0.08;
  Budget budget({.milliseconds = 12});
  run(machine, budget, 40);
  const History result = run(machine, budget, 1000);
  EXPECT_LE(changes(result.thresholds), 2);
  int over = 0;
  for (const FrameReport& frame : result.frames) over += frameTime(frame) > 12;
  EXPECT_LE(over, 2);
}

TEST(Budget, WildNoiseIsMetWithPatience) {
  Machine machine;
  machine.noise = 0.5;
  Budget budget({.milliseconds = 12});
  run(machine, budget, 200);
  EXPECT_LE(changes(run(machine, budget, 1000).thresholds), 60);
}

TEST(Budget, PixelsComeBackWithTheTime) {
  Machine machine;
  Budget budget({.milliseconds = 12});
  run(machine, budget, 30);
  machine.timePerRay /= 10;
  EXPECT_EQ(run(machine, budget, 60).frames.back().selected, 100000u);
  EXPECT_EQ(budget.minContribution(), 0);
}

TEST(Budget, AnImpossibleLimitDropsEverythingAndIsReported) {
  Machine machine;
  Budget budget({.milliseconds = 3});
  const History result = run(machine, budget, 10);
  EXPECT_EQ(result.frames.back().selected, 0u);
  EXPECT_FALSE(budget.held());
  EXPECT_TRUE(budget.atRest());
  machine.fixedTime = 1;
  EXPECT_GT(run(machine, budget, 60).frames.back().selected, 5000u);
  EXPECT_TRUE(budget.held());
}

TEST(Budget, TheTimeOfAStructureThatIsKeptIsForgiven) {
  Machine machine;
  machine.buildTime = 50;
  Budget budget({.milliseconds = 25});
  EXPECT_EQ(changes(run(machine, budget, 10).thresholds), 0);
  EXPECT_TRUE(budget.held());
}

TEST(Budget, TheTimeOfAStructureBuiltInEveryFrameIsNot) {
  Machine machine;
  Budget budget({.milliseconds = 25});
  std::vector<double> times;
  for (int i = 0; i < 20; ++i) {
    machine.built = 0;
    machine.buildTime = 1e-4 * static_cast<double>(machine.draw(budget.minContribution(), true).selected);
    machine.built = 0;
    const FrameReport report = machine.draw(budget.minContribution(), true);
    times.push_back(frameTime(report));
    budget.learn(report);
  }
  EXPECT_GT(times.front(), 25);
  EXPECT_LE(times.back(), 25);
  EXPECT_GT(budget.minContribution(), 0);
}

TEST(Budget, TheMemoryLimitHoldsAndIsUsed) {
  Machine machine;
  Budget budget({.bytes = 3e6});  // 40,000 rays
  const History result = run(machine, budget, 60);
  EXPECT_TRUE(budget.atRest());
  EXPECT_TRUE(budget.held());
  EXPECT_LE(result.frames.back().memory.structureTotal, 3e6);
  EXPECT_GT(result.frames.back().selected, 30000u);
  const History later = run(machine, budget, 200);
  EXPECT_EQ(changes(later.thresholds), 0);
  EXPECT_EQ(later.forgotten, 0);
}

TEST(Budget, WhatOtherViewsHaveBuiltIsForgottenBeforePixelsAreDropped) {
  Machine machine;
  Budget budget({.bytes = 4.5e6});
  run(machine, budget, 10);
  machine.built = 150000;  // of another view
  const History result = run(machine, budget, 10);
  EXPECT_EQ(result.forgotten, 1);
  EXPECT_EQ(changes(result.thresholds), 0);
  EXPECT_TRUE(budget.held());
}

TEST(Budget, AnotherViewIsMeasuredAfresh) {
  Machine machine;
  Budget budget({.bytes = 3e6});
  run(machine, budget, 60);
  machine.pixels = 20000;
  const History result = run(machine, budget, 60);
  EXPECT_EQ(result.frames.back().selected, 20000u);
  EXPECT_TRUE(budget.held());
}

TEST(Budget, TheUsersOwnThresholdStays) {
  for (const float least : {0.25f, 0.3f, 0.05f}) {
    Machine machine;
    Budget budget({.milliseconds = 100, .minContribution = least});
    const History result = run(machine, budget, 20);
    EXPECT_EQ(budget.minContribution(), least);
    EXPECT_NEAR(static_cast<double>(result.frames.back().selected), -12500 * std::log2(least), 2);
    EXPECT_TRUE(budget.atRest());
  }
}

// A renderer whose rays take `perRay` milliseconds per pixel.
FrameReport drawPasses(const PassBudget& budget, double fixed, double perRay) {
  const double rays = perRay * budget.passes() * budget.samples();
  FrameReport report;
  report.times = {{"trace", 0.75 * rays}, {"shade", 0.25 * rays}, {"frame", fixed + rays}};
  return report;
}

EffectSettings passesOf(int samples, int passes) {
  EffectSettings settings;
  settings.samples = samples;
  settings.passes = passes;
  return settings;
}

TEST(PassBudget, SendsAsManyRaysAsTheLimitAllowsAndThenRests) {
  PassBudget budget(20, passesOf(8, 16));
  FrameReport report;
  int frames = 0;
  for (; frames < 20 && !budget.atRest(); ++frames) budget.learn(report = drawPasses(budget, 4, 0.5));
  EXPECT_TRUE(budget.atRest()) << frames;
  EXPECT_TRUE(budget.held());
  EXPECT_EQ(budget.passes(), 3);  // 4 + 3 * 8 * 0.5
  EXPECT_EQ(budget.samples(), 8);
  EXPECT_EQ(budget.raysPerPixel(), 24);
  // Four times as fast: passes come back, up to the limit.
  for (int i = 0; i < 40; ++i) budget.learn(report = drawPasses(budget, 4, 0.125));
  EXPECT_TRUE(budget.held());
  EXPECT_GE(budget.passes(), 10);
  EXPECT_LE(frameTime(report), 20);
}

TEST(PassBudget, LowersSamplesBelowOnePassAndSendsOneRayAtLeast) {
  PassBudget budget(6, passesOf(8, 4));
  for (int i = 0; i < 10; ++i) budget.learn(drawPasses(budget, 4, 0.5));
  EXPECT_TRUE(budget.held());
  EXPECT_EQ(budget.passes(), 1);
  EXPECT_EQ(budget.samples(), 2);
  PassBudget hopeless(1, passesOf(8, 4));
  for (int i = 0; i < 10; ++i) hopeless.learn(drawPasses(hopeless, 4, 0.5));
  EXPECT_EQ(hopeless.raysPerPixel(), 1);
  EXPECT_FALSE(hopeless.held());
  EXPECT_TRUE(hopeless.atRest());
}

TEST(PassBudget, ChangesNothingIfThereIsTime) {
  PassBudget budget(1000, passesOf(8, 4));
  budget.learn(drawPasses(budget, 4, 0.5));
  EXPECT_EQ(budget.raysPerPixel(), 32);
  EXPECT_TRUE(budget.atRest());
}

}  // namespace
}  // namespace halfsilver
