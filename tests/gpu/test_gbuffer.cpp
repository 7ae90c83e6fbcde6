#include <gtest/gtest.h>

#include <cmath>

#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "frame/surface_reader.h"
#include "gpu/context_fixture.h"
#include "gpu/shader_function.h"
#include "passes/gbuffer.h"
#include "scene/alpha.h"

namespace halfsilver {
namespace {

using testing::addQuad;
using testing::plainTexture;
using testing::readNumbers;

struct Picture {
  int width = 0, height = 0;
  shared::FrameConstants frame;
  std::vector<std::uint32_t> visibility;
  std::vector<glm::vec4> position, normal, baseColor, material, emissive;

  const glm::vec4& at(const std::vector<glm::vec4>& layer, int x, int y) const {
    return layer[static_cast<std::size_t>(y * width + x)];
  }
  std::uint32_t id(int x, int y) const { return visibility[static_cast<std::size_t>(y * width + x)]; }
  glm::dvec3 ray(int x, int y) const {
    const glm::dvec2 jitter = 2.0 * glm::dvec2(frame.jitter);
    const double sx = (2.0 * x + 1 - width + jitter.x) / width, sy = (2.0 * y + 1 - height + jitter.y) / height;
    return glm::dvec3(frame.forward) + sx * glm::dvec3(frame.right) + sy * glm::dvec3(frame.up);
  }
};

class GBufferTest : public testing::ContextTest {
 protected:
  Picture draw(const Scene& scene, const Camera& camera, int width, int height, const Settings& settings = {},
               const glm::vec2& jitter = glm::vec2(0)) {
    const GpuScene gpu = uploadScene(api, scene);
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.frame = makeFrameConstants(camera, gpu.extents.bounds(), scene.sky, settings, width, height, {}, jitter);
    const gl::Buffer constants =
        gl::makeBuffer(api, std::span<const shared::FrameConstants>(&picture.frame, 1), "frame");
    GBufferPass pass(api);
    gl::Profiler profiler(api);
    const ShadowMaps unshadowed;
    GBuffer buffer;
    const FrameView view{gpu, unshadowed, constants, picture.frame, profiler, buffer};
    pass.run(view, buffer);
    EXPECT_EQ(buffer.bytes(), static_cast<std::size_t>(width * height) * (4 + 4 + 8 + 8 + 16 + 16));
    picture.visibility = readNumbers(buffer.visibility);
    Surfaces surfaces = SurfaceReader(api).read(view);
    picture.position = std::move(surfaces.positions);
    picture.normal = std::move(surfaces.normals);
    picture.baseColor = readTexels(buffer.shaded);
    picture.material = readTexels(buffer.material);
    picture.emissive = readTexels(buffer.reflection);
    const std::vector<gl::SectionTime> times = profiler.collect();
    EXPECT_EQ(times.size(), 1u);
    EXPECT_EQ(times[0].name, "gbuffer");
    return picture;
  }
};

Camera cameraAt(const glm::vec3& eye, const glm::vec3& target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  return camera;
}

// A program is made for the number of buckets: each scene, whatever it has, shows the colors of its textures.
TEST_F(GBufferTest, EveryBucketShowsItsTexture) {
  for (const int count : {0, 1, 3, 8}) {
    SCOPED_TRACE(count);
    Scene scene;
    scene.materials.resize(1);
    for (int i = 0; i < 8; ++i) {
      const auto x = static_cast<float>(i);
      std::uint32_t material = 0;
      if (i < count) {
        scene.textures.push_back(plainTexture(4 + i, 4, {static_cast<std::uint8_t>(30 * i + 20), 9, 0, 255}, false));
        material = static_cast<std::uint32_t>(scene.materials.size());
        scene.materials.emplace_back().baseColorTexture.texture = i;
      }
      addQuad(scene, {x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}, material);
    }
    Camera camera = cameraAt({4, 0.5f, 10}, {4, 0.5f, 0});
    camera.verticalFov = 2 * std::atan(0.05f);
    const Picture picture = draw(scene, camera, 64, 8);
    for (int i = 0; i < 8; ++i) {
      const float expected = i < count ? static_cast<float>(30 * i + 20) / 255 : 1.0f;
      EXPECT_NEAR(picture.at(picture.baseColor, 8 * i + 4, 4).r, expected, 1e-3f) << "texture " << i;
    }
  }
}

TEST_F(GBufferTest, PlaneGivesThePointsOfThePixelRays) {
  // A large tilted plane, so that barycentrics alone would not be exact enough near the eye.
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].roughness = 0.1f;
  const glm::vec3 u = glm::normalize(glm::vec3(1, 0.2f, 0.1f)) * 80.0f,
                  v = glm::normalize(glm::vec3(0, 0.15f, -1)) * 80.0f;
  addQuad(scene, -u - v, u - v, u + v, -u + v, 0);
  const Picture picture = draw(scene, cameraAt({0.3f, 1.7f, 2.1f}, {0.1f, 0.0f, -1.5f}), 64, 40);
  const glm::dvec3 eye(picture.frame.eye), a(scene.vertices[0].position);
  const glm::dvec3 normal = glm::normalize(
      glm::cross(glm::dvec3(scene.vertices[1].position) - a, glm::dvec3(scene.vertices[2].position) - a));
  int covered = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 64; ++x) {
      const glm::dvec3 ray = picture.ray(x, y);
      const double depth = glm::dot(a - eye, normal) / glm::dot(ray, normal);
      const glm::vec4 position = picture.at(picture.position, x, y);
      if (!(depth > 0 && depth < 20)) continue;
      ++covered;
      const glm::dvec3 expected = eye + depth * ray;
      // A float's precision of the distance and of the triangle's corners, across the angle of incidence.
      const double tolerance =
          (1e-6 * (depth + glm::length(eye)) + 5e-8 * glm::length(a)) / std::abs(glm::dot(glm::normalize(ray), normal));
      EXPECT_NEAR(position.w, depth, tolerance);
      EXPECT_LT(glm::distance(glm::dvec3(position), expected), tolerance);
      EXPECT_LT(std::abs(glm::dot(glm::dvec3(position) - a, normal)), 1e-7 * glm::length(a)) << "on the plane";
      const glm::vec4 shading = picture.at(picture.normal, x, y);
      EXPECT_LT(glm::distance(glm::dvec3(shading), normal), 1e-6);
      EXPECT_GT(shading.w, 0.0f);
    }
  EXPECT_GT(covered, 1000);
}

