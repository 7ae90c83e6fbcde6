#include "apps/drawing.h"

#include <algorithm>
#include <span>
#include <vector>

#if HALFSILVER_EXACT
#include <halfsilver/exact.h>
#endif

namespace halfsilver {
namespace {

// The first draw compiles shaders, and some methods size their pool by the previous frame.
constexpr int kMaxFirstFrames = 4;

// Times of several frames together, stage by stage. Rejected ones count as the mean of the others.
class StageSums {
 public:
  void add(std::span<const StageTime> times) {
    for (const StageTime& time : times) {
      auto known = std::find_if(sums_.begin(), sums_.end(), [&](const Sum& sum) { return sum.stage == time.stage; });
      if (known == sums_.end()) known = sums_.insert(sums_.end(), {.stage = time.stage});
      ++known->runs;
      if (time.milliseconds < 0) continue;
      ++known->accepted;
      known->milliseconds += time.milliseconds;
    }
  }
  std::vector<StageTime> all() const {
    std::vector<StageTime> times;
    for (const Sum& sum : sums_)
      times.push_back({sum.stage, sum.accepted ? sum.milliseconds * sum.runs / sum.accepted : -1});
    return times;
  }

 private:
  struct Sum {
    std::string stage;
    double milliseconds = 0;
    int runs = 0, accepted = 0;
  };
  std::vector<Sum> sums_;
};

}  // namespace

ContextKind contextKind(const std::string& name) {
  if (name == "egl") return ContextKind::egl;
  return name == "osmesa" ? ContextKind::osmesa : ContextKind::automatic;
}

TracerFactory exactFactory(const Scene& scene, int threads) {
#if HALFSILVER_EXACT
  return makeExactTracerFactory(scene, threads);
#else
  static_cast<void>(scene);
  static_cast<void>(threads);
  return {};
#endif
}

FrameReport drawPicture(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                        int samples) {
  if (samples == 1) {
    renderer.render(camera, settings, target);
    return renderer.report();
  }
  renderer.forgetHistory();
  FrameReport report;
  StageSums times;
  std::uint64_t overflow = 0, lostFragments = 0;
  for (int sample = samples - 1; sample >= 0; --sample) {
    renderer.refine(camera, settings, target, static_cast<std::uint32_t>(sample));
    report = renderer.report();
    times.add(report.times);
    overflow += report.overflow;
    lostFragments += report.lostFragments;
  }
  report.times = times.all();
  report.overflow = overflow;
  report.lostFragments = lostFragments;
  return report;
}

namespace {

void settle(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target) {
  for (int drawn = 0; drawn < kMaxFirstFrames; ++drawn) {
    renderer.render(camera, settings, target);
    if (renderer.report().lostFragments == 0) return;
  }
}

}  // namespace

int drawFirstFrame(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                   FrameReport& report, int samples) {
  int drawn = 0;
  std::vector<StageTime> shadow;
  do {
    renderer.forgetHistory();
    // Once anything was lost, single frames find the sizes.
    if (drawn > 0 && samples > 1) settle(renderer, camera, settings, target);
    report = drawPicture(renderer, camera, settings, target, samples);
    // Only the very first one draws shadow maps.
    for (const StageTime& time : report.times)
      if (time.stage == "shadow" && drawn == 0) shadow.push_back(time);
    ++drawn;
  } while (report.lostFragments > 0 && drawn < kMaxFirstFrames);
  if (drawn > 1) report.times.insert(report.times.end(), shadow.begin(), shadow.end());
  return drawn;
}

}  // namespace halfsilver
