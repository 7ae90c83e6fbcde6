#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/arguments.h"
#include "apps/scene_input.h"

namespace CLI {
class App;
}

// What the command line asks for. Most options are the same for all modes.
namespace halfsilver::bench {

constexpr const char* kDefaultPreset = "halfsilver";
constexpr const char* kReference = "reference";

struct Request {
  std::vector<std::string> scenes;  // as `halfsilver render` names them
  std::string folder;
  Size size;
  bool sizeGiven = false;  // not a default
  bool quick = false;
  std::string context = "auto";
  std::vector<std::string> mirrors;  // MATERIAL=REFLECTIVITY or SCENE:MATERIAL=REFLECTIVITY
  CameraRequest camera;              // for one scene; otherwise each scene's own
  std::vector<ViewArgument> views;   // each scene is a sceneName()
  std::vector<std::string> presets;  // empty: the mode's own
  std::vector<std::string> methods;  // of stability; empty: all
  std::string replay;                // of demo
  std::optional<int> frames;         // of demo; default: the mode's
  double frameTime = 0;              // of demo; milliseconds to hold, 0: full quality
  std::string paper;                 // of paper: a paper's name, or "all"
  std::string sceneFolder;           // of paper: may hold sponza.glb
  double timeLimit = 20;             // of scaling; seconds, above 0
};

// The presets of the request, or `otherwise` if it names none.
std::vector<std::string> chosenPresets(const Request& request, const std::vector<std::string>& otherwise);

// A scene's name in all outputs: "builtin:sphere", or the file's name without its folder.
std::string sceneName(const std::string& scene);

// Texts of the options that checkRequest() parses.
struct RequestTexts {
  std::string size, eye, target;
  std::vector<std::string> views;
};

// Adds the options of all modes; request and texts must outlive the command.
void addRequestOptions(CLI::App& command, Request& request, RequestTexts& texts);
// For a command that plays a recording of the game: takes SCENE and what belongs to scenes away.
void addReplayOptions(CLI::App& command, Request& request);
// For a command that measures what papers have published: takes SCENE and what belongs to scenes away.
void addPaperOptions(CLI::App& command, Request& request);
// Parses the texts into the request. Throws Error (usage).
void checkRequest(Request& request, const RequestTexts& texts);

}  // namespace halfsilver::bench