TEST_F(GBufferTest, FloorIsExactlyFlatAndDepthExact) {
  Scene scene;
  scene.materials.resize(1);
  addQuad(scene, {-50, 0.1f, 50}, {50, 0.1f, 50}, {50, 0.1f, -50}, {-50, 0.1f, -50}, 0);
  const Picture floor = draw(scene, cameraAt({0, 1.1f, 0}, {0, 0.1f, -2}), 32, 32);
  Scene wallScene;
  wallScene.materials.resize(1);
  addQuad(wallScene, {-9, -9, -3}, {9, -9, -3}, {9, 9, -3}, {-9, 9, -3}, 0);
  const Picture wall = draw(wallScene, cameraAt({0, 0, 0}, {0, 0, -1}), 33, 17);
  int surfaces = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      if (floor.id(x, y)) {
        ++surfaces;
        EXPECT_EQ(floor.at(floor.position, x, y).y, 0.1f);
      }
  EXPECT_GT(surfaces, 500);
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 33; ++x) {
      EXPECT_EQ(wall.at(wall.position, x, y).w, 3.0f);
      EXPECT_EQ(wall.at(wall.normal, x, y).z, 1.0f);
    }
}

// The rasterizer and the pixel's ray see the same sample: on edges between triangles each pixel names the one that its
// ray meets.
TEST_F(GBufferTest, JitterMovesWhatTheRasterizerSeesAndThePixelsRayAlike) {
  Scene scene;
  scene.materials.resize(1);
  for (int i = 0; i < 12; ++i) {
    const float x = 0.37f * static_cast<float>(i);
    addQuad(scene, {x, 0, 0}, {x + 0.37f, 0, 0}, {x + 0.6f, 4, 0}, {x + 0.23f, 4, 0}, 0);
  }
  const glm::vec2 jitter(0.41f, -0.27f);
  const Camera camera = cameraAt({2.2f, 2, 3.1f}, {2.3f, 2.1f, 0});
  const Picture centered = draw(scene, camera, 80, 60), picture = draw(scene, camera, 80, 60, {}, jitter);
  EXPECT_NE(picture.visibility, centered.visibility);
  int hits = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const glm::dvec3 eye(picture.frame.eye), ray = picture.ray(x, y);
      const glm::dvec3 point = eye - ray * (eye.z / ray.z);
      const double along = (point.x - 0.23 / 4 * point.y) / 0.37;
      if (point.y < 0 || point.y > 4 || std::abs(along - std::round(along)) < 1e-4) continue;
      const bool inside = along > 0 && along < 12;
      ASSERT_EQ(picture.id(x, y) != 0, inside) << x << ", " << y;
      if (!inside) continue;
      ++hits;
      EXPECT_EQ((picture.id(x, y) - 1) / 2, static_cast<std::uint32_t>(along)) << x << ", " << y;
      EXPECT_NEAR(glm::distance(glm::dvec3(picture.at(picture.position, x, y)), point), 0, 1e-5);
    }
  EXPECT_GT(hits, 2000);
}

