#include "apps/demo/window.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <halfsilver/error.h>

namespace halfsilver::demo {
namespace {

constexpr float kDragPixels = 4;       // less is a click
constexpr double kDoubleClick = 0.35;  // seconds

std::string lastProblem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

}  // namespace

Window::Terminate::Terminate() {
  if (!glfwInit()) throw Error(ErrorKind::noContext, "no window: " + lastProblem());
}
Window::Terminate::~Terminate() { glfwTerminate(); }

struct Window::Callbacks {
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
  static void key(GLFWwindow* window, int key, int, int action, int modifiers) {
    if (action != GLFW_PRESS) return;
    of(window).pressed_.insert(key);
    of(window).shift_ = (modifiers & GLFW_MOD_SHIFT) != 0;
  }
  static void scroll(GLFWwindow* window, double, double notches) { of(window).wheel_ += static_cast<float>(notches); }
  static void drop(GLFWwindow* window, int count, const char** paths) {
    of(window).dropped_.assign(paths, paths + count);
  }
  static void scale(GLFWwindow* window, float x, float) { of(window).contentScale_ = static_cast<double>(x); }
  static void focus(GLFWwindow* window, int) { of(window).last_.reset(); }  // no jump of the view on return
};

Window::Window(const Size& size, bool scaled, const std::string& title) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, scaled);
  window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (!window_) throw Error(ErrorKind::noContext, "no window with OpenGL 4.5: " + lastProblem());
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, Callbacks::key);
  glfwSetScrollCallback(window_, Callbacks::scroll);
  glfwSetDropCallback(window_, Callbacks::drop);
  glfwSetWindowContentScaleCallback(window_, Callbacks::scale);
  glfwSetWindowFocusCallback(window_, Callbacks::focus);
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  contentScale_ = static_cast<double>(x);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwGetFramebufferSize(window_, &size_.width, &size_.height);
}

Window::~Window() {
  if (window_) glfwDestroyWindow(window_);
}

std::function<void (*(const char*))()> Window::getProcAddress() const {
  return [](const char* name) { return glfwGetProcAddress(name); };
}

bool Window::open() const { return !glfwWindowShouldClose(window_); }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

void Window::poll() {
  pressed_.clear();
  wheel_ = 0;
  if (visible())
    glfwPollEvents();
  else
    glfwWaitEventsTimeout(0.1);
  glfwGetFramebufferSize(window_, &size_.width, &size_.height);
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) size_ = {0, 0};  // on X11 it keeps its size
}

void Window::show() { glfwSwapBuffers(window_); }
void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
void Window::setVerticalSync(bool on) { glfwSwapInterval(on ? 1 : 0); }

void Window::toggleFullscreen() {
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3], GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) return;
  glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
  glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

std::vector<std::string> Window::takeDropped() { return std::exchange(dropped_, {}); }

Controls Window::controls(bool overlayHasMouse, bool overlayHasKeys) {
  Controls controls;
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  int width = 1, height = 1;
  glfwGetWindowSize(window_, &width, &height);
  // Cursors are in screen coordinates, which a display of high density has fewer of than pixels.
  const glm::vec2 pointer(
      static_cast<float>(x) * static_cast<float>(size_.width) / static_cast<float>(std::max(1, width)),
      static_cast<float>(y) * static_cast<float>(size_.height) / static_cast<float>(std::max(1, height)));
  const glm::vec2 moved = last_ ? pointer - *last_ : glm::vec2(0);
  last_ = pointer;
  const auto button = [&](int name) { return glfwGetMouseButton(window_, name) == GLFW_PRESS; };
  const bool left = button(GLFW_MOUSE_BUTTON_LEFT) && !overlayHasMouse;
  if (!overlayHasMouse) {
    controls.pointer = pointer;
    controls.wheel = wheel_;
    controls.flying = button(GLFW_MOUSE_BUTTON_RIGHT);
    if (left && held_) controls.orbit = moved;
    if (button(GLFW_MOUSE_BUTTON_MIDDLE)) controls.pan = moved;
    if (controls.flying) controls.look = moved;
  }
  if (left && !held_) {
    pressedAt_ = pointer;
    dragged_ = false;
  }
  dragged_ = dragged_ || glm::length(pointer - pressedAt_) > kDragPixels;
  if (held_ && !left && !dragged_ && !overlayHasMouse) {
    controls.clicked = true;
    controls.doubleClicked = glfwGetTime() - lastClick_ < kDoubleClick;
    lastClick_ = controls.doubleClicked ? -1 : glfwGetTime();
  }
  held_ = left;
  if (!overlayHasKeys) {
    const auto axis = [&](int plus, int minus) {
      return static_cast<float>((glfwGetKey(window_, plus) == GLFW_PRESS) - (glfwGetKey(window_, minus) == GLFW_PRESS));
    };
    controls.move = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
    controls.action = pressed(GLFW_KEY_ENTER);
    controls.restart = pressed(GLFW_KEY_R);
    controls.reset = pressed(GLFW_KEY_BACKSPACE);
    controls.daylight = pressed(GLFW_KEY_N);
    for (int i = 0; i < 4; ++i) controls.lanterns[i] = pressed(GLFW_KEY_F5 + i);
  }
  gamepad_.read(glfwGetGamepadState, controls);
  return controls;
}

}  // namespace halfsilver::demo
