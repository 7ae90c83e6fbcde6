#include "apps/drawing.h"

#if HALFSILVER_EXACT
#include <halfsilver/exact.h>
#endif

namespace halfsilver {
namespace {

// The first draw compiles shaders, and some methods size their pool by the previous frame.
constexpr int kMaxFirstFrames = 4;

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

int drawFirstFrame(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                   FrameReport& report) {
  int drawn = 0;
  std::vector<StageTime> shadow;
  do {
    renderer.render(camera, settings, target);
    report = renderer.report();
    // Only the very first one draws shadow maps.
    for (const StageTime& time : report.times)
      if (time.stage == "shadow" && drawn == 0) shadow.push_back(time);
    ++drawn;
  } while (report.lostFragments > 0 && drawn < kMaxFirstFrames);
  if (drawn > 1) report.times.insert(report.times.end(), shadow.begin(), shadow.end());
  return drawn;
}

}  // namespace halfsilver
