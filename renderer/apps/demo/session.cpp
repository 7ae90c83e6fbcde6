#include "apps/demo/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "apps/demo/cell_lines.h"
#include "apps/demo/false_colors.h"

namespace halfsilver::demo {

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Session::Session(const gl::Api& api, Proc getProcAddress, int threads)
    : api_(&api), getProcAddress_(std::move(getProcAddress)), threads_(threads) {}

void Session::play(std::unique_ptr<Play> next, const Size& size, const Options& options) {
  auto view = std::make_unique<SceneView>(*api_, getProcAddress_, next->model(), next->bounds(), threads_);
  view->pose(next->poseState());
  view->draw(next->camera(), settingsOf(options.settings, options), size);
  backdrops_.clear();
  second_.reset();
  view_ = std::move(view);  // before the scene that the old one refers to goes
  play_ = std::move(next);
  diagonal_ = play_->bounds().all.diagonal();
}

SceneView& Session::second() {
  if (!second_) {
    second_ = std::make_unique<SceneView>(*api_, getProcAddress_, play_->model(), play_->bounds(), threads_);
    second_->pose(play_->poseState());
  }
  return *second_;
}

void Session::advance(const Controls& controls, double seconds) {
  play_->step(controls, seconds);
  update(play_->takeChange());
  view_->pose(play_->poseState());
  if (second_) second_->pose(play_->poseState());
}

void Session::update(const SceneChange& change) {
  if (!change.any()) return;
  view_->update(play_->model().scene, change);
  if (second_) second_->update(play_->model().scene, change);
}

Settings Session::settingsOf(const Settings& chosen, const Options& options) const {
  Settings settings = chosen;
  if (options.reference) settings.trace.method = "exact";
  settings.image.motion = options.view == View::motion;
  settings.trace.countWork = options.view == View::cost;
  if (options.view == View::cost) settings.trace.bounces = 1;
  // Exact rays count no steps and have no error: what is of interest is the method that a GPU would use.
  if ((options.view == View::cost || options.view == View::error) &&
      (settings.trace.method == "auto" || settings.trace.method == "exact"))
    settings.trace.method = "identity";
  return settings;
}

FrameFigures Session::draw(const Size& window, double scale, const Options& options, bool wait) {
  const auto start = std::chrono::steady_clock::now();
  const auto scaled = [scale](int pixels) { return std::max(1, static_cast<int>(std::lround(scale * pixels))); };
  const Size size{scaled(window.width), scaled(window.height)};
  const Camera camera = play_->camera();
  backdrops_.clear();
  colors_.clear();
  const bool drawn = view_->draw(camera, settingsOf(options.settings, options), size, options.samples);
  backdrops_ = {{view_->texture(), 0, options.split ? options.splitAt : 1, false}};
  if (options.split) {
    second().draw(camera, settingsOf(options.other, options), size, options.samples);
    backdrops_.push_back({second().texture(), options.splitAt, 1, false});
  }
  if (options.view != View::picture) showFalseColors(size, camera, options);
  if (wait)
    report_ = view_->renderer().report();
  else if (auto arrived = view_->renderer().arrivedReport())
    report_ = std::move(*arrived);
  return {frame_++, millisecondsSince(start), scale, options.settings.select.fraction, size.width, size.height,
          report_,  play_->status(),          drawn};
}

std::vector<Segment> Session::cells(const Options& options) const {
  if (options.cells == Cells::none) return {};
  const Size size = view_->size();
  return cellLines(view_->renderer().readStructure(), options.cells, play_->camera(),
                   static_cast<float>(size.width) / static_cast<float>(size.height));
}

std::vector<std::string> Session::status(const Options& options) const {
  std::vector<std::string> lines = play_->status();
  if (options.reference) lines.emplace_back("exact rays");
  if (options.view != View::picture) lines.emplace_back(legend(options.view));
  return lines;
}

std::vector<std::uint8_t> Session::read() const {
  if (!colors_.empty()) return colors_;
  std::vector<std::uint8_t> pixels = view_->read();
  if (backdrops_.size() < 2) return pixels;
  const std::vector<std::uint8_t> right = second_->read();
  const int width = view_->size().width;
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  const auto begin = 4 * static_cast<std::size_t>(std::lround(backdrops_[1].from * static_cast<float>(width)));
  for (std::size_t i = begin; i < pixels.size(); i += row)
    std::copy_n(right.begin() + static_cast<std::ptrdiff_t>(i), row - begin,
                pixels.begin() + static_cast<std::ptrdiff_t>(i));
  return pixels;
}

void Session::showFalseColors(const Size& size, const Camera& camera, const Options& options) {
  Image exact;
  if (options.view == View::error) {
    Settings settings = options.settings;
    settings.trace.method = "exact";
    second().draw(camera, settings, size);
    exact = second().renderer().readLayers();
  }
  const Image layers = view_->renderer().readLayers();
  colors_ = falseColors(options.view, layers, exact.width > 0 ? &exact : nullptr, diagonal_);
  if (!falseColors_ || falseColors_.shape().width != size.width || falseColors_.shape().height != size.height)
    falseColors_ = gl::Texture(*api_, {.format = GL_RGBA8, .width = size.width, .height = size.height}, "false colors");
  api_->TextureSubImage2D(falseColors_.name(), 0, 0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE,
                          colors_.data());
  backdrops_ = {{falseColors_.name(), 0, 1, true}};
}

}  // namespace halfsilver::demo
