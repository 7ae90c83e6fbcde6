#include "apps/demo/start.h"

#include <algorithm>
#include <exception>
#include <new>
#include <span>
#include <string_view>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/demo/game_play.h"
#include "apps/demo/viewer.h"
#include "apps/drawing.h"

namespace halfsilver::demo {
namespace {

// Of the name that begins with the text.
int indexOf(const char* option, const std::string& text, std::span<const char* const> names) {
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::string_view(names[i]).starts_with(text)) return static_cast<int>(i);
    known += (i ? ", " : "") + std::string(names[i]);
  }
  throw Error(ErrorKind::usage, std::string(option) + " " + text + ": known are " + known);
}

// The request's settings with another preset or method.
Settings rightSide(const Request& request, const Settings& left) {
  const std::string& name = request.split;
  const std::vector<Preset> known = presets();
  Settings settings = left;
  if (std::any_of(known.begin(), known.end(), [&](const Preset& preset) { return preset.name == name; })) {
    settings = Settings();
    applyPreset(settings, name);
    applyOverrides(settings, request.view);
    return settings;
  }
  try {
    set(settings, "trace.method", name);
  } catch (const Error&) {
    throw Error(ErrorKind::usage, "--split " + name + ": there is no such preset or method");
  }
  return settings;
}

}  // namespace

std::unique_ptr<Play> makeViewer(const Request& request, const std::string& scene) {
  ViewRequest view = request.view;
  view.scene = scene;
  if (scene != request.view.scene) {  // these are of the scene on the command line
    view.animation.clear();
    view.variant.clear();
  }
  const ViewArguments arguments = checkView(view);
  PosedView loaded{loadModel(view, arguments), {}, {}};
  const std::vector<int> animations = chooseAnimations(loaded.model.rig, view.animation, loaded.model.warnings);
  poseView(loaded, animations, view.time.value_or(0), view.loop);
  const Camera camera = chooseCamera(loaded, arguments.camera);
  auto viewer = std::make_unique<Viewer>(std::move(loaded.model), camera, std::move(*loaded.animated));
  if (!view.animation.empty() && view.animation != "all") viewer->choose(animations.front());
  viewer->seconds = view.time.value_or(0);
  viewer->loop = view.loop;
  return viewer;
}

std::unique_ptr<Play> makePlay(const Request& request) {
  if (!request.view.scene.empty()) {
    if (!request.record.empty() || !request.replay.empty())
      throw Error(ErrorKind::usage, "demo: --record and --replay are for the game, without a SCENE");
    return makeViewer(request, request.view.scene);
  }
  if (!request.view.animation.empty()) throw Error(ErrorKind::usage, "demo: --animation needs a SCENE");
  GameInputs inputs;
  if (!request.replay.empty()) inputs.replay = readRecording(request.replay);
  inputs.autopilot = request.frames && !request.window;  // there is no player
  inputs.record = request.record;
  ViewRequest view = request.view;
  view.scene = "builtin:game";
  return std::make_unique<GamePlay>(loadModel(view, checkView(view)), std::move(inputs));
}

Options firstOptions(const Request& request) {
  Options options;
  options.settings = programSettings(request.view);
  applyOverrides(options.settings, request.view);
  options.other = options.settings;
  options.other.trace.method = options.settings.trace.method == "identity" ? "none" : "identity";
  options.frameTime = request.frameTime.value_or(0);
  options.split = !request.split.empty();
  if (options.split) options.other = rightSide(request, options.settings);
  if (!request.show.empty()) options.view = static_cast<View>(indexOf("--show", request.show, kViewNames));
  if (!request.cells.empty()) options.cells = static_cast<Cells>(indexOf("--cells", request.cells, kCellNames));
  return options;
}

}  // namespace halfsilver::demo

extern "C" void halfsilver_demo_run(const halfsilver::demo::Request& request, halfsilver::demo::Outcome& outcome) {
  using namespace halfsilver;
  try {
    keepFreedMemory();
    if (request.frames && !request.window)
      demo::runHeadless(request);
    else
      demo::runWindow(request);
  } catch (const Error& error) {
    outcome = {static_cast<int>(error.kind()), error.what()};
  } catch (const std::bad_alloc&) {
    outcome = {static_cast<int>(ErrorKind::failed), "out of memory"};
  } catch (const std::exception& error) {
    outcome = {static_cast<int>(ErrorKind::failed), error.what()};
  }
}
