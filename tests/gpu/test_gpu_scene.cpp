#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include <halfsilver/error.h>
#include "frame/gpu_scene.h"
#include "frame/material_textures.h"
#include "gpu/context_fixture.h"
#include "gpu/noise_textures.h"
#include "gpu/shader_function.h"

namespace halfsilver {
namespace {

using testing::addQuad;
using testing::noise;
using testing::plainTexture;
using testing::quadWith;
using testing::ShaderFunction;
using GpuSceneTest = testing::ContextTest;

constexpr BucketLimits kLimits{4096, 256, 8};

TEST(TextureBuckets, EqualSizesShareABucket) {
  const std::vector<TextureRequest> requests = {
      {0, 64, 64, true}, {1, 64, 64, false}, {2, 64, 64, true}, {3, 32, 64, true}};
  const std::vector<TextureGroup> groups = planBuckets(requests, kLimits);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].textures, (std::vector<int>{0, 2}));
  EXPECT_EQ(groups[1].textures, (std::vector<int>{1}));
  EXPECT_EQ(groups[2].width, 32);
}

TEST(TextureBuckets, TheRarestSizesJoinTheNearest) {
  std::vector<TextureRequest> requests;
  // Twelve sizes with 1 to 12 textures.
  for (int size = 0; size < 12; ++size)
    for (int i = 0; i <= size; ++i) requests.push_back({static_cast<int>(requests.size()), 100 + 10 * size, 64, true});
  const std::vector<TextureGroup> groups = planBuckets(requests, kLimits);
  ASSERT_EQ(groups.size(), 8u);
  std::set<int> seen;
  std::set<int> widths;
  for (const TextureGroup& group : groups) {
    widths.insert(group.width);
    seen.insert(group.textures.begin(), group.textures.end());
  }
  EXPECT_EQ(seen.size(), requests.size());
  EXPECT_TRUE(widths.count(210));
  EXPECT_FALSE(widths.count(100)) << "the rarest is not kept";
}

TEST(TextureBuckets, LimitsOfTheDevice) {
  std::vector<TextureRequest> requests = {{0, 10000, 100, true}};
  for (int i = 1; i <= 600; ++i) requests.push_back({i, 16, 16, false});
  const std::vector<TextureGroup> groups = planBuckets(requests, kLimits);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].width, 4096);
  EXPECT_EQ(groups[0].height, 100);
  EXPECT_EQ(bucketCount(groups[1], kLimits), 3);
  for (int i = 601; i <= 2048; ++i) requests.push_back({i, 16, 16, false});
  EXPECT_THROW(planBuckets(requests, kLimits), Error);
}

TEST(TextureBuckets, ResamplingKeepsTheMeanInLinearLight) {
  Texture checker = *plainTexture(8, 8, {0, 0, 0, 255}, true);
  for (std::size_t i = 0; i < 64; ++i)
    if ((i + i / 8) % 2)
      for (std::size_t c = 0; c < 3; ++c) checker.texels[4 * i + c] = 255;
  const Texture small = resample(checker, 4, 2);
  ASSERT_EQ(small.texels.size(), 32u);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(small.texels[4 * i], 188, 1);  // half the light, sRGB-encoded
  const Texture large = resample(*plainTexture(3, 5, {10, 100, 200, 77}, true), 7, 11);
  for (std::size_t i = 0; i < 77; ++i) {
    EXPECT_EQ(large.texels[4 * i + 1], 100);
    EXPECT_EQ(large.texels[4 * i + 3], 77);
  }
}

