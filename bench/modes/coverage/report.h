#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/modes/coverage/curves.h"
#include "bench/report/charts/chart.h"
#include "bench/report/page.h"
#include "bench/report/table.h"

// The curves of the mode `coverage` as tables, charts and the body of its page.
namespace halfsilver::bench {

Table coverageCsv(const CoverageCurves& curves);      // plain numbers, one row per point
Table fitsCsv(const CoverageCurves& curves);          // one row per curve and quantity
Table coverageSummary(const CoverageCurves& curves);  // for a terminal
PanelGrid coverageChart(const CoverageCurves& curves);
std::string coverageBody(const CoverageCurves& curves, const std::vector<Figure>& pictures,
                         const std::optional<std::string>& svg);

// Cells that several tables share; empty if the fit has none.
std::string rSquaredText(const CoverageFit& fit);
std::string smallShareText(const CoverageFit& fit);

}  // namespace halfsilver::bench
