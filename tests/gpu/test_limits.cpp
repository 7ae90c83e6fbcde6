// That the limits that `halfsilver info --device` names are those that the programs need.
#include <string>

#include <halfsilver/error.h>
#include "gl/limits.h"
#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

// A device that offers so many storage blocks, and no more.
struct Blocks {
  GLint compute = gl::kComputeBlocks, fragment = gl::kFragmentBlocks, vertex = gl::kVertexBlocks;
};

gl::GetProcAddress withBlocks(const gl::GetProcAddress& proc, const Blocks& wanted) {
  static thread_local PFNGLGETINTEGERVPROC getIntegerv;  // GL's functions have no room for an object
  static thread_local Blocks blocks;
  getIntegerv = reinterpret_cast<PFNGLGETINTEGERVPROC>(proc("glGetIntegerv"));
  blocks = wanted;
  struct Few {
    static void APIENTRY getInteger(GLenum name, GLint* value) {
      getIntegerv(name, value);
      if (name == GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS) *value = blocks.compute;
      if (name == GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS) *value = blocks.fragment;
      if (name == GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS) *value = blocks.vertex;
    }
  };
  return [proc](const char* name) {
    return name == std::string("glGetIntegerv") ? reinterpret_cast<gl::Proc>(&Few::getInteger) : proc(name);
  };
}

class LimitsTest : public TracingTest {
 protected:
  // Draws with the default method and every effect; what a device with the blocks says to it.
  std::string refusal(const Blocks& blocks) {
    Scene scene = soup(40);
    scene.lights = {sun({-0.3f, -1, -0.4f}, 2)};
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.materials[1].baseColor.a = 0.5f;
    try {
      Renderer renderer(withBlocks(context.getProcAddress(), blocks), methods(scene));
      renderer.setScene(scene);
      for (const char* effect : {"reflection", "whitted", "occlusion", "path", "layers"})
        for (const char* shadows : {"maps", "rays"})
          drawWith(renderer, kAbove,
                   settingsWith({{"trace.effect", effect}, {"shadow.method", shadows}, {"trace.bounces", "2"}}), 40,
                   30);
      drawWith(renderer, kAbove, settingsWith({{"effect.glossy", "true"}}), 40, 30);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::noContext);
      return error.what();
    }
    return "";
  }
};

TEST_F(LimitsTest, TheDefaultSettingsAndAllEffectsNeedWhatIsSaid) { EXPECT_EQ(refusal({}), ""); }

TEST_F(LimitsTest, LessIsTooFew) {
  EXPECT_NE(refusal({.compute = gl::kComputeBlocks - 1}).find("compute"), std::string::npos);
  EXPECT_NE(refusal({.fragment = gl::kFragmentBlocks - 1}).find("fragment"), std::string::npos);
  EXPECT_NE(refusal({.vertex = gl::kVertexBlocks - 1}).find("vertex"), std::string::npos);
}

}  // namespace
}  // namespace halfsilver::testing
