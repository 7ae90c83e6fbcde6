#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/model.h>
#include <halfsilver/pose.h>
#include <halfsilver/renderer.h>
#include <halfsilver/settings.h>
#include "apps/arguments.h"
#include "apps/scene_input.h"

// The options of every command that draws a view of a scene.
namespace halfsilver {

// As given on the command line, unchecked.
struct ViewRequest {
  std::string scene;
  std::string size = "960x540";
  std::string camera, eye, target;
  std::optional<double> fov, time;
  std::string animation, variant;
  bool loop = true;
  std::vector<std::string> mirrors, lights, set;
  std::string sky, preset, config;
  std::optional<int> bounces;
  std::string context = "auto";
  std::string device;  // see ContextOptions::device
  int threads = 0;
};

// Adds SCENE and the options to a command. The request must outlive it.
void addViewOptions(CLI::App& command, ViewRequest& request);

// The parts of a request that can be checked without the scene.
struct ViewArguments {
  Size size;
  CameraRequest camera;
  std::vector<MirrorArgument> mirrors;
  std::vector<LightArgument> lights;
};

// Throws Error (usage).
ViewArguments checkView(const ViewRequest& request);

// Defaults, then preset or file.
Settings baseSettings(const ViewRequest& request);
// The same with trace.method=auto if nothing says otherwise: neither a preset, nor a file, nor a setting of a method's
// structure.
Settings programSettings(const ViewRequest& request);
// --set, then --bounces: what the user names individually comes last.
void applyOverrides(Settings& settings, const ViewRequest& request);

// Loads the scene with its mirrors, added lights and sky, at rest. Throws Error (badInput; usage for an unknown
// material).
Model loadModel(const ViewRequest& request, const ViewArguments& arguments);

// A scene and the pose that is drawn of it.
struct PosedView {
  Model model;                                  // at rest
  std::optional<PoseState> state;               // nothing: the rest
  Bounds bounds;                                // of what is drawn: with a pose, of all that the animations do
  std::optional<AnimatedBounds> animated = {};  // if they had to be found
  float sizeAtRest = 0;                         // diagonal, as it was loaded; 0 until keepOriginNear() asks for it
};

// With the pose at --time, if that is given. Throws Error: as loadModel(), and usage for an unknown animation.
PosedView loadView(const ViewRequest& request, const ViewArguments& arguments);

// As in the pose; if the scene has none and none is asked for, one that shows the bounds.
Camera chooseCamera(const PosedView& view, const CameraRequest& request);

// Poses it as the animations do at a time, beyond their ends in another loop or at the last pose.
void poseView(PosedView& view, std::span<const int> animations, double seconds, bool loop);

// If the camera has gone far from the origin with what it shows, puts the origin there: floats would show otherwise.
// Returns whether it did, and the scene has to be shown again.
bool keepOriginNear(PosedView& view, const CameraRequest& request);

// Uploads the scene. It is posed on the GPU, or where scene.posing says.
void show(const PosedView& view, Renderer& renderer);

// The animations that the request plays; warns if there are none although a time is asked for.
std::vector<int> chooseAnimations(const ViewRequest& request, Model& model);

}  // namespace halfsilver
