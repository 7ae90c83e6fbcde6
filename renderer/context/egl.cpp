#define EGL_NO_X11
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/error.h>
#include "context/backend.h"
#include "context/library.h"

namespace halfsilver {
namespace {

#define HALFSILVER_EGL_FUNCTIONS(X)                   \
  X(PFNEGLBINDAPIPROC, BindAPI)                       \
  X(PFNEGLCHOOSECONFIGPROC, ChooseConfig)             \
  X(PFNEGLCREATECONTEXTPROC, CreateContext)           \
  X(PFNEGLDESTROYCONTEXTPROC, DestroyContext)         \
  X(PFNEGLGETCURRENTCONTEXTPROC, GetCurrentContext)   \
  X(PFNEGLGETERRORPROC, GetError)                     \
  X(PFNEGLGETPLATFORMDISPLAYPROC, GetPlatformDisplay) \
  X(PFNEGLGETPROCADDRESSPROC, GetProcAddress)         \
  X(PFNEGLINITIALIZEPROC, Initialize)                 \
  X(PFNEGLMAKECURRENTPROC, MakeCurrent)               \
  X(PFNEGLQUERYSTRINGPROC, QueryString)

struct Egl {
#define HALFSILVER_EGL_MEMBER(type, name) type name = nullptr;
  HALFSILVER_EGL_FUNCTIONS(HALFSILVER_EGL_MEMBER)
#undef HALFSILVER_EGL_MEMBER
};

Egl load(const Library& library) {
  Egl egl;
#define HALFSILVER_EGL_LOAD(type, name) library.load(egl.name, "egl" #name);
  HALFSILVER_EGL_FUNCTIONS(HALFSILVER_EGL_LOAD)
#undef HALFSILVER_EGL_LOAD
  return egl;
}

bool contains(const char* extensions, std::string_view name) {
  std::istringstream words(extensions ? extensions : "");
  for (std::string word; words >> word;)
    if (word == name) return true;
  return false;
}

[[noreturn]] void fail(const Egl& egl, const std::string& what) {
  std::ostringstream message;
  message << what << " (EGL error 0x" << std::hex << egl.GetError() << ")";
  throw Error(ErrorKind::noContext, message.str());
}

// A display to try, with a name for messages.
struct Candidate {
  EGLenum platform;
  void* native;
  std::string name;
};

// Hardware devices, then software devices, then Mesa's surfaceless platform, which picks a device itself.
std::vector<Candidate> candidates(const Egl& egl) {
  const char* client = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<Candidate> hardware, software;
  const auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.GetProcAddress("eglQueryDevicesEXT"));
  const auto queryDevice =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.GetProcAddress("eglQueryDeviceStringEXT"));
  if (contains(client, "EGL_EXT_platform_device") && queryDevices && queryDevice) {
    EGLint count = 0;
    if (!queryDevices(0, nullptr, &count)) count = 0;
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (count && !queryDevices(count, devices.data(), &count)) count = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const char* extensions = queryDevice(devices[i], EGL_EXTENSIONS);
      const bool isSoftware = contains(extensions, "EGL_MESA_device_software");
      (isSoftware ? software : hardware)
          .push_back(
              {EGL_PLATFORM_DEVICE_EXT, devices[i], "device " + std::to_string(i) + (isSoftware ? " (software)" : "")});
    }
  }
  std::vector<Candidate> all = std::move(hardware);
  all.insert(all.end(), software.begin(), software.end());
  if (contains(client, "EGL_MESA_platform_surfaceless"))
    all.push_back({EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless platform"});
  return all;
}

class EglBackend : public Context::Backend {
 public:
  EglBackend(const Egl& egl, const Candidate& candidate, bool debug) : egl_(egl) {
    display_ = egl.GetPlatformDisplay(candidate.platform, candidate.native, nullptr);
    if (display_ == EGL_NO_DISPLAY) fail(egl, "no display");
    EGLint major = 0, minor = 0;
    if (!egl.Initialize(display_, &major, &minor)) fail(egl, "cannot be initialized");
    if (major * 10 + minor < 15)
      throw Error(ErrorKind::noContext,
                  "EGL version " + std::to_string(major) + "." + std::to_string(minor) + ", but 1.5 is needed");
    const char* extensions = egl.QueryString(display_, EGL_EXTENSIONS);
    if (!contains(extensions, "EGL_KHR_surfaceless_context"))
      throw Error(ErrorKind::noContext, "no EGL_KHR_surfaceless_context");
    if (!egl.BindAPI(EGL_OPENGL_API)) throw Error(ErrorKind::noContext, "no desktop OpenGL");

    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!contains(extensions, "EGL_KHR_no_config_context")) {
      const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE};
      EGLint count = 0;
      if (!egl.ChooseConfig(display_, wanted, &config, 1, &count) || count == 0)
        throw Error(ErrorKind::noContext, "no configuration for desktop OpenGL");
    }
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 debug ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    context_ = egl.CreateContext(display_, config, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT) fail(egl, "the driver makes no OpenGL 4.5 core context");
    try {
      EglBackend::makeCurrent();
    } catch (...) {
      egl.DestroyContext(display_, context_);
      throw;
    }
  }
  // The display stays initialized: the process has only one, and terminating it would end other users' contexts.
  ~EglBackend() override {
    EglBackend::release();
    egl_.DestroyContext(display_, context_);
  }

  const char* name() const override { return "egl"; }
  Context::Proc (*getProcAddress() const)(const char*) override { return egl_.GetProcAddress; }

  void makeCurrent() override {
    // EGL does nothing if it believes the context to be current already, but OSMesa may have replaced its functions.
    release();
    if (!egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      fail(egl_, "the context cannot be made current");
  }
  void release() override {
    if (egl_.GetCurrentContext() == context_)
      egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

 private:
  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::vector<ContextWay> eglWays(const ContextOptions& options) {
  const Egl egl = load(Library({options.eglLibrary.empty() ? "libEGL.so.1" : options.eglLibrary}));
  std::vector<ContextWay> ways;
  for (const Candidate& candidate : candidates(egl))
    ways.push_back({ContextKind::egl, candidate.name, [egl, candidate, debug = options.debug] {
                      return std::make_unique<EglBackend>(egl, candidate, debug);
                    }});
  if (ways.empty())
    throw Error(ErrorKind::noContext, "no driver offers EGL_EXT_platform_device or EGL_MESA_platform_surfaceless");
  return ways;
}

}  // namespace halfsilver