TEST_F(GBufferTest, FarFromTheOriginStaysExact) {
  // Relative coordinates of a kilometre with a patch of centimetres.
  Scene scene;
  scene.materials.resize(1);
  const glm::vec3 center(1000, 500, -2000);
  addQuad(scene, center + glm::vec3(-0.5f, -0.5f, 0), center + glm::vec3(0.5f, -0.5f, 0),
          center + glm::vec3(0.5f, 0.5f, 0), center + glm::vec3(-0.5f, 0.5f, 0), 0);
  const Picture picture = draw(scene, cameraAt(center + glm::vec3(0, 0, 0.25f), center), 16, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      ASSERT_NE(picture.id(x, y), 0u);
      const glm::vec4 position = picture.at(picture.position, x, y);
      EXPECT_NEAR(position.w, 0.25f, 1e-7f);
      const glm::dvec3 expected = glm::dvec3(picture.frame.eye) + 0.25 * picture.ray(x, y);
      EXPECT_LT(glm::distance(glm::dvec3(position), expected), 2e-4);  // the spacing of floats at 2000
      EXPECT_EQ(position.z, -2000.0f);
    }
}

TEST_F(GBufferTest, NearestTriangleWinsAndEmptyPixelsAreZero) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].baseColor = {0.25f, 0.5f, 0.75f, 1};
  addQuad(scene, {-4, -4, -5}, {4, -4, -5}, {4, 4, -5}, {-4, 4, -5}, 0);                      // behind
  addQuad(scene, {-0.2f, -0.2f, -1}, {4, -0.2f, -1}, {4, 4, -1}, {-0.2f, 4, -1}, 1);          // before
  addQuad(scene, {-0.1f, -0.1f, 1}, {0.1f, -0.1f, 1}, {0.1f, 0.1f, 1}, {-0.1f, 0.1f, 1}, 1);  // behind the eye
  Camera camera = cameraAt({0, 0, 0}, {0, 0, -1});
  camera.verticalFov = 2.0f;
  const Picture picture = draw(scene, camera, 40, 40);
  EXPECT_TRUE(picture.id(30, 30) == 3 || picture.id(30, 30) == 4);
  EXPECT_EQ(picture.at(picture.position, 30, 30).w, 1.0f);
  EXPECT_NEAR(picture.at(picture.baseColor, 30, 30).g, 0.5f, 1e-3f);
  EXPECT_TRUE(picture.id(15, 15) == 1 || picture.id(15, 15) == 2);
  EXPECT_EQ(picture.at(picture.position, 15, 15).w, 5.0f);
  EXPECT_EQ(picture.id(0, 0), 0u);
  for (const auto* layer : {&picture.position, &picture.normal, &picture.baseColor, &picture.material})
    EXPECT_EQ(picture.at(*layer, 0, 0), glm::vec4(0));
}

TEST_F(GBufferTest, BackFaces) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].doubleSided = true;
  // Both turn their back; the left is single-sided.
  addQuad(scene, {0, -1, -2}, {-2, -1, -2}, {-2, 1, -2}, {0, 1, -2}, 0);
  addQuad(scene, {2, -1, -2}, {0, -1, -2}, {0, 1, -2}, {2, 1, -2}, 1);
  const Camera camera = cameraAt({0, 0, 0}, {0, 0, -1});
  const Picture culled = draw(scene, camera, 20, 20);
  EXPECT_EQ(culled.id(6, 10), 0u);
  EXPECT_NE(culled.id(13, 10), 0u);
  EXPECT_EQ(glm::vec3(culled.at(culled.normal, 13, 10)), glm::vec3(0, 0, 1)) << "faces the viewer";
  Settings settings;
  settings.scene.cullBackFaces = false;
  const Picture all = draw(scene, camera, 20, 20, settings);
  EXPECT_NE(all.id(6, 10), 0u);
  EXPECT_EQ(glm::vec3(all.at(all.normal, 6, 10)), glm::vec3(0, 0, 1));
}

