#include "bench/request.h"

#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "core/error.h"

namespace halfsilver::bench {
namespace {

constexpr const char* kSize = "960x540";
constexpr const char* kQuickSize = "160x90";

// The texts of the options that are checked after the parse.
struct Texts {
  std::string size, eye, target;
};

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorKind::usage, what); }

void check(Request& request, const Texts& texts) {
  request.size = parseSize(!texts.size.empty() ? texts.size : request.quick ? kQuickSize : kSize);
  if (!texts.eye.empty()) request.camera.eye = parseVector("--eye", texts.eye);
  if (!texts.target.empty()) request.camera.target = parseVector("--target", texts.target);
  for (const std::string& text : request.mirrors) parseMirror(text);
  const bool ownCamera = request.camera.eye || request.camera.target || request.camera.fov;
  if (request.scenes.size() > 1 && (ownCamera || !request.camera.name.empty()))
    reject("a camera of your own goes with one scene");
  std::set<std::string> names;
  for (const std::string& scene : request.scenes)
    if (!names.insert(sceneName(scene)).second) reject("two scenes have the name " + sceneName(scene));
  names.clear();
  for (const std::string& preset : request.presets)
    if (!names.insert(preset).second) reject(preset + " is to be measured twice");
}

}  // namespace

void addMode(CLI::App& program, const std::string& name, const std::string& description,
             std::function<void(const Request&)> run, const std::function<void(CLI::App&, Request&)>& addOptions) {
  CLI::App* command = program.add_subcommand(name, description);
  const auto shared = std::make_shared<std::pair<Request, Texts>>();
  auto& [request, texts] = *shared;
  command->add_option("SCENE", request.scenes, ".gltf or .glb files, or builtin:NAME")->required();
  command->add_option("-o,--output", request.folder, "Folder of the results; what it holds is not measured again")
      ->required();
  command->add_option("--size", texts.size,
                      std::string("WIDTHxHEIGHT in pixels (default: ") + kSize + ", quick: " + kQuickSize + ")");
  command->add_flag("--quick", request.quick, "Small pictures and coarse structures: to see that all works");
  command->add_option("--context", request.context, "Where OpenGL comes from: auto, egl, osmesa")
      ->check(CLI::IsMember({"auto", "egl", "osmesa"}))
      ->capture_default_str();
  command->add_option("--mirror", request.mirrors, "MATERIAL=REFLECTIVITY: a mirror of a material; * for all")
      ->allow_extra_args(false);
  command->add_option("--camera", request.camera.name, "Name or index of a camera of the scene (default: the first)");
  command->add_option("--eye", texts.eye, "X,Y,Z of a camera of your own, world coordinates; with --target");
  command->add_option("--target", texts.target, "X,Y,Z that it looks at");
  command->add_option("--fov", request.camera.fov, "Vertical field of view in degrees");
  if (addOptions) addOptions(*command, request);
  command->callback([shared, run = std::move(run)] {
    check(shared->first, shared->second);
    run(shared->first);
  });
}

void addPresetOption(CLI::App& command, Request& request) {
  request.presets = {kDefaultPreset};
  command.add_option("--preset", request.presets, "A preset to measure, repeatable (see: halfsilver presets)")
      ->allow_extra_args(false)
      ->capture_default_str();
}

std::string sceneName(const std::string& scene) {
  return scene.starts_with("builtin:") ? scene : std::filesystem::path(scene).filename().string();
}

}  // namespace halfsilver::bench
