#include "apps/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include <halfsilver/error.h>
#include "apps/commands.h"

namespace halfsilver {
namespace {

int report(const CLI::App& program, ErrorKind kind, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << program.get_name() << ": " << message << std::endl;
  return static_cast<int>(kind);
}

}  // namespace

int runCommand(CLI::App& program, int argc, const char* const* argv) {
  program.set_version_flag("--version", version());
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 1 failed while working, 2 wrong usage, 3 bad scene or configuration, "
      "4 no usable OpenGL context.");
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);  // --help, --version
  } catch (const CLI::ParseError& error) {
    return report(program, ErrorKind::usage, error.what());
  } catch (const Error& error) {
    return report(program, error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return report(program, ErrorKind::failed, "out of memory");
  } catch (const std::exception& error) {
    return report(program, ErrorKind::failed, error.what());
  }
  std::cout.flush();
  return std::cout ? 0 : report(program, ErrorKind::failed, "cannot write to standard output");
}

const char* version() { return HALFSILVER_VERSION; }

int runProgram(int argc, const char* const* argv) {
  CLI::App program("Deferred rendering with selective ray-traced reflections on OpenGL 4.5; needs no display.",
                   "halfsilver");
  addRenderCommand(program);
  addTuneCommand(program);
  addInfoCommand(program);
  addCompareCommand(program);
  addPresetsCommand(program);
  addDemoCommand(program);
  return runCommand(program, argc, argv);
}

}  // namespace halfsilver
