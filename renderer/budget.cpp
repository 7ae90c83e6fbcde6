#include <halfsilver/budget.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include <halfsilver/shared_structs.h>

namespace halfsilver {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

// Shares of the time: frames are brought to `kAim` and left alone from `kMuchRoom` to 1.
constexpr double kAim = 0.88;
constexpr double kMuchRoom = 0.75;
constexpr int kLeastPatience = 3, kMostPatience = 48;  // frames
constexpr double kMostGrowth = 2;                      // of the rays, at once
constexpr double kLeastGrowth = 1.0 / 64;              // of the available pixels: none at all cannot double
constexpr double kMostKept = 0.95;                     // of the rays of a frame that took too long
constexpr double kClose = 1.15;     // rays that do not fit over rays that do: nothing to be found between them
constexpr double kOtherView = 0.1;  // change of the available pixels
constexpr double kClassesPerOctave = CONTRIBUTION_CLASSES / CONTRIBUTION_OCTAVES;

double timeOf(const FrameReport& report, std::string_view stage) {
  double sum = 0;
  for (const StageTime& time : report.times)
    if (time.stage == stage) sum += std::max(0.0, time.milliseconds);
  return sum;
}

// At a place between 0 and the number of classes.
double contributionAt(double place) {
  return std::min(1.0, std::exp2(place / kClassesPerOctave - CONTRIBUTION_OCTAVES));
}

// Class 0 holds what adds nothing at all.
double countAbove(std::span<const std::uint32_t> contributions, float least) {
  double count = 0;
  for (std::size_t i = 1; i < contributions.size(); ++i)
    if (contributionAt(static_cast<double>(i) + 1) > static_cast<double>(least)) count += contributions[i];
  return count;
}

}  // namespace

struct Budget::Frame {
  double rays = 0, time = 0, buildTime = 0, traceTime = 0, bytes = 0;

  // Of all that does not follow the number of rays.
  double fixedTime() const { return time - buildTime - traceTime; }
};

Budget::Budget(const BudgetLimits& limits)
    : limits_(limits), minContribution_(limits.leastContribution), patience_(kLeastPatience), tooMany_(kUnknown) {}

void Budget::learn(const FrameReport& report) {
  // An answer of the timer that was rejected teaches nothing.
  for (const StageTime& time : report.times)
    if (time.milliseconds < 0) return;
  const Frame frame{static_cast<double>(report.selected), timeOf(report, "frame"),
                    timeOf(report, "voxelize") + timeOf(report, "build"), timeOf(report, "trace"),
                    static_cast<double>(report.memory.structureTotal)};
  const double available = countAbove(report.contributions, limits_.leastContribution);
  noteView(available);
  const float lowest = lowestThreshold(report);
  dropped_ = minContribution_ > limits_.leastContribution
                 ? static_cast<std::uint64_t>(std::max(0.0, available - frame.rays))
                 : 0;
  held_ = frame.time <= limits_.milliseconds && frame.bytes <= limits_.bytes;
  forget_ = false;
  double rays = std::min(raysInTime(frame), raysInMemory(frame));
  if (held_)
    rays = raysWithRoom(frame, minContribution_ > lowest);
  else
    calm_ = 0;
  fresh_ = forget_;

  const float before = minContribution_;
  if (rayless_)
    minContribution_ = limits_.leastContribution;
  else if (rays < frame.rays)
    minContribution_ = std::max(before, contributionThreshold(report.contributions, rays));
  else if (rays > frame.rays)
    minContribution_ =
        rays >= available_ ? lowest : std::clamp(contributionThreshold(report.contributions, rays), lowest, before);
  if (minContribution_ > before && rose_) patience_ = std::min(2 * patience_, kMostPatience);
  if (minContribution_ != before) rose_ = minContribution_ < before;
  const bool helpless = !held_ && (rayless_ || frame.rays == 0) && slow_ != 1;
  atRest_ = minContribution_ == before && (helpless || (held_ && calm_ == 0));
}

// Where pixels have been dropped, those that add nothing do not come back.
float Budget::lowestThreshold(const FrameReport& report) const {
  const bool idle = !report.contributions.empty() && report.contributions[0] > 0;
  return std::max(limits_.leastContribution, idle ? static_cast<float>(contributionAt(1)) : 0.0f);
}

void Budget::noteView(double available) {
  if (std::abs(available - available_) <= kOtherView * available_) return;
  available_ = available;
  fitting_ = 0;
  tooMany_ = kUnknown;
  rayless_ = false;
  patience_ = kLeastPatience;
}

double Budget::raysInTime(const Frame& frame) {
  if (frame.time <= limits_.milliseconds) {
    slow_ = 0;
    return frame.rays;
  }
  const bool builtOnce = slow_++ == 0 && frame.time - frame.buildTime <= limits_.milliseconds;
  if (builtOnce) return frame.rays;
  const double share = (kAim * limits_.milliseconds - frame.fixedTime()) / (frame.buildTime + frame.traceTime);
  return frame.rays * (share > 0 ? std::min(share, kMostKept) : 0.0);
}

double Budget::raysInMemory(const Frame& frame) {
  if (frame.bytes <= limits_.bytes) {
    fitting_ = std::max(fitting_, frame.rays);
    return frame.rays;
  }
  // A structure that is too large without any ray does not become smaller for the lack of them.
  rayless_ = rayless_ || (fresh_ && frame.rays == 0);
  if (rayless_) return frame.rays;
  forget_ = true;
  if (!fresh_) return frame.rays;  // perhaps it is what other views have left
  tooMany_ = std::min(tooMany_, frame.rays);
  if (fitting_ >= tooMany_) fitting_ = 0;
  return fitting_ > 0 ? fitting_ : std::floor(frame.rays / kMostGrowth);
}

// For a frame within its limits.
double Budget::raysWithRoom(const Frame& frame, bool dropping) {
  const double leastMore = std::max(kClose * frame.rays, frame.rays + kLeastGrowth * available_);
  const bool room = dropping && frame.time < kMuchRoom * limits_.milliseconds && leastMore < tooMany_;
  calm_ = room ? calm_ + 1 : 0;
  if (calm_ < patience_) return frame.rays;
  calm_ = 0;
  const double rayTime = frame.buildTime + frame.traceTime;
  double growth = kMostGrowth;
  if (rayTime > 0) growth = std::min(growth, (kAim * limits_.milliseconds - frame.fixedTime()) / rayTime);
  double rays = std::max(frame.rays * growth, frame.rays + kLeastGrowth * available_);
  if (tooMany_ < kUnknown) rays = std::min(rays, std::sqrt(std::max(frame.rays, 1.0) * tooMany_));
  return rays;
}

float contributionThreshold(std::span<const std::uint32_t> contributions, double kept) {
  double above = 0;
  for (std::size_t i = contributions.size(); i-- > 0;) {
    const double count = contributions[i];
    if (above + count > kept) {
      const double upperPart = i > 0 ? std::max(0.0, kept - above) / count : 0;  // class 0 goes as a whole
      return static_cast<float>(contributionAt(static_cast<double>(i) + 1 - upperPart));
    }
    above += count;
  }
  return 0;
}

}  // namespace halfsilver
