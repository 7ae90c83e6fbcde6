#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <halfsilver/gl/texture.h>
#include "apps/demo/frame_log.h"
#include "apps/demo/options.h"
#include "apps/demo/overlay.h"
#include "apps/demo/play.h"
#include "apps/demo/scene_view.h"

namespace halfsilver::demo {

double millisecondsSince(std::chrono::steady_clock::time_point start);

// What is played, drawn by one or two renderers. A window or a file shows it.
class Session {
 public:
  using Proc = std::function<Renderer::Proc(const char*)>;
  Session(const gl::Api& api, Proc getProcAddress, int threads);

  // Plays something else, and draws it at that size. If that fails, throws Error, and what was played before goes on.
  void play(std::unique_ptr<Play> next, const Size& size, const Options& options);
  Play& playing() { return *play_; }
  SceneView& view() { return *view_; }

  // Time passes, and the scene is posed and uploaded.
  void advance(const Controls& controls, double seconds);
  // After a change that the player made.
  void update(const SceneChange& change);
  // Draws a window's picture at a share of its size. Returns what it took; `report` is the latest one that has arrived,
  // unless `wait`.
  FrameFigures draw(const Size& window, double scale, const Options& options, bool wait);
  double diagonal() const { return diagonal_; }  // of all that the scene does, meters
  // What the player should know, a line each.
  std::vector<std::string> status(const Options& options) const;
  // The structure's cells over the picture, if the options ask for them. Waits for the GPU.
  std::vector<Segment> cells(const Options& options) const;
  // What to show, in the order of drawing. Valid until the next draw().
  std::span<const Backdrop> backdrops() const { return backdrops_; }
  std::vector<std::uint8_t> read() const;  // the same, RGBA with rows from the top; waits for the GPU

 private:
  Settings settingsOf(const Settings& chosen, const Options& options) const;
  SceneView& second();
  void showFalseColors(const Size& size, const Camera& camera, const Options& options);

  const gl::Api* api_;
  Proc getProcAddress_;
  int threads_;
  std::unique_ptr<Play> play_;
  std::unique_ptr<SceneView> view_, second_;  // after what they refer to
  gl::Texture falseColors_;
  std::vector<std::uint8_t> colors_;  // of falseColors_; empty while the picture is shown
  std::vector<Backdrop> backdrops_;
  FrameReport report_;
  int frame_ = 0;
  double diagonal_ = 0;
};

}  // namespace halfsilver::demo
