#pragma once

#include "bench/modes/mode.h"

namespace halfsilver::bench {

// `paper NAME|all`: the tables and figures of the papers, their numbers beside those measured here: paper.csv,
// paper.json and the page.
Mode paperMode();

}  // namespace halfsilver::bench
