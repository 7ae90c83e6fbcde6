#pragma once

#include <CLI/CLI.hpp>

// Each function adds one command to the program; the command runs at the end of the parse and throws Error.
namespace halfsilver {

void addRenderCommand(CLI::App& program);
void addTuneCommand(CLI::App& program);
void addInfoCommand(CLI::App& program);
void addCompareCommand(CLI::App& program);
void addPresetsCommand(CLI::App& program);
void addDemoCommand(CLI::App& program);

// Parses and runs the one command that the arguments name; returns the exit code. An error is one line on stderr.
int runCommand(CLI::App& program, int argc, const char* const* argv);

}  // namespace halfsilver
