#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

// GL contexts without a window or a display. See renderer/context/README.md.
namespace halfsilver {

enum class ContextKind {
  automatic,  // EGL, or OSMesa if that fails
  egl,        // a device of EGL_EXT_platform_device, hardware before software; else EGL_MESA_platform_surfaceless
  osmesa      // Mesa's software rasterizer in memory
};

struct ContextOptions {
  bool debug = false;  // asks the driver for debug messages (KHR_debug)
  // One of contextDevices(): its place in that list, or a part of its name or of its renderer's, in any case. Empty:
  // the first that makes a context.
  std::string device = {};
  // Names or paths of the libraries to open. Empty: the system's.
  std::string eglLibrary = {};
  std::string osmesaLibrary = {};
};

// A way to a context, in the order in which they are tried.
struct ContextDevice {
  ContextKind kind;      // egl or osmesa
  std::string name;      // "device 0", "device 1 (software)", "surfaceless platform", "OSMesa"
  std::string renderer;  // as OpenGL calls it; empty if it makes no OpenGL 4.5 core context
  std::string lacks;     // why not
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

  explicit Context(std::unique_ptr<Backend> backend, std::string passedOver = {});
  ~Context();
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;

  const char* name() const;  // "egl" or "osmesa"
  // Looks up GL functions; stays valid if the object is moved.
  std::function<Proc(const char*)> getProcAddress() const;

  // Devices that come before it and make no context, with the reasons; empty if there are none.
  const std::string& passedOver() const { return passedOver_; }

  void makeCurrent();  // throws Error (noContext)
  void release();      // nothing is current afterwards
 private:
  std::unique_ptr<Backend> backend_;
  std::string passedOver_;
};

// All devices, each tried once: no context may be current.
std::vector<ContextDevice> contextDevices(const ContextOptions& options = {});

// Makes a context and makes it current. Throws Error (noContext) that says what was tried and what each lacked.
Context makeContext(ContextKind kind, const ContextOptions& options = {});

}  // namespace halfsilver
