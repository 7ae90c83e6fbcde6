#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include <halfsilver/error.h>
#include <halfsilver/gl/api.h>
#include <halfsilver/io.h>
#include "apps/demo/frame_holder.h"
#include "apps/demo/game_play.h"
#include "apps/demo/outputs.h"
#include "apps/demo/session.h"
#include "apps/demo/start.h"
#include "apps/demo/viewer.h"
#include "apps/demo/window.h"

namespace halfsilver::demo {
namespace {

constexpr double kLongestStep = 0.1;  // seconds: after a stall the scene goes on, it does not jump
constexpr int kWarmUp = 3;            // frames before the first that is shown

// The program in its window.
class Interactive {
 public:
  explicit Interactive(const Request& request)
      : request_(request),
        options_(firstOptions(request)),
        window_(parseSize(request.view.size), !request.sized && !request.frames, "Halfsilver"),
        api_(gl::Api::load(window_.getProcAddress())),
        overlay_(window_.handle(), request.contentScale.value_or(window_.contentScale())),
        session_(api_, window_.getProcAddress(), request.view.threads) {
    if (!request.frames) load(configFolder(), options_);
    applyOverrides(options_.settings, request.view);
    window_.setVerticalSync(options_.verticalSync);
    good_ = options_;
    scene_ = request.view.scene;
  }

  void run() {
    showProgress("loading", 0.1f);
    session_.play(makePlay(request_), drawn(), options_);
    if (GamePlay* game = this->game()) game->bestSeconds = options_.bestSeconds;
    warmUp();
    RunOutputs outputs(request_);
    auto before = std::chrono::steady_clock::now();
    int frame = 0;
    while (window_.open() && (!request_.frames || frame < *request_.frames)) {
      window_.poll();
      const auto now = std::chrono::steady_clock::now();
      const double elapsed = std::min(kLongestStep, std::chrono::duration<double>(now - before).count());
      before = now;
      followScale();
      if (window_.visible()) {
        drawFrame(request_.frames || !request_.replay.empty() ? 1.0 / request_.fps : elapsed);
        outputs.add(log_.last());
        ++frame;
      }
      openDropped();
    }
    keepGame();
    if (request_.frames) outputs.commit(session_.view().size(), session_.read());
    if (!request_.frames) save(configFolder(), options_);
  }

 private:
  GamePlay* game() { return dynamic_cast<GamePlay*>(&session_.playing()); }
  Viewer* viewer() { return dynamic_cast<Viewer*>(&session_.playing()); }

  void keepGame() {
    session_.playing().finish();
    if (const GamePlay* game = this->game()) options_.bestSeconds = game->bestSeconds;
  }

  void clear() {
    const GLfloat black[4] = {0, 0, 0, 1};
    api_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    api_.ClearNamedFramebufferfv(0, GL_COLOR, 0, black);
  }

  void showProgress(const std::string& what, float done) {
    window_.poll();
    if (!window_.visible()) return;
    overlay_.layOutProgress(window_.size(), what, done);
    clear();
    overlay_.draw();
    window_.show();
  }

  // Compiles shaders and builds what the first frames need, so that play begins without a hitch.
  void warmUp() {
    for (int i = 0; i < kWarmUp; ++i) {
      showProgress("compiling shaders", static_cast<float>(1 + i) / (1 + kWarmUp));
      session_.draw(drawn(), 1, options_, true);
    }
  }

  Size drawn() const { return window_.visible() ? window_.size() : Size{1, 1}; }

  void followScale() {
    const double scale = request_.contentScale.value_or(window_.contentScale());
    if (scale == scale_) return;
    scale_ = scale;
    overlay_.setScale(scale);
  }

  void drawFrame(double seconds) {
    const Controls controls = window_.controls(overlay_.wantsMouse(), overlay_.wantsKeys());
    if (!overlay_.wantsKeys()) followKeys();
    if (Viewer* scene = viewer()) scene->setWindowHeight(window_.size().height);
    const auto start = std::chrono::steady_clock::now();
    session_.advance(controls, options_.frozen ? 0 : seconds);
    if (drawPicture(start)) followClicks(controls);
    const std::vector<Segment> cells = session_.cells(options_);
    OverlayState state{options_, log_,          session_.playing().model(), viewer(), clicked_,
                       message_, holder_.say(), session_.status(options_),  cells,    window_.hasGamepad()};
    const SceneChange change = overlay_.layOut(window_.size(), seconds, session_.backdrops(), state);
    clear();
    overlay_.draw();
    window_.show();
    session_.update(change);
  }

  // Settings that the device cannot draw are taken back; false if there is no picture of this frame.
  bool drawPicture(std::chrono::steady_clock::time_point start) {
    try {
      FrameFigures figures = session_.draw(window_.size(), holder_.scale(options_), holder_.options(options_), false);
      figures.wallMilliseconds = millisecondsSince(start);
      if (figures.drawn) {
        holder_.learn(figures);
        log_.add(figures);
      }
      good_ = options_;
      return true;
    } catch (const Error& error) {
      message_ = error.what();
      options_.settings = good_.settings;
      options_.other = good_.other;
      options_.view = View::picture;
      return false;
    }
  }

