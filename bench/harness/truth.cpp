#include "bench/harness/truth.h"

#include <halfsilver/io.h>

namespace halfsilver::bench {

const Truth::Frame& Truth::of(const BenchScene& scene, SelectMode mode, int bounces) {
  if (scene_ != &scene) frames_.clear();
  scene_ = &scene;
  const std::pair key(mode, bounces);
  if (const auto known = frames_.find(key); known != frames_.end()) return known->second;
  Settings settings;
  applyPreset(settings, kReference);
  settings.select.mode = mode;
  settings.trace.bounces = bounces;
  RunStatistics run = bench_->describe(scene, settings);
  bench_->draw(scene, run);
  return frames_[key] = {bench_->layers(), bench_->picture()};
}

}  // namespace halfsilver::bench
