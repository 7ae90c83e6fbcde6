#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/renderer.h>
#include <halfsilver/scene.h>
#include <halfsilver/settings.h>
#include <halfsilver/target.h>

// trace.method=auto: of the methods that make no errors, the one that is the fastest for a scene on a device.
namespace halfsilver {

struct MethodTime {
  std::string method;
  double milliseconds = 0;  // of a frame, the least of a few, once the structure is built
};

struct MethodChoice {
  std::string method;                // a name of methods()
  std::string reason;                // one line, for people
  std::vector<MethodTime> measured;  // empty if there was nothing to measure
};

// The same method in use takes this much longer before another one takes its place.
inline constexpr double kMethodHysteresis = 1.1;

struct CalibrationInputs {
  Camera camera;
  Settings settings;
  Target target;
  std::string_view present = {};  // the method in use, see kMethodHysteresis
  // Called before each measured frame with its number, if it is not empty: moves what will move, so that what it takes
  // to keep up is measured, too.
  std::function<void(int)> advance = {};
};

// Draws up to four frames with each candidate, the first of which builds its structure. On a software rasterizer there
// is nothing to measure if CPU rays are at hand: they take a fraction of the time. The renderer holds a scene;
// afterwards it has none of the structures that it had. Throws as Renderer::render().
MethodChoice chooseMethod(Renderer& renderer, const CalibrationInputs& inputs);

}  // namespace halfsilver
