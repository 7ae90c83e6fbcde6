// What temporal antialiasing keeps of a frame, and where the samples of its frames lie.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "frame/frame_constants.h"
#include "gpu/context_fixture.h"
#include "gpu/shader_function.h"
#include "picture.h"

namespace halfsilver::testing {
namespace {

using PastSamples = ContextTest;

TEST_F(PastSamples, KeepRadianceWithinAFiveHundredthOfItsLargestPart) {
  const ShaderFunction kept(api, "lib/history.glsl",
                            "outputs[item] = vec4(unpackRadiance(packRadiance(inputs[item].rgb)), 0.0);", 1, 1);
  std::vector<glm::vec4> inputs = {{0, 0, 0, 0},         {1, 1, 1, 0},    {0.9999f, 0.5f, 0, 0}, {65408, 1, 40000, 0},
                                   {1e-6f, 2e-6f, 0, 0}, {0.3f, 0, 7, 0}, {511.5f, 0.25f, 1, 0}, {-1, 0.5f, 0, 0}};
  for (int i = 0; i < 4000; ++i)
    inputs.emplace_back(std::exp2(-12 + 0.007f * static_cast<float>(i)), 0.01f * static_cast<float>(i % 97), 0.3f, 0);
  const std::vector<glm::vec4> found = kept.run(inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const glm::vec3 wanted = glm::clamp(glm::vec3(inputs[i]), 0.0f, 65408.0f);
    const float largest = std::max({wanted.r, wanted.g, wanted.b});
    const glm::vec3 error = glm::abs(glm::vec3(found[i]) - wanted);
    EXPECT_LE(std::max({error.r, error.g, error.b}), std::max(largest / 500, 0x1p-24f)) << i << ": " << largest;
  }
  EXPECT_EQ(glm::vec3(found[1]), glm::vec3(1));
  EXPECT_EQ(found[3].r, 65408);
  EXPECT_EQ(glm::vec3(kept.run({{1e30f, 0, 0, 0}})[0]), glm::vec3(65408, 0, 0)) << "the most that there is room for";
}

// Seen from the picture that moves, they are those of a picture that does not.
TEST_F(PastSamples, LieWhereThoseOfAStillPictureDo) {
  constexpr int kHeight = 100;
  Camera camera;
  camera.eye = {0, 0, 0};
  camera.verticalFov = glm::radians(2.0f);
  const float pixel = 2 * std::tan(0.5f * camera.verticalFov) / kHeight;
  Settings settings;
  settings.image.antialiasing = Antialiasing::temporal;
  Picture picture(api);
  for (std::uint32_t step = 0; step < 40; ++step) {
    SCOPED_TRACE(step);
    const glm::vec2 seen = static_cast<float>(step) * glm::vec2(0.31f, -0.17f);  // pixels
    camera.target = {seen.x * pixel, seen.y * pixel, -1};
    const glm::vec2 jitter = picture.begin(camera, settings, {160, kHeight}, std::nullopt).jitter;
    EXPECT_LE(std::max(std::abs(jitter.x), std::abs(jitter.y)), 0.5f);
    const glm::vec2 place = jitter + seen - sampleOffset(step);
    EXPECT_LT(glm::length(place - glm::round(place)), 0.03f);
    if (step == 0) {
      EXPECT_EQ(jitter, glm::vec2(0));
    }
  }
}

}  // namespace
}  // namespace halfsilver::testing
