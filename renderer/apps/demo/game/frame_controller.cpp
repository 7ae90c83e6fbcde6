#include "apps/demo/game/frame_controller.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace halfsilver::demo {
namespace {

constexpr std::size_t kRemembered = 9, kEnough = 3;             // frames
constexpr double kAim = 0.9;                                    // share of the limit that the typical frame may take
constexpr int kPatience = 12, kMaxPatience = 200, kTrial = 40;  // frames

const std::vector<FrameQuality>& levels() {
  static const std::vector<FrameQuality> all = [] {
    std::vector<FrameQuality> made{{1, 1}, {1, 0.75}};
    for (int percent = 100; percent >= 25; percent -= 5) made.push_back({percent / 100.0, 0.5});
    made.push_back({0.25, 0.25});
    return made;
  }();
  return all;
}

// What pixels and rays cost beside those of full quality, about.
double work(int level) {
  const FrameQuality& quality = levels()[static_cast<std::size_t>(level)];
  return quality.scale * quality.scale * (0.5 + 0.5 * quality.share);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

FrameController::FrameController(double milliseconds) : target_(milliseconds), patience_(kPatience) {}

const FrameQuality& FrameController::quality() const { return levels()[static_cast<std::size_t>(level_)]; }

double FrameController::typical() const { return median({times_.begin(), times_.end()}); }

double FrameController::expected(int level) const {
  const double middle = typical();
  std::vector<double> off;
  for (const double time : times_) off.push_back(std::abs(time - middle));
  return fixed_ + (middle + 0.75 * median(off) - fixed_) * work(level) / work(level_);
}

void FrameController::learnFixedPart() {
  learnt_ = true;
  const double now = work(level_), before = work(levelBefore_);
  if (std::abs(now - before) < 0.1 * before) return;
  const double fixed = (timeBefore_ * now - typical() * before) / (now - before);
  fixed_ = std::clamp(fixed, 0.0, 0.9 * std::min(typical(), timeBefore_));
}

void FrameController::learn(double milliseconds) {
  if (!(milliseconds > 0) || !std::isfinite(milliseconds)) return;
  if (settling_ > 0) {
    --settling_;
    return;
  }
  times_.push_back(milliseconds);
  if (times_.size() > kRemembered) times_.pop_front();
  if (times_.size() < kEnough) return;
  if (!learnt_) learnFixedPart();
  fixed_ = std::min(fixed_, 0.9 * typical());
  const int worst = static_cast<int>(levels().size()) - 1;
  int level = level_;
  const double now = expected(level_), aim = kAim * target_;
  ++sinceRise_;
  if (now > 1.04 * aim && level_ < worst) {
    while (level < worst && expected(level) > aim) ++level;
    if (sinceRise_ < kTrial) patience_ = std::min(2 * patience_, kMaxPatience);
    roomy_ = 0;
  } else if (level_ > 0 && expected(level_ - 1) < aim) {
    if (++roomy_ >= patience_) {
      while (level > 0 && expected(level - 1) < aim) --level;
      level = level_ - std::max(1, (level_ - level) / 2);  // half the way at once
      roomy_ = sinceRise_ = 0;
    }
  } else {
    roomy_ = 0;
    if (sinceRise_ > 4 * kTrial) patience_ = kPatience;
  }
  if (level == level_) return;
  timeBefore_ = typical();
  levelBefore_ = level_;
  learnt_ = false;
  level_ = level;
  times_.clear();
  settling_ = 1;
}

std::string FrameController::say() const {
  std::array<char, 96> text{};
  const double time = times_.empty() ? timeBefore_ : typical();
  std::snprintf(text.data(), text.size(), "scale %.2f, %.0f %% of the reflections, %.0f ms of %.0f ms", quality().scale,
                100 * quality().share, time, target_);
  return text.data();
}

}  // namespace halfsilver::demo