  void followClicks(const Controls& controls) {
    if (!controls.clicked) return;
    const Size size = session_.view().size(), window = window_.size();
    const int x = static_cast<int>(controls.pointer.x) * size.width / window.width;
    const int y = static_cast<int>(controls.pointer.y) * size.height / window.height;
    const std::optional<Picked> picked = session_.view().renderer().pick(x, size.height - 1 - y);
    const Scene& scene = session_.playing().model().scene;
    clicked_ = picked ? std::optional(scene.triangles[picked->triangle].material) : std::nullopt;
    if (picked && controls.doubleClicked) session_.playing().setPivot(picked->position);
  }

  void followKeys() {
    const auto toggle = [this](int key, bool& value) {
      if (window_.pressed(key)) value = !value;
    };
    toggle(GLFW_KEY_G, options_.overlay);
    toggle(GLFW_KEY_F1, options_.keys);
    toggle(GLFW_KEY_SPACE, options_.reference);
    toggle(GLFW_KEY_TAB, options_.split);
    toggle(GLFW_KEY_T, options_.frozen);
    if (Viewer* scene = viewer()) toggle(GLFW_KEY_P, scene->paused);
    for (int view = 0; view < static_cast<int>(std::size(kViewNames)); ++view)
      if (window_.pressed(GLFW_KEY_1 + view)) options_.view = static_cast<View>(view);
    if (window_.pressed(GLFW_KEY_B)) options_.cells = static_cast<Cells>((static_cast<int>(options_.cells) + 1) % 3);
    if (window_.pressed(GLFW_KEY_F))
      session_.playing().frame(posedBounds(session_.playing().model(), session_.playing().poseState(), clicked_));
    if (window_.pressed(GLFW_KEY_F11)) window_.toggleFullscreen();
    if (window_.pressed(GLFW_KEY_V)) {
      options_.verticalSync = !options_.verticalSync;
      window_.setVerticalSync(options_.verticalSync);
    }
    if (window_.pressed(GLFW_KEY_F12)) screenshot(window_.shift() ? 4 : 1);
    if (window_.pressed(GLFW_KEY_L)) saveLayers();
    if (window_.pressed(GLFW_KEY_RIGHT)) openNeighbor(1);
    if (window_.pressed(GLFW_KEY_LEFT)) openNeighbor(-1);
    if (window_.pressed(GLFW_KEY_ESCAPE)) window_.close();
  }

  // A name that no file has yet.
  static std::filesystem::path freeName(const char* extension) {
    for (int number = 1;; ++number) {
      std::filesystem::path name = "halfsilver-" + std::to_string(number) + extension;
      if (!std::filesystem::exists(name)) return name;
    }
  }

  // Says in the window what went wrong, or what was done. Returns whether it was.
  template <class Work>
  bool attempt(Work&& work) {
    try {
      message_ = work();
      return true;
    } catch (const std::exception& error) {
      message_ = error.what();
      return false;
    }
  }

  void screenshot(int times) {
    attempt([&] {
      const Size size{times * window_.size().width, times * window_.size().height};
      session_.draw(size, 1, options_, true);
      const std::filesystem::path name = freeName(".png");
      AtomicFile file(name);
      file.write(encodePng(size.width, size.height, session_.read()));
      file.commit();
      return "saved " + name.string();
    });
  }

  void saveLayers() {
    attempt([&] {
      const std::filesystem::path name = freeName(".exr");
      AtomicFile file(name);
      file.write(encodeExr(session_.view().renderer().readLayers(), session_.diagonal()));
      file.commit();
      return "saved " + name.string();
    });
  }

  bool open(const std::string& scene) {
    return attempt([&] {
      showProgress("loading " + scene, 0.3f);
      std::unique_ptr<Play> next = makeViewer(request_, scene);
      keepGame();
      session_.play(std::move(next), drawn(), options_);
      scene_ = scene;
      clicked_.reset();
      warmUp();
      return std::string();
    });
  }

  void openNeighbor(int step) {
    const std::vector<std::filesystem::path> files = neighbors(scene_);
    if (files.empty()) return;
    const auto present = std::find(files.begin(), files.end(), std::filesystem::absolute(scene_));
    const auto count = static_cast<std::ptrdiff_t>(files.size());
    const std::ptrdiff_t index = present == files.end() ? 0 : (present - files.begin() + step + count) % count;
    open(files[static_cast<std::size_t>(index)].string());
  }

  // The first that is a scene.
  void openDropped() {
    for (const std::string& file : window_.takeDropped())
      if (open(file)) return;
  }

  const Request& request_;
  Options options_, good_;  // chosen, and of the last frame that could be drawn
  Window window_;
  gl::Api api_;
  Overlay overlay_;
  Session session_;
  FrameLog log_;
  FrameHolder holder_;
  std::string scene_, message_;
  std::optional<std::uint32_t> clicked_;  // a material
  double scale_ = 0;
};

}  // namespace

void runWindow(const Request& request) { Interactive(request).run(); }

}  // namespace halfsilver::demo
