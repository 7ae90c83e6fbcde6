#include <halfsilver/budget.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include <halfsilver/shared_structs.h>

namespace halfsilver {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

// Shares of the time limit: frames are brought to `kTargetShare` and left alone from `kRoomShare` to 1.
constexpr double kTargetShare = 0.88;
constexpr double kRoomShare = 0.75;
constexpr int kMinPatience = 3, kMaxPatience = 48;  // frames
constexpr double kMaxGrowth = 2;                    // of the rays, per step
constexpr double kMinGrowth = 1.0 / 64;             // of the available pixels: zero rays cannot double
constexpr double kMaxKept = 0.95;                   // of the rays of a frame that took too long
constexpr double kMinGain = 1.15;                   // of the rays: a smaller step is not worth a change
constexpr double kViewChange = 0.1;                 // of the available pixels
constexpr double kClassesPerOctave = static_cast<double>(CONTRIBUTION_CLASSES) / CONTRIBUTION_OCTAVES;

double timeOf(const FrameReport& report, std::string_view stage) {
  double sum = 0;
  for (const StageTime& time : report.times)
    if (time.stage == stage) sum += std::max(0.0, time.milliseconds);
  return sum;
}

// The contribution at the lower end of a class; fractions lie inside it.
double contributionAt(double index) {
  return std::min(1.0, std::exp2(index / kClassesPerOctave - CONTRIBUTION_OCTAVES));
}

// Class 0 holds what contributes nothing at all.
double countAbove(std::span<const std::uint32_t> contributions, float threshold) {
  double count = 0;
  for (std::size_t i = 1; i < contributions.size(); ++i)
    if (contributionAt(static_cast<double>(i) + 1) > static_cast<double>(threshold)) count += contributions[i];
  return count;
}

}  // namespace

struct Budget::Frame {
  double rays = 0, time = 0, buildTime = 0, traceTime = 0, bytes = 0;

  // Of everything that does not depend on the number of rays.
  double fixedTime() const { return time - buildTime - traceTime; }
};

Budget::Budget(const BudgetLimits& limits)
    : limits_(limits), minContribution_(limits.minContribution), patience_(kMinPatience), minExcessRays_(kUnknown) {}

void Budget::learn(const FrameReport& report) {
  // Nothing can be learned from a time that was rejected.
  for (const StageTime& time : report.times)
    if (time.milliseconds < 0) return;
  const Frame frame{static_cast<double>(report.selected), timeOf(report, "frame"),
                    timeOf(report, "voxelize") + timeOf(report, "build"), timeOf(report, "trace"),
                    static_cast<double>(report.memory.structureTotal)};
  const double available = countAbove(report.contributions, limits_.minContribution);
  noteView(available);
  const float lowest = lowestThreshold(report);
  dropped_ = minContribution_ > limits_.minContribution
                 ? static_cast<std::uint64_t>(std::max(0.0, available - frame.rays))
                 : 0;
  held_ = frame.time <= limits_.milliseconds && frame.bytes <= limits_.bytes;
  forgetStructures_ = false;
  double rays = std::min(raysInTime(frame), raysInMemory(frame));
  if (held_)
    rays = raysWithRoom(frame, minContribution_ > lowest);
  else
    roomyFrames_ = 0;
  builtForItself_ = forgetStructures_;

  const float before = minContribution_;
  if (overWithoutRays_)
    minContribution_ = limits_.minContribution;
  else if (rays < frame.rays)
    minContribution_ = std::max(before, contributionThreshold(report.contributions, rays));
  else if (rays > frame.rays)
    minContribution_ = rays >= availablePixels_
                           ? lowest
                           : std::clamp(contributionThreshold(report.contributions, rays), lowest, before);
  if (minContribution_ > before && pixelsCameBack_) patience_ = std::min(2 * patience_, kMaxPatience);
  if (minContribution_ != before) pixelsCameBack_ = minContribution_ < before;
  const bool helpless = !held_ && (overWithoutRays_ || frame.rays == 0) && slowFrames_ != 1;
  atRest_ = minContribution_ == before && (helpless || (held_ && roomyFrames_ == 0));
}

// Once pixels have been dropped, those that contribute nothing do not come back.
float Budget::lowestThreshold(const FrameReport& report) const {
  const bool idle = !report.contributions.empty() && report.contributions[0] > 0;
  return std::max(limits_.minContribution, idle ? static_cast<float>(contributionAt(1)) : 0.0f);
}

void Budget::noteView(double available) {
  if (std::abs(available - availablePixels_) <= kViewChange * availablePixels_) return;
  availablePixels_ = available;
  maxFittingRays_ = 0;
  minExcessRays_ = kUnknown;
  overWithoutRays_ = false;
  patience_ = kMinPatience;
}

