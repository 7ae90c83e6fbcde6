#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "bench/coverage.h"
#include "bench/memory.h"
#include "bench/mode.h"
#include "bench/pareto.h"
#include "bench/scaling.h"
#include "bench/stability.h"

int main(int argc, char** argv) {
  using namespace halfsilver::bench;
  CLI::App program("Measures Halfsilver's methods against each other.", "halfsilver-bench");
  // In the order of the page that `all` makes.
  addModes(program, {memoryMode(), coverageMode(), paretoMode(), stabilityMode(), scalingMode()});
  return halfsilver::runCommand(program, argc, argv);
}
