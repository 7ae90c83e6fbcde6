#include "apps/view_request.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>

namespace halfsilver {

void addViewOptions(CLI::App& command, ViewRequest& request) {
  command.add_option("SCENE", request.scene, kSceneHelp)->required();
  command.add_option("--size", request.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  command.add_option("--camera", request.camera, "Name or index of a camera of the scene (default: the first)");
  command.add_option("--eye", request.eye, "X,Y,Z in world coordinates: place the camera here; needs --target");
  command.add_option("--target", request.target, "X,Y,Z in world coordinates: the point that the camera looks at");
  command.add_option("--fov", request.fov, "Vertical field of view in degrees, with --eye or a camera of the scene");
  command.add_option("--time", request.time, "Pose the scene at this time of its animations, in seconds");
  command.add_option("--animation", request.animation,
                     "Play this animation, by name or index, or all that move different things (default: all)");
  command.add_flag("--loop,!--hold", request.loop,
                   "Beyond the end of an animation: start it again, without drift (default), or hold its last pose");
  command.add_option("--variant", request.variant, kVariantHelp);
  command
      .add_option("--mirror", request.mirrors,
                  "MATERIAL=REFLECTIVITY: turn a material into a mirror; * for all materials")
      ->allow_extra_args(false);
  command.add_option("--light", request.lights, kLightHelp)->allow_extra_args(false);
  command.add_option("--sky", request.sky, "Use an equirectangular image (HDR, EXR) as the sky");
  CLI::Option* preset = command.add_option("--preset", request.preset, "Start from a preset (see: halfsilver presets)");
  command.add_option("--config", request.config, "Start from the settings in a .toml file")->excludes(preset);
  command.add_option("--set", request.set, "section.key=value: change one setting; can be repeated")
      ->allow_extra_args(false);
  command.add_option("--bounces", request.bounces, "Maximum number of reflections along a path (trace.bounces)")
      ->check(CLI::Range(1, 16));
  command.add_option("--context", request.context, "How to create the OpenGL context: auto, egl, osmesa")
      ->check(CLI::IsMember({"auto", "egl", "osmesa"}))
      ->capture_default_str();
  command.add_option("--device", request.device,
                     "Draw on this device: its number or a part of its name (see: halfsilver info --device)");
  command.add_option("--threads", request.threads, "Threads of the exact tracer (default: one per core)")
      ->check(CLI::Range(1, 1024));
}

ViewArguments checkView(const ViewRequest& request) {
  ViewArguments arguments{parseSize(request.size), {request.camera, {}, {}, request.fov}, {}, {}};
  if (!request.eye.empty()) arguments.camera.eye = parseVector("--eye", request.eye);
  if (!request.target.empty()) arguments.camera.target = parseVector("--target", request.target);
  for (const std::string& text : request.mirrors) arguments.mirrors.push_back(parseMirror(text));
  for (const std::string& text : request.lights) arguments.lights.push_back(parseLight(text));
  return arguments;
}

Settings baseSettings(const ViewRequest& request) {
  Settings settings;
  if (!request.preset.empty()) applyPreset(settings, request.preset);
  if (!request.config.empty()) applySettingsFile(settings, request.config);
  return settings;
}

Settings programSettings(const ViewRequest& request) {
  Settings settings = baseSettings(request);
  const auto ofStructure = [](const std::string& text) {
    const std::string name = parseSetting(text).name;
    const auto infos = methods();
    return std::any_of(infos.begin(), infos.end(), [&name](const MethodInfo& info) {
      return std::find(info.settings.begin(), info.settings.end(), name) != info.settings.end();
    });
  };
  if (request.preset.empty() && request.config.empty() &&
      std::none_of(request.set.begin(), request.set.end(), ofStructure))
    settings.trace.method = "auto";
  return settings;
}

void applyOverrides(Settings& settings, const ViewRequest& request) {
  for (const std::string& text : request.set) {
    const SettingArgument argument = parseSetting(text);
    set(settings, argument.name, argument.value);
  }
  if (request.bounces) set(settings, "trace.bounces", std::to_string(*request.bounces));
}

Model loadModel(const ViewRequest& request, const ViewArguments& arguments) {
  Model model = loadScene(request.scene, request.variant);
  applyMirrors(model.scene, arguments.mirrors);
  addLights(model, arguments.lights);
  if (!request.sky.empty()) {
    if (const std::size_t repaired = readSky(request.sky, model.scene.sky))
      model.warnings.push_back(request.sky + ": " + std::to_string(repaired) +
                               " values that are not a number or outside 0..65504 were clamped");
  }
  return model;
}

std::vector<int> chooseAnimations(const ViewRequest& request, Model& model) {
  if (model.rig.animations.empty()) model.warnings.emplace_back("the scene has no animation: its time has no effect");
  return chooseAnimations(model.rig, request.animation, model.warnings);
}

PosedView loadView(const ViewRequest& request, const ViewArguments& arguments) {
  if (!request.time && !request.animation.empty())
    throw Error(ErrorKind::usage, "--animation needs --time or --frames");
  PosedView view{loadModel(request, arguments), {}, {}};
  view.bounds = view.model.scene.bounds();
  if (request.time)
    poseView(view, chooseAnimations(request, view.model), *request.time, request.loop);
  else if (!(view.bounds.diagonal() > 0))
    view.bounds = animatedBounds(view.model).all;  // what is a point or nothing at rest is framed as it will be
  return view;
}

void poseView(PosedView& view, std::span<const int> animations, double seconds, bool loop) {
  view.state = evaluate(view.model.rig, playTogether(animations, seconds, loop));
  if (!view.animated) view.animated = animatedBounds(view.model);
  view.bounds = view.animated->all;
}

Camera chooseCamera(const PosedView& view, const CameraRequest& request) {
  std::vector<Camera> cameras = view.model.scene.cameras;
  if (view.state)
    for (std::size_t i = 0; i < cameras.size(); ++i) cameras[i] = posedCamera(view.model, *view.state, i);
  return chooseCamera(cameras, view.bounds, view.model.scene.origin, request);
}

bool keepOriginNear(PosedView& view, const CameraRequest& request) {
  constexpr double kFar = 32;  // sizes of the scene at rest, as where a file's origin is chosen
  if (!view.state) return false;
  // Far away its vertices are rounded.
  if (view.sizeAtRest == 0) view.sizeAtRest = view.model.scene.bounds().diagonal();
  const double size = static_cast<double>(view.sizeAtRest);
  const Camera camera = chooseCamera(view, request);
  if (!(size > 0) || glm::length(glm::dvec3(camera.eye)) <= kFar * size) return false;
  const glm::dvec3 eye = view.model.scene.origin + glm::dvec3(camera.eye);
  const std::optional<glm::dvec3> near = nearestPosed(view.model, *view.state, eye);
  if (!near || glm::distance(*near, view.model.scene.origin) <= kFar * size) return false;
  const double step = std::exp2(std::ceil(std::log2(size)));
  moveOrigin(view.model, glm::round(*near / step) * step);
  view.animated = animatedBounds(view.model);
  view.bounds = view.animated->all;
  return true;
}

void show(const PosedView& view, Renderer& renderer) {
  if (!view.state) return renderer.setScene(view.model.scene);
  renderer.setModel(view.model, *view.animated);
  renderer.pose(*view.state);
}

}  // namespace halfsilver
