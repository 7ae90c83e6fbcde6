#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/modes/pareto/front.h"
#include "bench/report/charts/chart.h"
#include "bench/report/page.h"
#include "bench/report/table.h"

// The scenes of the mode `pareto` as tables, charts and the body of its page.
namespace halfsilver::bench {

using ParetoScenes = std::span<const ParetoScene>;

Table paretoCsv(ParetoScenes scenes);      // plain numbers, one row per variant
Table paretoSummary(ParetoScenes scenes);  // for a terminal
ScatterGrid paretoChart(ParetoScenes scenes);
std::string paretoBody(ParetoScenes scenes, const std::vector<Figure>& pictures, const std::optional<std::string>& svg);

// Radius of a mark: grows by the same amount for each tenfold memory from 1 MB on.
double markRadius(double bytes);

// Where the default stands, one sentence per accuracy.
std::vector<std::string> paretoVerdicts(const ParetoScene& scene);

// What tables and the chart call things.
const char* accuracyName(Accuracy accuracy, ParetoScenes scenes);
bool perceptionKnown(ParetoScenes scenes);  // whether the project is built with OpenImageIO
// "on the front", "within the noise", or what beats the variant at that place.
std::string standing(const ParetoScene& scene, std::size_t at, Accuracy accuracy);
std::string optionalPercent(const std::optional<double>& share);

}  // namespace halfsilver::bench
