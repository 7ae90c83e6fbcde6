#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/modes/pareto/point.h"

// Which variants of the mode `pareto` are worth having.
namespace halfsilver::bench {

constexpr double kParetoSeconds = 30;  // measured frames per variant and scene; see roundsFor()
constexpr double kParetoNoise = 0.05;  // share of a frame's time; smaller differences do not count

struct Spread {
  double median = 0, min = 0, max = 0;
};

// One variant in one scene, all rounds together.
struct ParetoVariant {
  std::string name, family, knob;
  std::string beside;          // why it does not compete with the others; empty if it does
  std::vector<double> frames;  // milliseconds, one per round
  ParetoErrors errors;         // those of the first round, as every frame is the same
  ParetoPoint first;           // the first round

  double bytes() const { return static_cast<double>(first.memory.structureTotal); }
};

struct ParetoScene {
  std::string name;
  std::vector<ParetoVariant> variants;
};

enum class Accuracy {
  hits,    // share of wrong hits, of variants that trace all rays
  picture  // share of perceptible pixels; root mean square if that is unknown
};
inline constexpr std::array kAccuracies = {Accuracy::hits, Accuracy::picture};

// In order of first occurrence.
std::vector<ParetoScene> paretoScenes(const std::vector<ParetoPoint>& points);

Spread frameTime(const ParetoVariant& variant);  // milliseconds
// Frame times over another's in the same round, for the rounds in which both were drawn.
Spread pairedRatio(const ParetoVariant& variant, const ParetoVariant& other);

// Nothing if the variant cannot be judged by it.
std::optional<double> errorOf(const ParetoVariant& variant, Accuracy accuracy);
bool competes(const ParetoVariant& variant, Accuracy accuracy);
std::optional<std::size_t> defaultOf(const ParetoScene& scene);

// The front of the medians: competing variants that no other beats. Indices, by time.
std::vector<std::size_t> frontOf(const ParetoScene& scene, Accuracy accuracy);

bool onFront(const ParetoScene& scene, std::size_t variant, Accuracy accuracy);

// The fastest competing variant that is at least as accurate and was faster in every round, by more than noise; nothing
// if there is none.
std::optional<std::size_t> beatenBy(const ParetoScene& scene, std::size_t variant, Accuracy accuracy);

}  // namespace halfsilver::bench
