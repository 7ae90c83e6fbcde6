#pragma once

#include <optional>
#include <string>

#include "apps/view_request.h"

// The interface of the module halfsilver_demo, which the command line opens when `demo` is asked for: the only part
// that knows GLFW and Dear ImGui. Both sides are built together, so C++ types may cross the boundary; the name has C
// linkage.
namespace halfsilver::demo {

inline constexpr const char* kModule = "libhalfsilver_demo.so";
inline constexpr const char* kRunFunction = "halfsilver_demo_run";

struct Request {
  ViewRequest view;  // an empty scene: the game
  std::string record, replay, screenshot, stats;
  std::optional<int> frames;           // draw so many and end; without a window unless `window`
  int fps = 30;                        // frames per second of the fixed time step
  std::optional<double> frameTime;     // milliseconds that the controller holds
  std::optional<double> contentScale;  // in place of the display's
  std::string show, cells;             // names of View and Cells; empty: the picture, none
  std::string split;                   // a preset or a method that draws the right side; empty: no split screen
  bool window = false, overlay = false;
  bool sized = false;  // view.size was asked for: it is in pixels whatever the display's content scale
};

// Plays until the end; throws nothing. The outcome is an exit code and, unless it is 0, one line.
struct Outcome {
  int exitCode = 0;
  std::string message;
};
using Run = void(const Request&, Outcome&);

}  // namespace halfsilver::demo
