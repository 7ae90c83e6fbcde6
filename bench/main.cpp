#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "bench/coverage.h"
#include "bench/memory.h"
#include "bench/request.h"
#include "bench/stability.h"

int main(int argc, char** argv) {
  CLI::App program("Measures Halfsilver's methods against each other.", "halfsilver-bench");
  halfsilver::bench::addMode(program, "memory", "What each method's structure takes, and how wrong its hits are",
                             halfsilver::bench::runMemory);
  halfsilver::bench::addMode(program, "coverage", "What a frame costs as more and more of the screen is traced",
                             halfsilver::bench::runCoverage, halfsilver::bench::addPresetOption);
  halfsilver::bench::addMode(program, "stability", "Where each method fails, still and in motion",
                             halfsilver::bench::runStability, halfsilver::bench::addStabilityOptions);
  return halfsilver::runCommand(program, argc, argv);
}
