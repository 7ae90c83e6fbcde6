#pragma once

#include <string>
#include <vector>

#include "bench/harness/output_folder.h"
#include "bench/modes/paper/published.h"
#include "bench/report/table.h"

namespace halfsilver::bench {

// One line per row and column of the papers' tables: the paper's number, the one measured here, and both over the row
// that ratios are taken over. Points are in the order of the rows.
Table paperCsv(const std::vector<Paper>& papers, const std::vector<PaperPoint>& points);

// The lines that have a number of the paper.
Table paperSummary(const std::vector<Paper>& papers, const std::vector<PaperPoint>& points);

// File name of a row's picture, see pictureFile().
std::string paperPicture(const Paper& paper, const PublishedRow& row);

std::string paperBody(const std::vector<Paper>& papers, const std::vector<std::string>& standIns,
                      const std::vector<PaperPoint>& points, const OutputFolder& folder);

}  // namespace halfsilver::bench
