#include "bench/modes/pareto/front.h"

#include <algorithm>

#include "apps/pareto.h"
#include "apps/statistics.h"
#include "bench/harness/request.h"

namespace halfsilver::bench {
namespace {

Spread spreadOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  return {median(values), *min, *max};
}

std::size_t sharedRounds(const ParetoVariant& a, const ParetoVariant& b) {
  return std::min(a.frames.size(), b.frames.size());
}

bool beats(const ParetoVariant& a, const ParetoVariant& b, Accuracy accuracy) {
  if (sharedRounds(a, b) == 0 || *errorOf(a, accuracy) > *errorOf(b, accuracy)) return false;
  const Spread ratio = pairedRatio(a, b);
  return ratio.max < 1 && ratio.median <= 1 - kParetoNoise;
}

}  // namespace

std::vector<ParetoScene> paretoScenes(const std::vector<ParetoPoint>& points) {
  std::vector<ParetoScene> scenes;
  for (const ParetoPoint& point : points) {
    auto scene = std::find_if(scenes.begin(), scenes.end(),
                              [&](const ParetoScene& candidate) { return candidate.name == point.scene.file; });
    if (scene == scenes.end()) scene = scenes.insert(scene, {point.scene.file, {}});
    auto& variants = scene->variants;
    auto variant = std::find_if(variants.begin(), variants.end(),
                                [&](const ParetoVariant& candidate) { return candidate.name == point.preset; });
    if (variant == variants.end()) {
      variant = variants.insert(variant, {point.preset, point.family, point.knob, point.beside, {}, {}, point});
      if (point.errors) variant->errors = *point.errors;
    }
    variant->frames.push_back(point.times.frame.median);
  }
  return scenes;
}

Spread frameTime(const ParetoVariant& variant) { return spreadOf(variant.frames); }

Spread pairedRatio(const ParetoVariant& variant, const ParetoVariant& other) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < sharedRounds(variant, other); ++i) ratios.push_back(variant.frames[i] / other.frames[i]);
  return spreadOf(ratios);
}

std::optional<double> errorOf(const ParetoVariant& variant, Accuracy accuracy) {
  const ParetoErrors& errors = variant.errors;
  if (accuracy == Accuracy::picture) return errors.perceptible ? errors.perceptible : errors.rmse;
  // Tracing less means being wrong about fewer rays, which is no merit.
  return errors.share < 1 ? std::nullopt : errors.hitError;
}

bool competes(const ParetoVariant& variant, Accuracy accuracy) {
  return variant.beside.empty() && errorOf(variant, accuracy);
}

std::optional<std::size_t> defaultOf(const ParetoScene& scene) {
  for (std::size_t i = 0; i < scene.variants.size(); ++i)
    if (scene.variants[i].name == kDefaultPreset) return i;
  return std::nullopt;
}

std::vector<std::size_t> frontOf(const ParetoScene& scene, Accuracy accuracy) {
  std::vector<std::size_t> competitors;
  std::vector<Cost> costs;
  for (std::size_t i = 0; i < scene.variants.size(); ++i) {
    if (!competes(scene.variants[i], accuracy)) continue;
    competitors.push_back(i);
    costs.push_back({frameTime(scene.variants[i]).median, 0, *errorOf(scene.variants[i], accuracy)});
  }
  std::vector<std::size_t> front;
  for (const std::size_t i : paretoFront(costs)) front.push_back(competitors[i]);
  return front;
}

bool onFront(const ParetoScene& scene, std::size_t variant, Accuracy accuracy) {
  const std::vector<std::size_t> front = frontOf(scene, accuracy);
  return std::find(front.begin(), front.end(), variant) != front.end();
}

std::optional<std::size_t> beatenBy(const ParetoScene& scene, std::size_t variant, Accuracy accuracy) {
  std::optional<std::size_t> best;
  if (!competes(scene.variants[variant], accuracy)) return best;
  for (std::size_t i = 0; i < scene.variants.size(); ++i) {
    const ParetoVariant& other = scene.variants[i];
    if (!competes(other, accuracy) || !beats(other, scene.variants[variant], accuracy)) continue;
    if (!best || frameTime(other).median < frameTime(scene.variants[*best]).median) best = i;
  }
  return best;
}

}  // namespace halfsilver::bench
