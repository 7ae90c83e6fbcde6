#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/modes/scaling/series.h"
#include "bench/report/charts/chart.h"
#include "bench/report/page.h"
#include "bench/report/table.h"

// The curves of the mode `scaling` as tables, charts and the body of its page.
namespace halfsilver::bench {

Table scalingCsv(const ScalingSeries& series);    // plain numbers, one row per point
Table exponentsCsv(const ScalingSeries& series);  // one row per curve and quantity
Table exponentsTable(const ScalingSeries& series);
Table limitsTable(const ScalingSeries& series, double timeLimit);  // where each preset stops, and how
PanelGrid scalingChart(const ScalingSeries& series);
std::string scalingBody(const ScalingSeries& series, const std::vector<Figure>& pictures, double timeLimit,
                        const std::optional<std::string>& svg);

std::string shortNumber(double value);    // "31.6k", "10M", "3.13"
std::string secondsText(double seconds);  // as short as possible

}  // namespace halfsilver::bench
