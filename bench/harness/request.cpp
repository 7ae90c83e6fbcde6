#include "bench/harness/request.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <set>

#include <halfsilver/error.h>

namespace halfsilver::bench {
namespace {

constexpr const char* kSize = "960x540";
constexpr const char* kQuickSize = "160x90";

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorKind::usage, what); }

// Throws Error (usage) if a name occurs twice.
void checkUnique(const std::vector<std::string>& names, const std::string& complaint) {
  std::set<std::string> seen;
  for (const std::string& name : names)
    if (!seen.insert(name).second) reject(name + ' ' + complaint);
}

// The view; its scene is a sceneName().
ViewArgument viewOf(const Request& request, const std::string& text) {
  ViewArgument view = parseView(text);
  const auto named = std::find_if(request.scenes.begin(), request.scenes.end(), [&](const std::string& scene) {
    return view.scene == scene || view.scene == sceneName(scene);
  });
  if (named == request.scenes.end()) reject("--view: there is no scene '" + view.scene + "' in this command");
  view.scene = sceneName(*named);
  return view;
}

void removeSceneOptions(CLI::App& command) {
  for (const char* name : {"SCENE", "--mirror", "--camera", "--eye", "--target", "--fov", "--view"})
    command.remove_option(command.get_option(name));
}

}  // namespace

void addRequestOptions(CLI::App& command, Request& request, RequestTexts& texts) {
  command.add_option("SCENE", request.scenes, ".gltf or .glb files, or builtin:NAME")->required();
  command
      .add_option("-o,--output", request.folder, "Folder for the results; what it already holds is not measured again")
      ->required();
  command.add_option("--size", texts.size,
                     std::string("WIDTHxHEIGHT in pixels (default: ") + kSize + ", quick: " + kQuickSize + ")");
  command.add_flag("--quick", request.quick, "Small pictures and coarse structures, to check that everything works");
  command.add_option("--context", request.context, "Where OpenGL comes from: auto, egl, osmesa")
      ->check(CLI::IsMember({"auto", "egl", "osmesa"}))
      ->capture_default_str();
  command
      .add_option(
          "--mirror", request.mirrors,
          "MATERIAL=REFLECTIVITY: turns a material into a mirror in every scene that has it, * for all materials; "
          "SCENE:MATERIAL=REFLECTIVITY for one scene")
      ->allow_extra_args(false);
  command.add_option("--camera", request.camera.name, "Name or index of a camera of the scene (default: the first)");
  command.add_option("--eye", texts.eye, "X,Y,Z of your own camera in world coordinates; needs --target");
  command.add_option("--target", texts.target, "X,Y,Z that your own camera looks at");
  command.add_option("--fov", request.camera.fov, "Vertical field of view in degrees");
  command
      .add_option("--view", texts.views,
                  "SCENE=EX,EY,EZ,TX,TY,TZ[,FOV]: eye, target and field of view for one of several scenes; repeatable")
      ->allow_extra_args(false);
}

void addReplayOptions(CLI::App& command, Request& request) {
  removeSceneOptions(command);
  command.add_option("REPLAY", request.replay, "What `halfsilver demo --record` wrote")->required();
  command.add_option("--frames", request.frames, "Frames to draw")->check(CLI::Range(1, 1000000));
  command
      .add_option(
          "--frame-time", request.frameTime,
          "Milliseconds per frame to hold by resolution and by the share of reflections (default: full quality)")
      ->check(CLI::PositiveNumber);
}

void addPaperOptions(CLI::App& command, Request& request) {
  removeSceneOptions(command);
  command.add_option("NAME", request.paper, "A paper, by the name of its preset, or all")->required();
  command
      .add_option("--scenes", request.sceneFolder,
                  "Folder that may hold sponza.glb (default: the environment's HALFSILVER_SCENES; without it "
                  "builtin:atrium stands for Sponza)")
      ->envname("HALFSILVER_SCENES");
}

void checkRequest(Request& request, const RequestTexts& texts) {
  request.sizeGiven = !texts.size.empty();
  request.size = parseSize(!texts.size.empty() ? texts.size : request.quick ? kQuickSize : kSize);
  if (!texts.eye.empty()) request.camera.eye = parseVector("--eye", texts.eye);
  if (!texts.target.empty()) request.camera.target = parseVector("--target", texts.target);
  for (const std::string& text : request.mirrors) parseMirror(text);
  std::vector<std::string> names, viewed;
  for (const std::string& scene : request.scenes) names.push_back(sceneName(scene));
  checkUnique(names, "is the name of two scenes");
  for (const std::string& text : texts.views) {
    request.views.push_back(viewOf(request, text));
    viewed.push_back(request.views.back().scene);
  }
  checkUnique(viewed, "has two views");
  const CameraRequest& camera = request.camera;
  if (camera.eye || camera.target || camera.fov || !camera.name.empty()) {
    if (request.scenes.size() > 1) reject("use --view to give a camera to one of several scenes");
    if (!request.views.empty()) reject("--view cannot be combined with the other camera options");
  }
  checkUnique(request.presets, "is given twice");
  checkUnique(request.methods, "is given twice");
}

std::vector<std::string> chosenPresets(const Request& request, const std::vector<std::string>& otherwise) {
  return request.presets.empty() ? otherwise : request.presets;
}

std::string sceneName(const std::string& scene) {
  return scene.starts_with("builtin:") ? scene : std::filesystem::path(scene).filename().string();
}

}  // namespace halfsilver::bench
