// Holes of cut materials: the GPU's alpha test, from bytes, is the CPU's.
#include "frame/alpha_texels.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include <halfsilver/error.h>
#include "frame/gpu_scene.h"
#include "gpu/context_fixture.h"
#include "gpu/noise_textures.h"
#include "gpu/shader_function.h"
#include "scene/alpha.h"

namespace halfsilver {
namespace {

using testing::addQuad;
using testing::noise;
using testing::quadWith;
using testing::ShaderFunction;
using AlphaTexelsTest = testing::ContextTest;

TEST_F(AlphaTexelsTest, HolesAreTheSameOnGpuAndCpu) {
  const ShaderFunction cut(
      api, "lib/alpha.glsl",
      "outputs[item] = vec4(cutAway(cutTriangle(triangles[floatBitsToUint(inputs[item].x)], inputs[item].w != 0.0), "
      "inputs[item].yz));",
      1, 1);
  const auto texture = noise(37, 64, true, 11);
  std::minstd_rand random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  std::size_t points = 0, holes = 0, wrong = 0;
  for (const Filter filter : {Filter::linear, Filter::nearest})
    for (const Wrap wrapU : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const Wrap wrapV : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        TextureUse use;
        use.wrapU = wrapU;
        use.wrapV = wrapV;
        use.magnify = filter;
        use.uvSet = wrapU == wrapV ? 1 : 0;
        use.transform = {glm::vec3(3.1f, 0.7f, -1.3f), glm::vec3(-0.4f, 2.9f, -0.6f)};
        Scene scene = quadWith(use, texture);
        scene.materials[0].alphaMode = wrapU == Wrap::mirror ? AlphaMode::blend : AlphaMode::mask;
        scene.materials[0].alphaCutoff = 0.47f;
        scene.materials[0].baseColor.a = 0.93f;
        for (Vertex& vertex : scene.vertices) {
          vertex.color.a = 0.8f + 0.2f * unit(random);
          vertex.uv[1] = glm::vec2(unit(random), unit(random));
        }
        const GpuScene gpu = uploadScene(api, scene);
        gpu.bindSurfaces();
        std::vector<glm::vec4> inputs(6000);
        for (glm::vec4& input : inputs) {
          const std::uint32_t triangle = random() & 1;
          const float u = unit(random), v = (1 - u) * unit(random);
          input = {glm::uintBitsToFloat(triangle), u, v, static_cast<float>(random() & 1)};
        }
        const std::vector<glm::vec4> outputs = cut.run(inputs);
        for (std::size_t i = 0; i < inputs.size(); ++i) {
          const bool hole =
              cutAway(scene, glm::floatBitsToUint(inputs[i].x), {inputs[i].y, inputs[i].z}, inputs[i].w != 0);
          ++points;
          holes += hole;
          wrong += hole != (outputs[i].x > 0.5f);
        }
      }
  EXPECT_GE(points, 100000u);
  EXPECT_GT(holes, points / 4);
  EXPECT_LT(holes, 3 * points / 4);
  EXPECT_EQ(wrong, 0u);
}

TEST_F(AlphaTexelsTest, MoreAlphaThanTheDeviceHoldsIsAnError) {
  Scene scene = quadWith({}, noise(37, 64, true, 11));
  scene.materials[0].alphaMode = AlphaMode::mask;
  gl::Api small = api;
  small.limits.bufferTexels = 37 * 64 / 4;  // four per texel
  EXPECT_EQ(uploadAlphas(small, scene, {true}).texels.bytes(), 37u * 64);
  --small.limits.bufferTexels;
  std::string message;
  try {
    uploadAlphas(small, scene, {true});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::failed);
    message = error.what();
  }
  EXPECT_EQ(message, "the textures that cut holes have 2368 texels in all, the device's limit for their alpha is 2364");
}

// Holes come from a texture as it is in the scene, whatever its colors are resampled to.
TEST_F(AlphaTexelsTest, HolesOfResampledTexturesAreThoseOfTheCpu) {
  const ShaderFunction cut(
      api, "lib/alpha.glsl",
      "outputs[item] = vec4(cutAway(cutTriangle(triangles[floatBitsToUint(inputs[item].x)], false), inputs[item].yz));",
      1, 1);
  Scene scene;
  for (std::uint32_t i = 0; i < 12; ++i) {
    scene.textures.push_back(noise(9 + 5 * static_cast<int>(i), 30, true, 40 + i));
    Material material;
    material.alphaMode = AlphaMode::mask;
    material.alphaCutoff = 0.5f;
    material.baseColorTexture.texture = static_cast<int>(i);
    scene.materials.push_back(material);
    addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, i);
  }
  const GpuScene gpu = uploadScene(api, scene);
  EXPECT_GT(gpu.warnings.size(), 0u) << "some are resampled";
  gpu.bindSurfaces();
  std::minstd_rand random(9);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<glm::vec4> inputs(24000);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const float u = unit(random), v = (1 - u) * unit(random);
    inputs[i] = {glm::uintBitsToFloat(static_cast<std::uint32_t>(i % 24)), u, v, 0};
  }
  const std::vector<glm::vec4> outputs = cut.run(inputs);
  std::size_t holes = 0, wrong = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool hole = cutAway(scene, glm::floatBitsToUint(inputs[i].x), {inputs[i].y, inputs[i].z});
    holes += hole;
    wrong += hole != (outputs[i].x > 0.5f);
  }
  EXPECT_GT(holes, inputs.size() / 4);
  EXPECT_LT(holes, 3 * inputs.size() / 4);
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace halfsilver