TEST_F(GpuSceneTest, DrawListIsGroupedAndStable) {
  Scene scene;
  scene.materials.resize(4);
  scene.materials[1].doubleSided = true;
  scene.materials[2].alphaMode = AlphaMode::mask;
  scene.materials[2].baseColor.a = 0.1f;
  scene.materials[3] = scene.materials[2];
  scene.materials[3].doubleSided = true;
  for (const std::uint32_t material : {3u, 0u, 2u, 1u, 0u})
    addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, material);
  const GpuScene gpu = uploadScene(api, scene);
  EXPECT_EQ(gpu.triangleCount, 10u);
  ASSERT_EQ(gpu.drawRanges.size(), 4u);
  const std::vector<std::uint32_t> order = gpu.drawList.read<std::uint32_t>(10);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{2, 3, 8, 9, 6, 7, 4, 5, 0, 1}));
  const std::uint32_t counts[] = {4, 2, 2, 2};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(gpu.drawRanges[i].count, counts[i]);
    EXPECT_EQ(gpu.drawRanges[i].doubleSided, i % 2 == 1);
    EXPECT_EQ(gpu.drawRanges[i].cut, i >= 2);
  }
}

TEST_F(GpuSceneTest, EmptySceneUploads) {
  const GpuScene gpu = uploadScene(api, Scene{});
  EXPECT_EQ(gpu.triangleCount, 0u);
  EXPECT_TRUE(gpu.drawRanges.empty());
  gpu.bindSurfaces();
}

TEST_F(GpuSceneTest, UpdateMovesOnlyTheRange) {
  Scene scene;
  scene.materials.resize(1);
  addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 0);
  addQuad(scene, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, 0);
  GpuScene gpu = uploadScene(api, scene);
  for (Vertex& vertex : scene.vertices) vertex.position += glm::vec3(0, 0, 5);
  const VertexRange range{4, 4};
  updateScene(api, gpu, scene, {.moved = {range}});
  const std::vector<float> positions = gpu.positions.read<float>(24);
  for (std::size_t v = 0; v < 8; ++v) EXPECT_EQ(positions[3 * v + 2], v < 4 ? 0.0f : 6.0f);
  EXPECT_EQ(gpu.extents.bounds().high.z, 6.0f);
  const VertexRange beyond{6, 4};
  EXPECT_THROW(updateScene(api, gpu, scene, {.moved = {beyond}}), Error);
}

TEST_F(GpuSceneTest, UpdatedScenesEqualFreshOnes) {
  Scene scene;
  scene.textures = {plainTexture(4, 4, {255, 255, 255, 90}, true)};
  scene.materials.resize(2);
  scene.materials[1].alphaMode = AlphaMode::mask;
  scene.materials[1].alphaCutoff = 0.1f;
  scene.materials[1].baseColorTexture.texture = 0;
  for (std::uint32_t i = 0; i < 40; ++i) addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, i % 2);
  GpuScene gpu = uploadScene(api, scene);
  const std::size_t rangesBefore = gpu.drawRanges.size();
  scene.vertices[81].position = {900, 0, 0};
  scene.materials[0].doubleSided = true;
  scene.materials[1].alphaCutoff = 0.6f;  // holes where there were none
  updateScene(api, gpu, scene, {.materials = true, .moved = {{81, 1}}});
  const GpuScene fresh = uploadScene(api, scene);
  EXPECT_EQ(gpu.extents.bounds().high, fresh.extents.bounds().high);
  EXPECT_EQ(gpu.extents.core().bounds.high, fresh.extents.core().bounds.high);
  EXPECT_EQ(gpu.extents.core().outer, fresh.extents.core().outer);
  EXPECT_EQ(gpu.extents.core().outer, std::vector<std::uint32_t>{40});
  EXPECT_EQ(gpu.drawList.read<std::uint32_t>(80), fresh.drawList.read<std::uint32_t>(80));
  ASSERT_EQ(gpu.drawRanges.size(), fresh.drawRanges.size());
  EXPECT_GT(gpu.drawRanges.size(), rangesBefore);
  for (std::size_t i = 0; i < gpu.drawRanges.size(); ++i) {
    EXPECT_EQ(gpu.drawRanges[i].count, fresh.drawRanges[i].count);
    EXPECT_EQ(gpu.drawRanges[i].cut, fresh.drawRanges[i].cut);
    EXPECT_EQ(gpu.drawRanges[i].doubleSided, fresh.drawRanges[i].doubleSided);
  }
  const std::size_t words = fresh.materials.bytes() / sizeof(std::uint32_t);
  EXPECT_EQ(gpu.materials.read<std::uint32_t>(words), fresh.materials.read<std::uint32_t>(words));
  EXPECT_EQ(gpu.positions.read<float>(480), fresh.positions.read<float>(480));
}

