#pragma once

#include <functional>
#include <memory>
#include <string>

// GL contexts without a window or a display. See renderer/context/README.md.
namespace halfsilver {

enum class ContextKind {
  automatic,  // EGL, or OSMesa if that fails
  egl,        // a device of EGL_EXT_platform_device, hardware before software; else EGL_MESA_platform_surfaceless
  osmesa      // Mesa's software rasterizer in memory
};

struct ContextOptions {
  bool debug = false;  // asks the driver for debug messages (KHR_debug)
  // Names or paths of the libraries to open. Empty: the system's.
  std::string eglLibrary;
  std::string osmesaLibrary;
};

// An OpenGL 4.5 core context; move-only, released and destroyed with the object. It has no default framebuffer: draw
// into framebuffer objects.
//
// A thread has at most one current context, EGL and OSMesa counted together: release() it before making another or
// making another current. Destroy a context on a thread where it, or no context, is current.
class Context {
 public:
  using Proc = void (*)();
  class Backend;

  explicit Context(std::unique_ptr<Backend> backend);
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  const char* name() const;  // "egl" or "osmesa"
  // Looks up GL functions; stays valid if the object is moved.
  std::function<Proc(const char*)> getProcAddress() const;

  void makeCurrent();  // throws Error (noContext)
  void release();      // nothing is current afterwards
 private:
  std::unique_ptr<Backend> backend_;
};

// Makes a context and makes it current. Throws Error (noContext) that says what was tried and what each lacked.
Context makeContext(ContextKind kind, const ContextOptions& options = {});

}  // namespace halfsilver
