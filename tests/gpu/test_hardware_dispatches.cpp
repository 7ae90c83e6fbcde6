// On hardware, which is reset if a dispatch or a draw takes seconds, long ones come in parts that give the same bits.
#include <string>

#include "gpu/gl_call_counter.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

// The device by another name, so that nothing is software to the renderer.
gl::GetProcAddress asHardware(const gl::GetProcAddress& proc) {
  static thread_local PFNGLGETSTRINGPROC getString;  // GL's functions have no room for an object
  getString = reinterpret_cast<PFNGLGETSTRINGPROC>(proc("glGetString"));
  struct Named {
    static const GLubyte* APIENTRY get(GLenum name) {
      return name == GL_RENDERER ? reinterpret_cast<const GLubyte*>("Some GPU") : getString(name);
    }
  };
  return [proc](const char* name) {
    return name == std::string("glGetString") ? reinterpret_cast<gl::Proc>(&Named::get) : proc(name);
  };
}

class HardwareDispatches : public TracingTest {
 protected:
  struct Drawn {
    Frame frame;
    std::uint64_t begun = 0;  // parts that the device was asked to begin, but for what the host waits for
  };
  Drawn drawOn(const gl::GetProcAddress& device, const Scene& scene, const Settings& settings, int width, int height) {
    GlCallCounter counter(device);
    Renderer renderer(counter.getProcAddress(), methods(scene));
    renderer.setScene(scene);
    Drawn drawn;
    drawn.frame = drawWholeWith(renderer, kAbove, settings, width, height);
    drawn.begun = counter.of("Flush") - counter.of("FenceSync");
    return drawn;
  }

  // The same on hardware, in so many parts at least.
  void expectParts(const Scene& scene, const Settings& settings, int width, int height, std::uint64_t parts) {
    const Drawn software = drawOn(context.getProcAddress(), scene, settings, width, height);
    const Drawn hardware = drawOn(asHardware(context.getProcAddress()), scene, settings, width, height);
    EXPECT_GE(hardware.begun, parts - 1);
    EXPECT_EQ(software.frame.report.memory.fragments, hardware.frame.report.memory.fragments);
    const HitErrors errors = compareHits(hardware.frame, software.frame, 6);
    EXPECT_GT(errors.rays, static_cast<std::size_t>(width * height / 3));
    for (const char* channel : {"hit.T", "hit.id", "R", "G", "B"})
      EXPECT_EQ(software.frame.plane(channel), hardware.frame.plane(channel)) << channel;
  }
};

TEST_F(HardwareDispatches, AFewRaysComeInOnePart) {
  const Drawn drawn =
      drawOn(asHardware(context.getProcAddress()), soup(60), settingsWith({{"select.mode", "all"}}), 96, 72);
  EXPECT_GT(drawn.frame.report.selected, 1000u);
  EXPECT_EQ(drawn.begun, 0u);
}

TEST_F(HardwareDispatches, MoreThanAMillionRaysAreTracedInParts) {
  for (const char* stage : {"compute", "fragment"})
    expectParts(soup(60), settingsWith({{"trace.method", "identity"}, {"trace.stage", stage}, {"select.mode", "all"}}),
                1280, 900, 2);
}

TEST_F(HardwareDispatches, ManyTrianglesAreDrawnInParts) {
  expectParts(soup(140000),
              settingsWith({{"trace.method", "attributes"},
                            {"voxels.resolution", "32"},
                            {"voxels.raster", "abuffer"},
                            {"abuffer.resolution", "64"},
                            {"abuffer.lists", "linked"},
                            {"select.mode", "all"}}),
              96, 72, 5);
}

}  // namespace
}  // namespace halfsilver::testing