TEST_F(GpuSceneTest, IndicesThatPointNowhereAreRefused) {
  Scene scene;
  scene.materials.resize(1);
  addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 0);
  Scene vertex = scene, material = scene, texture = scene;
  vertex.triangles[1].vertices[2] = 4;
  material.triangles[0].material = 1;
  texture.materials[0].normalTexture.texture = 0;
  for (const Scene* bad : {&vertex, &material, &texture}) {
    try {
      uploadScene(api, *bad);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::badInput);
    }
  }
}

TEST_F(GpuSceneTest, ManySizesAreResampledWithAWarning) {
  Scene scene;
  for (int i = 0; i < 12; ++i) {
    scene.textures.push_back(plainTexture(8 + i, 8, {static_cast<std::uint8_t>(20 * i), 7, 9, 255}, false));
    Material material;
    material.normalTexture.texture = i;
    scene.materials.push_back(material);
    addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, static_cast<std::uint32_t>(i));
  }
  const GpuScene gpu = uploadScene(api, scene);
  EXPECT_EQ(gpu.textures.size(), 8u);
  EXPECT_EQ(gpu.warnings.size(), 4u);
  gpu.bindSurfaces();
  const ShaderFunction sample(api, "lib/textures.glsl",
                              "outputs[item] = sampleTexture(materials[item].textures[TEXTURE_NORMAL], "
                              "inputs[item].xy, vec2(0.001, 0.0), vec2(0.0, 0.001));",
                              1, 1);
  const std::vector<glm::vec4> colors = sample.run(std::vector<glm::vec4>(12, glm::vec4(0.5f)));
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_NEAR(colors[i].r, 20.0f * static_cast<float>(i) / 255.0f, 1e-4f) << "texture " << i;
}

float wrapped(float texel, float size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(texel, 0.0f, size - 1);
  const float period = wrap == Wrap::mirror ? 2 * size : size;
  const float inside = texel - period * std::floor(texel / period);
  return inside < size ? inside : 2 * size - 1 - inside;
}

glm::vec4 texelOf(const Texture& texture, float x, float y, const TextureUse& use) {
  const auto column = static_cast<std::size_t>(wrapped(x, static_cast<float>(texture.width), use.wrapU));
  const auto row = static_cast<std::size_t>(wrapped(y, static_cast<float>(texture.height), use.wrapV));
  const std::uint8_t* texel = &texture.texels[4 * (row * static_cast<std::size_t>(texture.width) + column)];
  return glm::vec4(texel[0], texel[1], texel[2], texel[3]) / 255.0f;
}

glm::vec4 expectedSample(const Texture& texture, const TextureUse& use, glm::vec2 uv) {
  const glm::vec2 at =
      glm::vec2(glm::dot(use.transform[0], glm::vec3(uv, 1)), glm::dot(use.transform[1], glm::vec3(uv, 1))) *
      glm::vec2(texture.width, texture.height);
  if (use.magnify == Filter::nearest) return texelOf(texture, std::floor(at.x), std::floor(at.y), use);
  const glm::vec2 low = glm::floor(at - 0.5f), weight = at - 0.5f - low;
  return glm::mix(
      glm::mix(texelOf(texture, low.x, low.y, use), texelOf(texture, low.x + 1, low.y, use), weight.x),
      glm::mix(texelOf(texture, low.x, low.y + 1, use), texelOf(texture, low.x + 1, low.y + 1, use), weight.x),
      weight.y);
}

