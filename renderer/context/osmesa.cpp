#include <array>
#include <string>

#include <halfsilver/error.h>
#include "context/backend.h"
#include "context/library.h"

namespace halfsilver {
namespace {

// The few names of GL/osmesa.h that are needed: Mesa 25.1 dropped the header together with the library.
constexpr int kFormat = 0x22;
constexpr int kRgba = 0x1908;
constexpr int kDepthBits = 0x30;
constexpr int kStencilBits = 0x31;
constexpr int kAccumBits = 0x32;
constexpr int kProfile = 0x33;
constexpr int kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36;
constexpr int kMinorVersion = 0x37;
constexpr unsigned kUnsignedByte = 0x1401;

struct Functions {
  void* (*createContextAttribs)(const int* attributes, void* shared);
  void (*destroyContext)(void* context);
  unsigned char (*makeCurrent)(void* context, void* buffer, unsigned type, int width, int height);
  void* (*getCurrentContext)();
  Context::Proc (*getProcAddress)(const char* name);
};

Functions load(const Library& library) {
  Functions osmesa{};
  library.load(osmesa.createContextAttribs, "OSMesaCreateContextAttribs");
  library.load(osmesa.destroyContext, "OSMesaDestroyContext");
  library.load(osmesa.makeCurrent, "OSMesaMakeCurrent");
  library.load(osmesa.getCurrentContext, "OSMesaGetCurrentContext");
  library.load(osmesa.getProcAddress, "OSMesaGetProcAddress");
  return osmesa;
}

class OsmesaBackend : public Context::Backend {
 public:
  explicit OsmesaBackend(const Functions& functions) : osmesa_(functions) {
    const int attributes[] = {kFormat,  kRgba,        kDepthBits,    0, kStencilBits,  0, kAccumBits, 0,
                              kProfile, kCoreProfile, kMajorVersion, 4, kMinorVersion, 5, 0,          0};
    context_ = osmesa_.createContextAttribs(attributes, nullptr);
    if (!context_) throw Error(ErrorKind::noContext, "the driver makes no OpenGL 4.5 core context");
    try {
      OsmesaBackend::makeCurrent();
    } catch (...) {
      osmesa_.destroyContext(context_);
      throw;
    }
  }
  ~OsmesaBackend() override {
    OsmesaBackend::release();
    osmesa_.destroyContext(context_);
  }

  const char* name() const override { return "osmesa"; }
  Context::Proc (*getProcAddress() const)(const char*) override { return osmesa_.getProcAddress; }

  void makeCurrent() override {
    if (!osmesa_.makeCurrent(context_, pixels_.data(), kUnsignedByte, kSize, kSize))
      throw Error(ErrorKind::noContext, "the context cannot be made current");
  }
  void release() override {
    if (osmesa_.getCurrentContext() == context_) osmesa_.makeCurrent(nullptr, nullptr, kUnsignedByte, 0, 0);
  }

 private:
  // OSMesa requires a buffer for the default framebuffer, although nothing draws to it.
  static constexpr int kSize = 16;
  Functions osmesa_;
  std::array<unsigned char, std::size_t{4} * kSize * kSize> pixels_{};
  void* context_ = nullptr;
};

}  // namespace

ContextWay osmesaWay(const ContextOptions& options) {
  return {ContextKind::osmesa, "OSMesa", [file = options.osmesaLibrary] {
            const Library library = file.empty() ? Library({"libOSMesa.so.8", "libOSMesa.so.6"}) : Library({file});
            return std::make_unique<OsmesaBackend>(load(library));
          }};
}

}  // namespace halfsilver
