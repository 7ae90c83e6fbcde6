#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/model.h>
#include <halfsilver/scene_change.h>
#include "apps/arguments.h"
#include "apps/demo/frame_log.h"
#include "apps/demo/options.h"

struct GLFWwindow;
struct ImGuiContext;

namespace halfsilver::demo {

class Viewer;

// A line over the picture, in shares of its width and height from the upper left corner.
struct Segment {
  glm::vec2 from, to;
  std::uint32_t color;  // ABGR
};

// What the overlay shows and changes.
struct OverlayState {
  Options& options;
  const FrameLog& log;
  Model& model;
  Viewer* viewer = nullptr;                // null: the game is on
  std::optional<std::uint32_t> material;   // that the player clicked
  std::string message;                     // of the last problem
  std::string controller;                  // what holds the frame time
  std::vector<std::string> status;         // of the play
  std::span<const Segment> segments = {};  // over the picture
  bool gamepad = false;                    // is connected
  bool resized = false;                    // so panels go back to their places; set by layOut()
};

// A picture behind the overlay, over a part of the window.
struct Backdrop {
  unsigned texture = 0;
  float from = 0, to = 1;  // shares of the width
  bool topDown = false;    // row 0 is the top
};

// Dear ImGui over the picture, sized for the display's scale. One at a time.
class Overlay {
 public:
  // `window` null: without one, for screenshots. Needs a current context.
  Overlay(GLFWwindow* window, double scale);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  void setScale(double scale);  // the font is made again, so that it stays crisp
  bool wantsMouse() const;
  bool wantsKeys() const;

  // Lays a frame out: returns what the player changed of the scene.
  SceneChange layOut(const Size& size, double seconds, std::span<const Backdrop> backdrops, OverlayState& state);
  // A bar instead of a picture, while something takes long.
  void layOutProgress(const Size& size, const std::string& what, float done);
  void draw() const;  // into the framebuffer that is bound

 private:
  void begin(const Size& size, double seconds);

  GLFWwindow* window_;
  ImGuiContext* context_;
  double scale_ = 1;
  glm::vec2 area_{0};  // that was laid out last
};

}  // namespace halfsilver::demo
