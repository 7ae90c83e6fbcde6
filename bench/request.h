#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "apps/arguments.h"
#include "apps/scene_input.h"

// What the command line asks of a mode; most options are the same for all.
namespace halfsilver::bench {

constexpr const char* kDefaultPreset = "halfsilver";

struct Request {
  std::vector<std::string> scenes;  // as `halfsilver render` names them
  std::string folder;
  Size size;
  bool quick = false;
  std::string context = "auto";
  std::vector<std::string> mirrors;  // MATERIAL=REFLECTIVITY
  CameraRequest camera;              // for one scene; otherwise each scene's own
  std::vector<std::string> presets;  // see addPresetOption()
};

// Adds a command to the program that checks its options and runs the mode at the end of the parse. `addOptions` adds
// what only this mode takes.
void addMode(CLI::App& program, const std::string& name, const std::string& description,
             std::function<void(const Request&)> run, const std::function<void(CLI::App&, Request&)>& addOptions = {});

// Which presets a mode measures; the default one where none is named.
void addPresetOption(CLI::App& command, Request& request);

// How outputs call a scene: "builtin:sphere", or the file's name without its folder.
std::string sceneName(const std::string& scene);

}  // namespace halfsilver::bench