double Budget::raysInTime(const Frame& frame) {
  if (frame.time <= limits_.milliseconds) {
    slowFrames_ = 0;
    return frame.rays;
  }
  const bool builtOnce = slowFrames_++ == 0 && frame.time - frame.buildTime <= limits_.milliseconds;
  if (builtOnce) return frame.rays;
  const double share = (kTargetShare * limits_.milliseconds - frame.fixedTime()) / (frame.buildTime + frame.traceTime);
  return frame.rays * (share > 0 ? std::min(share, kMaxKept) : 0.0);
}

double Budget::raysInMemory(const Frame& frame) {
  if (frame.bytes <= limits_.bytes) {
    maxFittingRays_ = std::max(maxFittingRays_, frame.rays);
    return frame.rays;
  }
  // Fewer rays cannot shrink a structure that is too large even without rays.
  overWithoutRays_ = overWithoutRays_ || (builtForItself_ && frame.rays == 0);
  if (overWithoutRays_) return frame.rays;
  forgetStructures_ = true;
  if (!builtForItself_) return frame.rays;  // other views may have left too much behind
  minExcessRays_ = std::min(minExcessRays_, frame.rays);
  if (maxFittingRays_ >= minExcessRays_) maxFittingRays_ = 0;
  return maxFittingRays_ > 0 ? maxFittingRays_ : std::floor(frame.rays / kMaxGrowth);
}

// For a frame within the limits.
double Budget::raysWithRoom(const Frame& frame, bool dropping) {
  const double minRays = std::max(kMinGain * frame.rays, frame.rays + kMinGrowth * availablePixels_);
  const bool room = dropping && frame.time < kRoomShare * limits_.milliseconds && minRays < minExcessRays_;
  roomyFrames_ = room ? roomyFrames_ + 1 : 0;
  if (roomyFrames_ < patience_) return frame.rays;
  roomyFrames_ = 0;
  const double rayTime = frame.buildTime + frame.traceTime;
  double growth = kMaxGrowth;
  if (rayTime > 0) growth = std::min(growth, (kTargetShare * limits_.milliseconds - frame.fixedTime()) / rayTime);
  double rays = std::max(frame.rays * growth, frame.rays + kMinGrowth * availablePixels_);
  if (minExcessRays_ < kUnknown) rays = std::min(rays, std::sqrt(std::max(frame.rays, 1.0) * minExcessRays_));
  return rays;
}

PassBudget::PassBudget(double milliseconds, const EffectSettings& wanted)
    : milliseconds_(milliseconds),
      samples_(wanted.samples),
      most_(wanted.samples * wanted.passes),
      rays_(most_),
      patience_(kMinPatience) {}

int PassBudget::passes() const { return std::max(1, rays_ / samples_); }
int PassBudget::samples() const { return std::min(rays_, samples_); }

void PassBudget::learn(const FrameReport& report) {
  // Nothing can be learned from a time that was rejected.
  if (std::any_of(report.times.begin(), report.times.end(), [](const StageTime& t) { return t.milliseconds < 0; }))
    return;
  const double time = timeOf(report, "frame"), rayTime = timeOf(report, "trace") + timeOf(report, "shade");
  held_ = time <= milliseconds_;
  const bool room = held_ && rays_ < most_ && time < kRoomShare * milliseconds_;
  roomyFrames_ = room ? roomyFrames_ + 1 : 0;
  const int before = rays_;
  if (!held_ || roomyFrames_ >= patience_) {
    roomyFrames_ = 0;
    const double fitting =
        rayTime > 0 ? rays_ * (kTargetShare * milliseconds_ - (time - rayTime)) / rayTime : kMaxGrowth * rays_;
    const double limit = held_ ? kMaxGrowth * rays_ : kMaxKept * rays_;
    rays_ = static_cast<int>(std::clamp(fitting, 1.0, std::max(1.0, std::min<double>(limit, most_))));
    if (rays_ > samples_) rays_ -= rays_ % samples_;  // whole passes
  }
  if (rays_ < before && grew_) patience_ = std::min(2 * patience_, kMaxPatience);
  if (rays_ != before) grew_ = rays_ > before;
  atRest_ = rays_ == before && (held_ ? roomyFrames_ == 0 : rays_ == 1);
}

float contributionThreshold(std::span<const std::uint32_t> contributions, double kept) {
  double above = 0;
  for (std::size_t i = contributions.size(); i-- > 0;) {
    const double count = contributions[i];
    if (above + count > kept) {
      const double upperPart = i > 0 ? std::max(0.0, kept - above) / count : 0;  // class 0 is dropped as a whole
      return static_cast<float>(contributionAt(static_cast<double>(i) + 1 - upperPart));
    }
    above += count;
  }
  return 0;
}

}  // namespace halfsilver
