#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "bench/modes/antialiasing/antialiasing.h"
#include "bench/modes/coverage/coverage.h"
#include "bench/modes/demo/demo.h"
#include "bench/modes/effects/effects.h"
#include "bench/modes/memory/memory.h"
#include "bench/modes/mode.h"
#include "bench/modes/paper/paper.h"
#include "bench/modes/pareto/pareto.h"
#include "bench/modes/scaling/scaling.h"
#include "bench/modes/speed/speed.h"
#include "bench/modes/stability/stability.h"

int main(int argc, char** argv) {
  using namespace halfsilver::bench;
  CLI::App program("Measures Halfsilver's methods against each other.", "halfsilver-bench");
  // In the order of the page that `all` makes.
  addModes(program, {memoryMode(), speedMode(), coverageMode(), paretoMode(), effectsMode(), stabilityMode(),
                     antialiasingMode(), scalingMode(), demoMode(), paperMode()});
  return halfsilver::runCommand(program, argc, argv);
}
