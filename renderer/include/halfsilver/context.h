#pragma once

#include <functional>
#include <memory>
#include <string>

// GL contexts without a window or a display. See README.md of this folder.
namespace halfsilver {

enum class ContextKind {
  automatic,  // EGL, and OSMesa where that fails
  egl,        // a device of EGL_EXT_platform_device, hardware before software; else EGL_MESA_platform_surfaceless
  osmesa      // Mesa's software rasterizer in memory
};

struct ContextOptions {
  bool debug = false;  // asks the driver for debug messages (KHR_debug)
  // The libraries to open; another build can be named by its path. Empty: the system's.
  std::string eglLibrary;
  std::string osmesaLibrary;
};

// A current OpenGL 4.5 core context; move-only, released and destroyed with the object. There is no default
// framebuffer to draw to: draw into framebuffer objects.
//
// A thread has at most one current context, EGL and OSMesa counted together: release() one before another is made or
// made current. Destroy a context on a thread where it, or none, is current.
class Context {
 public:
  using Proc = void (*)();
  class Backend;

  explicit Context(std::unique_ptr<Backend> backend);
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  const char* name() const;  // "egl" or "osmesa"
  // Looks up GL functions; stays valid when the object moves.
  std::function<Proc(const char*)> getProcAddress() const;

  void makeCurrent();  // throws Error (noContext)
  void release();      // nothing is current afterwards
 private:
  std::unique_ptr<Backend> backend_;
};

// Makes a context and makes it current. Throws Error (noContext): what was tried and what each lacked.
Context makeContext(ContextKind kind, const ContextOptions& options = {});

}  // namespace halfsilver