TEST_F(GpuSceneTest, MagnifiedTexturesMatchTheCpuInAllModes) {
  const ShaderFunction sample(api, "lib/textures.glsl",
                              "outputs[item] = sampleTexture(materials[0].textures[TEXTURE_BASE_COLOR], "
                              "inputs[item].xy, vec2(0.001, 0.0), vec2(0.0, 0.001));",
                              1, 1);
  const auto texture = noise(16, 12, false, 3);
  std::minstd_rand random(7);
  std::uniform_real_distribution<float> coordinate(-2.5f, 3.5f);
  std::vector<glm::vec4> inputs(2000);
  for (glm::vec4& input : inputs) input = {coordinate(random), coordinate(random), 0, 0};
  for (const Filter filter : {Filter::linear, Filter::nearest})
    for (const Wrap wrapU : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const Wrap wrapV : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        TextureUse use;
        use.wrapU = wrapU;
        use.wrapV = wrapV;
        use.magnify = filter;
        use.transform = {glm::vec3(0.9f, 0.2f, 0.1f), glm::vec3(-0.3f, 1.1f, 0.25f)};
        const GpuScene gpu = uploadScene(api, quadWith(use, texture));
        gpu.bindSurfaces();
        const std::vector<glm::vec4> outputs = sample.run(inputs);
        int wrong = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
          const glm::vec4 difference = glm::abs(outputs[i] - expectedSample(*texture, use, inputs[i]));
          // Samplers weigh texels with 8 bits.
          if (std::max({difference.r, difference.g, difference.b, difference.a}) > 2.5f / 255) ++wrong;
        }
        // A nearest texel may be its neighbour where a coordinate is rounded at the border.
        EXPECT_LE(wrong, filter == Filter::nearest ? 2 : 0)
            << "wrap " << static_cast<int>(wrapU) << static_cast<int>(wrapV) << " filter " << static_cast<int>(filter);
      }
}

TEST_F(GpuSceneTest, SrgbIsDecodedAndMipmapsAreLinear) {
  auto checker = plainTexture(16, 16, {0, 0, 0, 255}, true);
  for (std::size_t i = 0; i < 256; ++i)
    if ((i + i / 16) % 2) checker->texels[4 * i] = checker->texels[4 * i + 1] = 188;
  TextureUse use;
  Scene scene = quadWith(use, checker);
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].baseColorTexture.mipmaps = false;
  const GpuScene gpu = uploadScene(api, scene);
  gpu.bindSurfaces();
  const ShaderFunction sample(api, "lib/textures.glsl",
                              "outputs[item] = sampleTexture(materials[uint(inputs[item].w)].textures[0], "
                              "inputs[item].xy, vec2(inputs[item].z, 0.0), vec2(0.0, inputs[item].z));",
                              1, 1);
  const float center = 0.5f / 16;
  const std::vector<glm::vec4> out =
      sample.run({{3 * center, center, 1e-3f, 0}, {center, center, 0.5f, 0}, {3 * center, center, 0.5f, 1}});
  EXPECT_NEAR(out[0].r, 0.503f, 2e-3f);
  EXPECT_NEAR(out[1].r, 0.2515f, 4e-3f) << "the mean of the light, not of the codes";
  EXPECT_NEAR(out[2].r, 0.503f, 2e-3f) << "without mipmaps the texel itself";
  EXPECT_NEAR(out[1].b, 0, 1e-6f);
}

TEST_F(GpuSceneTest, SkyImageKeepsItsRows) {
  Scene scene;
  scene.sky.imageWidth = 4;
  scene.sky.imageHeight = 2;
  scene.sky.image.resize(24);
  for (std::size_t i = 0; i < 24; ++i) scene.sky.image[i] = static_cast<float>(i);
  scene.sky.image[5] = 1e9f;
  const GpuScene gpu = uploadScene(api, scene);
  EXPECT_EQ(gpu.sky.shape().levels, 3);
  const std::vector<float> texels = testing::readFloats(gpu.sky, GL_RGB, 3);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(texels[i], i == 5 ? 65504.0f : static_cast<float>(i));
}

}  // namespace
}  // namespace halfsilver