TEST_F(GBufferTest, HolesShowWhatIsBehind) {
  Scene scene;
  auto texture = plainTexture(8, 8, {255, 255, 255, 255}, true);
  for (std::size_t i = 0; i < 64; ++i)
    if (i % 8 < 4) texture->texels[4 * i + 3] = 0;  // u below a half
  scene.textures = {texture};
  scene.materials.resize(2);
  scene.materials[0].alphaMode = AlphaMode::mask;
  scene.materials[0].baseColorTexture.texture = 0;
  scene.materials[0].baseColorTexture.wrapU = Wrap::clamp;
  addQuad(scene, {-2, -2, -2}, {2, -2, -2}, {2, 2, -2}, {-2, 2, -2}, 0);
  addQuad(scene, {-9, -9, -5}, {9, -9, -5}, {9, 9, -5}, {-9, 9, -5}, 1);
  const Picture picture = draw(scene, cameraAt({0, 0, 0}, {0, 0, -1}), 64, 64);
  int holes = 0, surfaces = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      // The leaf's uv at the pixel, by hand; the edge lies at u = 0.5.
      const double u = 0.5 + 2.0 * picture.ray(x, y).x / 4;
      if (std::abs(u - 0.5) < 1e-4 || u < 0 || u > 1) continue;
      const bool hole = u < 0.5;
      (hole ? holes : surfaces)++;
      EXPECT_EQ(picture.id(x, y) >= 3, hole) << x << ' ' << y;
    }
  EXPECT_GT(holes, 1000);
  EXPECT_GT(surfaces, 1000);
}

TEST_F(GBufferTest, NormalMapsTurnTheNormalTheRightWay) {
  // A map that leans along +u by 45 degrees, and one along +v.
  Scene scene;
  scene.textures = {plainTexture(4, 4, {218, 128, 218, 255}, false), plainTexture(4, 4, {128, 218, 218, 255}, false)};
  scene.materials.resize(2);
  scene.materials[0].normalTexture.texture = 0;
  scene.materials[1].normalTexture.texture = 1;
  addQuad(scene, {-2, -1, -2}, {-1, -1, -2}, {-1, 1, -2}, {-2, 1, -2}, 0);
  addQuad(scene, {-1, -1, -2}, {0, -1, -2}, {0, 1, -2}, {-1, 1, -2}, 1);
  // Mirrored uv: u runs to the left, so that the bitangent's sign is -1.
  addQuad(scene, {0, -1, -2}, {1, -1, -2}, {1, 1, -2}, {0, 1, -2}, 0);
  addQuad(scene, {1, -1, -2}, {2, -1, -2}, {2, 1, -2}, {1, 1, -2}, 1);
  for (std::size_t v = 8; v < 16; ++v) {
    scene.vertices[v].uv[0].x = 1 - scene.vertices[v].uv[0].x;
    scene.vertices[v].tangent = {-1, 0, 0, -1};
  }
  Camera camera = cameraAt({0, 0, 0}, {0, 0, -1});
  camera.verticalFov = 1.2f;
  const Picture picture = draw(scene, camera, 40, 20);
  const float s = std::sqrt(0.5f);
  const auto normalAt = [&](int x) { return glm::vec3(picture.at(picture.normal, x, 10)); };
  EXPECT_LT(glm::distance(normalAt(8), glm::vec3(s, 0, s)), 0.01f);
  EXPECT_LT(glm::distance(normalAt(16), glm::vec3(0, s, s)), 0.01f);
  EXPECT_LT(glm::distance(normalAt(24), glm::vec3(-s, 0, s)), 0.01f);
  EXPECT_LT(glm::distance(normalAt(32), glm::vec3(0, s, s)), 0.01f);
}

