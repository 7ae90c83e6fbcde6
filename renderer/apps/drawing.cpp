#include "apps/drawing.h"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <utility>

#include <halfsilver/error.h>
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

void checkErrors(const gl::Api& api) {
  if (const GLenum error = api.GetError(); error != GL_NO_ERROR)
    throw Error(ErrorKind::failed, "OpenGL reports an error while drawing (" + std::to_string(error) + ")");
}

Context openContext(const std::string& kind, const std::string& device, std::vector<std::string>& warnings) {
  Context context = makeContext(contextKind(kind), {.device = device});
  if (!context.passedOver().empty())
    warnings.push_back("drawn on another device than the first, which makes no context (" + context.passedOver() + ")");
  return context;
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

void keepFreedMemory() {
#ifdef M_TRIM_THRESHOLD
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

void addWarnings(const std::vector<std::string>& from, std::vector<std::string>& to) {
  for (const std::string& warning : from)
    if (std::find(to.begin(), to.end(), warning) == to.end()) to.push_back(warning);
}

void SampleReports::add(FrameReport report) {
  for (const StageTime& time : report.times) {
    auto known = std::find_if(sums_.begin(), sums_.end(), [&](const Sum& sum) { return sum.stage == time.stage; });
    if (known == sums_.end()) known = sums_.insert(sums_.end(), {.stage = time.stage});
    ++known->runs;
    if (time.milliseconds < 0) continue;
    ++known->accepted;
    known->milliseconds += time.milliseconds;
  }
  report.overflow += joined_.overflow;
  for (std::size_t kind = 0; kind < report.rays.size(); ++kind) report.rays[kind] += joined_.rays[kind];
  report.lostFragments += joined_.lostFragments;
  std::vector<std::string> warnings = std::move(joined_.warnings);
  addWarnings(report.warnings, warnings);
  joined_ = std::move(report);
  joined_.warnings = std::move(warnings);
}

FrameReport SampleReports::joined() const {
  FrameReport report = joined_;
  report.times.clear();
  for (const Sum& sum : sums_)
    report.times.push_back({sum.stage, sum.accepted ? sum.milliseconds * sum.runs / sum.accepted : -1});
  return report;
}

namespace {

FrameReport drawPasses(Renderer& renderer, const Camera& camera, Settings settings, const Target& target,
                       const PassSteps& steps) {
  const int all = settings.effect.passes;
  settings.effect.progressive = true;
  renderer.forgetHistory();
  SampleReports reports;
  for (int done = 0; done < all;) {
    settings.effect.passes = std::min(steps.every, all - done);
    renderer.render(camera, settings, target);
    reports.add(renderer.report());
    done += settings.effect.passes;
    if (done < all && steps.shown) steps.shown(done);
  }
  return reports.joined();
}

}  // namespace

FrameReport drawPicture(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                        int samples, const PassSteps& steps) {
  if (samples == 1 && steps.every > 0 && steps.every < settings.effect.passes)
    return drawPasses(renderer, camera, settings, target, steps);
  if (samples == 1) {
    renderer.render(camera, settings, target);
    return renderer.report();
  }
  renderer.forgetHistory();
  SampleReports reports;
  for (int sample = samples - 1; sample >= 0; --sample) {
    renderer.refine(camera, settings, target, static_cast<std::uint32_t>(sample));
    reports.add(renderer.report());
  }
  return reports.joined();
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
                   FrameReport& report, int samples, const PassSteps& steps) {
  int drawn = 0;
  std::vector<StageTime> shadow;
  do {
    renderer.forgetHistory();
    // Once anything was lost, single frames find the sizes.
    if (drawn > 0 && samples > 1) settle(renderer, camera, settings, target);
    report = drawPicture(renderer, camera, settings, target, samples, steps);
    // Only the very first one draws shadow maps.
    for (const StageTime& time : report.times)
      if (time.stage == "shadow" && drawn == 0) shadow.push_back(time);
    ++drawn;
  } while (report.lostFragments > 0 && drawn < kMaxFirstFrames);
  if (drawn > 1) report.times.insert(report.times.end(), shadow.begin(), shadow.end());
  return drawn;
}

}  // namespace halfsilver
