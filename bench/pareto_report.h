#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/chart.h"
#include "bench/report.h"
#include "bench/table.h"

// The points of the mode `pareto` as tables, charts and the text of its page.
namespace halfsilver::bench {

constexpr double kParetoSeconds = 30;  // measured frames of a variant and scene; see roundsFor()

struct Spread {
  double median = 0, least = 0, most = 0;
};

// One variant in one scene, all rounds together.
struct ParetoPoint {
  std::string name, family, knob;
  std::string beside;          // why it does not compete with the others; empty where it does
  std::vector<double> frames;  // milliseconds, a round each
  double bytes = 0;            // of the structure
  double rays = 0;             // share of the reference's rays that it traced
  std::optional<double> hitError;
  std::optional<double> perceptible;  // nothing without OpenImageIO
  double rmse = 0;                    // display values 0..1
  nlohmann::ordered_json measured;    // in the first round
};

struct ParetoScene {
  std::string name;
  std::vector<ParetoPoint> points;
};

enum class Accuracy {
  hits,    // hit_error, of variants that trace all rays
  picture  // share of perceptible pixels; root mean square where that is unknown
};

// In the order in which scenes and variants occur first.
std::vector<ParetoScene> paretoScenes(const PointList& points);

Spread frameTime(const ParetoPoint& point);  // milliseconds
// Frame times as multiples of another's in the same round, where both were drawn.
Spread pairedRatio(const ParetoPoint& point, const ParetoPoint& other);

// The front of the medians: those competing that no other beats. Indices, by time.
std::vector<std::size_t> frontOf(const ParetoScene& scene, Accuracy accuracy);

// The fastest competitor with no more error that was faster in every round, and by more than noise; nothing where there
// is none.
std::optional<std::size_t> beatenBy(const ParetoScene& scene, std::size_t point, Accuracy accuracy);

// Radius of a mark: grows by the same for each tenfold memory from 1 MB on.
double markRadius(double bytes);

// Where the default stands, a sentence for each accuracy.
std::vector<std::string> paretoVerdicts(const ParetoScene& scene);

Table paretoCsv(std::span<const ParetoScene> scenes);      // plain numbers, one row a variant
Table paretoSummary(std::span<const ParetoScene> scenes);  // for a terminal
ScatterGrid paretoChart(std::span<const ParetoScene> scenes);
std::string paretoBody(std::span<const ParetoScene> scenes, const std::vector<ScenePicture>& pictures,
                       const std::optional<std::string>& svg);

}  // namespace halfsilver::bench