TEST_F(GBufferTest, MaterialValues) {
  Scene scene;
  // glTF: green roughness, blue metallic, red occlusion.
  scene.textures = {plainTexture(2, 2, {128, 51, 255, 255}, false), plainTexture(2, 2, {188, 255, 0, 255}, true)};
  scene.materials.resize(4);
  Material& metal = scene.materials[0];
  metal.metallicRoughnessTexture.texture = 0;
  metal.occlusionTexture.texture = 0;
  metal.occlusionStrength = 0.5f;
  metal.baseColorTexture.texture = 1;
  metal.emissive = {2, 3, 4};
  Material& glass = scene.materials[1];
  glass.metallic = 0;
  glass.roughness = 0.2f;
  glass.ior = 1.5f;
  Material& mirror = scene.materials[2];
  mirror.mirror = 0.7f;
  mirror.baseColor = {0.1f, 0.2f, 0.3f, 1};
  scene.materials[3].unlit = true;
  for (std::uint32_t m = 0; m < 4; ++m) {
    const float x = static_cast<float>(m) - 2;
    addQuad(scene, {x, -1, -2}, {x + 1, -1, -2}, {x + 1, 1, -2}, {x, 1, -2}, m);
  }
  Camera camera = cameraAt({0, 0, 0}, {0, 0, -1});
  camera.verticalFov = 1.2f;
  const Picture picture = draw(scene, camera, 40, 20);
  const auto at = [&](const std::vector<glm::vec4>& layer, int m) { return picture.at(layer, 8 + 8 * m, 10); };
  EXPECT_NEAR(at(picture.baseColor, 0).r, 0.5029f, 2e-3f);
  EXPECT_NEAR(at(picture.baseColor, 0).g, 1.0f, 2e-3f);
  EXPECT_NEAR(at(picture.baseColor, 0).a, 0.751f, 2e-3f);
  EXPECT_NEAR(at(picture.material, 0).a, 0.2f, 1e-3f);
  EXPECT_NEAR(at(picture.material, 0).r, 0.5029f, 2e-3f) << "metal reflects its base color";
  EXPECT_NEAR(at(picture.emissive, 0).a, 1.0f, 1e-3f);
  EXPECT_NEAR(at(picture.emissive, 0).b, 4.0f, 1e-2f);
  const float luminance = 0.2126f * 0.5029f + 0.7152f;
  EXPECT_NEAR(at(picture.normal, 0).w, luminance * (1 - 0.2f / 0.4f), 2e-3f);
  EXPECT_NEAR(at(picture.material, 1).g, 0.04f, 1e-4f);
  EXPECT_NEAR(at(picture.normal, 1).w, 0.02f, 1e-4f);
  EXPECT_NEAR(at(picture.material, 2).r, 0.7f, 1e-3f);
  EXPECT_EQ(at(picture.material, 2).a, 0.0f);
  EXPECT_NEAR(at(picture.normal, 2).w, 0.7f, 1e-4f);
  EXPECT_NEAR(at(picture.baseColor, 2).b, 0.3f, 1e-3f);
  EXPECT_EQ(at(picture.material, 3).a, -1.0f);
  EXPECT_EQ(at(picture.normal, 3).w, 0.0f);
}

TEST_F(GBufferTest, DistantTexturesAreFiltered) {
  Scene scene;
  auto checker = plainTexture(64, 64, {0, 0, 0, 255}, false);
  for (std::size_t i = 0; i < 64 * 64; ++i)
    if ((i + i / 64) % 2) checker->texels[4 * i] = 255;
  scene.textures = {checker};
  scene.materials.resize(1);
  scene.materials[0].baseColorTexture.texture = 0;
  scene.materials[0].baseColorTexture.transform = {glm::vec3(50, 0, 0), glm::vec3(0, 50, 0)};
  addQuad(scene, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, {-50, 0, -50}, 0);
  const Picture picture = draw(scene, cameraAt({0.2f, 1, 0}, {0.3f, 0.7f, -1}), 64, 64);
  double sum = 0, squares = 0, count = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      if (picture.at(picture.position, x, y).w < 3) continue;  // a texel is three centimetres
      const double value = picture.at(picture.baseColor, x, y).r;
      sum += value;
      squares += value * value;
      ++count;
    }
  ASSERT_GT(count, 300);
  EXPECT_NEAR(sum / count, 0.5, 0.01);
  EXPECT_LT(squares / count - sum * sum / (count * count), 0.06 * 0.06) << "not filtered";
}

}  // namespace
}  // namespace halfsilver
