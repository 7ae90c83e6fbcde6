#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gpu/render_fixture.h"

// Scenes and helpers of the tests of tracing.
namespace halfsilver::testing {

class TracingTest : public RenderTest {
 protected:
  // What a shader file has and what is to stand there instead.
  struct ShaderEdit {
    std::string file, from, to;
  };
  static void withShaders(const std::vector<ShaderEdit>& edits, const std::function<void()>& work);
  // Has the identity structure rasterize large triangles, however few bricks it builds.
  inline static const ShaderEdit kNoPairs = {"shared/passes/identity.h", "#define MAX_PAIRED_BRICKS 4096u",
                                             "#define MAX_PAIRED_BRICKS 0u"};
  // Has frames after a move build the identity structure in steps, as first frames do.
  inline static const ShaderEdit kInSteps = {"shared/passes/identity.h", "#define MAX_FEW_BRICKS 4096u",
                                             "#define MAX_FEW_BRICKS 0u"};
};

Material plain(const glm::vec3& color);
Material mirrorMaterial();

// With corners of its own and the normal of its winding.
void addTriangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t material);

// A mirror floor at y = 0 under a soup of double-sided triangles of very different sizes.
Scene soup(int triangles);
const Camera kAbove = lookAt({0, 1.9f, 3.2f}, {0, 0.1f, 0});

// Sheets that hang over a mirror, seen from below; the first one is nearest.
Scene manySheets(int sheets);
const Camera kBelowSheets = lookAt({0, 0.4f, 0.9f}, {0, 0, 0});

// That the picture is worth comparing: many rays, many triangles hit.
void expectNontrivial(const HitErrors& errors, const Frame& exact);

}  // namespace halfsilver::testing
