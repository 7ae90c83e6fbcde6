#include "apps/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "apps/commands.h"
#include "core/error.h"

namespace halfsilver {
namespace {

int report(ErrorKind kind, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "halfsilver: " << message << std::endl;
  return static_cast<int>(kind);
}

}  // namespace

int runProgram(int argc, const char* const* argv) {
  CLI::App program("Rasterization with selective ray-traced reflections, without a display.", "halfsilver");
  program.set_version_flag("--version", HALFSILVER_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 1 failed while working, 2 wrong usage, 3 bad scene or configuration, "
      "4 no usable GL context.");
  addRenderCommand(program);
  addInfoCommand(program);
  addCompareCommand(program);
  addPresetsCommand(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return program.exit(asked);  // --help, --version
  } catch (const CLI::ParseError& error) {
    return report(ErrorKind::usage, error.what());
  } catch (const Error& error) {
    return report(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return report(ErrorKind::failed, "out of memory");
  } catch (const std::exception& error) {
    return report(ErrorKind::failed, error.what());
  }
  std::cout.flush();
  return std::cout ? 0 : report(ErrorKind::failed, "the standard output cannot be written");
}

}  // namespace halfsilver
