#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/arguments.h"
#include "apps/scene_input.h"

// What the command line asks of a mode; most options are the same for all.
namespace halfsilver::bench {

constexpr const char* kDefaultPreset = "halfsilver";
constexpr const char* kReference = "reference";

struct Request {
  std::vector<std::string> scenes;  // as `halfsilver render` names them
  std::string folder;
  Size size;
  bool quick = false;
  std::string context = "auto";
  std::vector<std::string> mirrors;  // MATERIAL=REFLECTIVITY or SCENE:MATERIAL=REFLECTIVITY
  CameraRequest camera;              // for one scene; otherwise each scene's own
  std::vector<ViewArgument> views;   // scenes by sceneName()
  std::vector<std::string> presets;  // none: the mode's own
  std::vector<std::string> methods;  // of stability; none: all
  double timeLimit = 20;             // of scaling; seconds, above 0
};

// Those of the request, or these.
std::vector<std::string> chosenPresets(const Request& request, const std::vector<std::string>& otherwise);

// How outputs call a scene: "builtin:sphere", or the file's name without its folder.
std::string sceneName(const std::string& scene);

// The texts of the options that checkRequest() makes values of.
struct RequestTexts {
  std::string size, eye, target;
  std::vector<std::string> views;
};

// Adds what all modes take; both must outlive the command.
void addRequestOptions(CLI::App& command, Request& request, RequestTexts& texts);
// Throws Error (usage).
void checkRequest(Request& request, const RequestTexts& texts);

}  // namespace halfsilver::bench
