#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/arguments.h"
#include "apps/demo/controls.h"
#include "apps/demo/gamepad.h"

struct GLFWwindow;

namespace halfsilver::demo {

// A window with an OpenGL 4.5 core context, current on this thread. One at a time.
class Window {
 public:
  // `scaled`: the size is multiplied by the display's content scale. Throws Error (noContext): no display, or no such
  // context.
  Window(const Size& size, bool scaled, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  std::function<void (*(const char*))()> getProcAddress() const;

  bool open() const;
  void close();
  // Events since the last call; waits for some while there is nothing to draw into.
  void poll();
  void show();  // what was drawn

  Size size() const { return size_; }  // of the framebuffer; 0 x 0 while minimized
  bool visible() const { return size_.width > 0 && size_.height > 0; }
  double contentScale() const { return contentScale_; }
  void setTitle(const std::string& title);
  void toggleFullscreen();
  void setVerticalSync(bool on);

  // Of the last poll(). Pointer and wheel are left out while the overlay wants the mouse, keys while it wants those.
  Controls controls(bool overlayHasMouse, bool overlayHasKeys);
  bool pressed(int key) const { return pressed_.count(key) != 0; }  // GLFW's name
  bool shift() const { return shift_; }                             // was held with the last of them
  std::vector<std::string> takeDropped();
  bool hasGamepad() const { return gamepad_.connected(); }

 private:
  struct Callbacks;

  struct Terminate {
    Terminate();
    ~Terminate();
  };
  Terminate library_;
  GLFWwindow* window_ = nullptr;
  Size size_;
  double contentScale_ = 1;
  Gamepad gamepad_;
  std::set<int> pressed_;
  bool shift_ = false;
  std::vector<std::string> dropped_;
  float wheel_ = 0;
  std::optional<glm::vec2> last_;  // the pointer in the last frame
  glm::vec2 pressedAt_{0};
  bool held_ = false, dragged_ = false;
  double lastClick_ = -1;           // seconds
  int windowed_[4] = {0, 0, 0, 0};  // x, y, width, height before fullscreen
};

}  // namespace halfsilver::demo
