// Whether what moves slowly stays in its place when frames are joined over time, seen directly and in mirrors.
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <span>
#include <vector>

#include <halfsilver/builtin.h>
#include "gpu/light_fixture.h"
#include "gpu/smooth_edges.h"

namespace halfsilver::testing {
namespace {

// A wall of 8 m with a sine wave across or up, `length` meters long, that shines by itself.
Material waves(Scene& scene, double length, bool across) {
  constexpr int kTexels = 64;
  auto texture = std::make_shared<Texture>(Texture{"waves", kTexels, kTexels, false, {}});
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      const double angle = 2 * glm::pi<double>() * ((across ? x : y) + 0.5) / kTexels;
      const auto gray = static_cast<std::uint8_t>(std::lround(127.5 + 100 * std::cos(angle)));
      texture->texels.insert(texture->texels.end(), {gray, gray, gray, 255});
    }
  scene.textures = {texture};
  Material material = diffuse(glm::vec3(1));
  material.unlit = true;
  material.baseColorTexture.texture = 0;
  material.baseColorTexture.mipmaps = false;
  const auto repeats = static_cast<float>(8 / length);
  material.baseColorTexture.transform = {glm::vec3(repeats, 0, 0), glm::vec3(0, repeats, 0)};
  return material;
}

class TemporalLag : public SmoothEdges {
 protected:
  // Meters or, of a direction, tangents that a pixel covers at such a distance.
  static double pixelAt(double distance) { return 2 * distance * std::tan(glm::pi<double>() / 6) / kHeight; }

  // Amplitude and phase of a wave in the middle of a picture.
  static std::complex<double> wave(const std::vector<float>& picture, double period, bool across) {
    constexpr int kMiddle = 24;
    std::complex<double> sum;
    for (int y = (kHeight - kMiddle) / 2; y < (kHeight + kMiddle) / 2; ++y)
      for (int x = (kWidth - kMiddle) / 2; x < (kWidth + kMiddle) / 2; ++x)
        sum += static_cast<double>(picture[3 * (static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x))]) *
               std::polar(1.0, -2 * glm::pi<double>() * (across ? x : y) / period);
    return 2.0 * sum / static_cast<double>(kMiddle * kMiddle);
  }

  // Draws frames of a slow motion; the last must show a wave of `period` pixels in its place and sharp. `move` brings
  // a frame about in both renderers, one of which draws frames of their own.
  void expectInPlace(const Scene& scene, double period, bool across,
                     const std::function<Camera(int, std::vector<Renderer*>)>& move) {
    constexpr int kFrames = 48, kCounted = 16;
    const auto settings = [](const char* antialiasing) {
      return settingsWith({{"trace.method", "exact"}, {"image.antialiasing", antialiasing}});
    };
    Renderer joined = makeRenderer(scene), plain = makeRenderer(scene);
    // What a pixel's box filter leaves of the contrast.
    const double box = std::sin(glm::pi<double>() / period) / (glm::pi<double>() / period);
    double lag = 0, contrast = 0;
    for (int step = 0; step < kFrames; ++step) {
      const Camera camera = move(step, {&joined, &plain});
      const std::vector<float> found = frame(joined, camera, settings("temporal"));
      if (step < kFrames - kCounted) continue;
      const std::complex<double> truth = wave(frame(plain, camera, settings("none")), period, across);
      EXPECT_GT(std::abs(truth), 0.3);
      const std::complex<double> error = wave(found, period, across) / truth;
      lag += std::arg(error) / (2 * glm::pi<double>()) * period / kCounted;
      contrast += std::abs(error) / box / kCounted;
    }
    EXPECT_LT(std::abs(lag), 0.05);
    EXPECT_GT(contrast, 0.9);
  }
};

TEST_F(TemporalLag, ASlowPanKeepsAPatternInItsPlaceAndSharp) {
  constexpr double kDistance = 2;
  for (const bool across : {true, false})
    for (const double period : {6.0, 12.0})
      for (const double speed : {0.1, 0.25, 0.4}) {
        SCOPED_TRACE(::testing::Message() << (across ? "across, " : "up, ") << period << " pixels, " << speed);
        Scene scene;
        const Material material = waves(scene, period * pixelAt(kDistance), across);
        addQuad(scene, {0, 0, -kDistance}, {4, 0, 0}, {0, 4, 0}, addMaterial(scene, material));
        expectInPlace(scene, period, across, [&](int step, const std::vector<Renderer*>&) {
          const auto way = static_cast<float>(pixelAt(kDistance) * speed * step);
          const glm::vec3 eye = across ? glm::vec3(way, 0, 0) : glm::vec3(0, way, 0);
          return lookAt(eye, eye - glm::vec3(0, 0, 1));
        });
      }
}

// A mirror 0.5 m before the camera that shows a wall 0.5 m behind it; its image is 1.5 m away.
class TemporalMirrorLag : public TemporalLag {
 protected:
  static constexpr double kPeriod = 12, kSpeed = 0.25;
  TemporalMirrorLag() { addQuad(scene_, {0, 0, -0.5f}, {2, 0, 0}, {0, 2, 0}, addMaterial(scene_, mirror(1))); }
  void addWall() {
    const Material material = waves(scene_, kPeriod * pixelAt(1.5), true);
    first_ = static_cast<std::uint32_t>(scene_.vertices.size());
    addQuad(scene_, {0, 0, 0.5f}, {-4, 0, 0}, {0, 4, 0}, addMaterial(scene_, material));
  }
  static float way(int step, double distance) { return static_cast<float>(pixelAt(distance) * kSpeed * step); }

  Scene scene_;
  std::uint32_t first_ = 0;
};

TEST_F(TemporalMirrorLag, AMovingCameraSeesTheImageInItsPlace) {
  addWall();
  expectInPlace(scene_, kPeriod, true, [&](int step, const std::vector<Renderer*>&) {
    const glm::vec3 eye(way(step, 1.5), 0, 0);
    return lookAt(eye, eye - glm::vec3(0, 0, 1));
  });
}

TEST_F(TemporalMirrorLag, AMovingThingHasItsImageInItsPlace) {
  addWall();
  const std::vector<Vertex> atRest = scene_.vertices;
  const VertexRange wall{first_, static_cast<std::uint32_t>(atRest.size()) - first_};
  expectInPlace(scene_, kPeriod, true, [&](int step, const std::vector<Renderer*>& renderers) {
    for (std::uint32_t v = wall.first; v < wall.first + wall.count; ++v)
      scene_.vertices[v].position.x = atRest[v].position.x + way(step, 1.5);
    for (Renderer* renderer : renderers) renderer->updateVertices(scene_, std::span(&wall, 1));
    return lookAt({0, 0, 0}, {0, 0, -1});
  });
}

// What is infinitely far away moves with the camera's turns alone.
TEST_F(TemporalMirrorLag, TheSkyInAMirrorStaysInItsPlace) {
  constexpr int kWaves = 22;
  scene_.sky.imageWidth = 1024;
  scene_.sky.imageHeight = 2;
  for (int i = 0; i < 2 * scene_.sky.imageWidth; ++i)
    scene_.sky.image.insert(scene_.sky.image.end(), 3,
                            0.5f + 0.4f * std::cos(glm::two_pi<float>() * kWaves * static_cast<float>(i) / 1024));
  const double period = glm::two_pi<double>() / kWaves / pixelAt(1);
  expectInPlace(scene_, period, true, [&](int step, const std::vector<Renderer*>&) {
    const glm::vec3 eye(way(step, 0.5), 0, 0);  // the mirror moves on the screen, too
    return lookAt(eye, eye + glm::vec3(way(step - 24, 1), 0, -1));
  });
}

// A ball shows its surroundings close behind its surface, wherever they are.
TEST_F(TemporalLag, AMirrorBallComesNearerToManySamples) {
  const Scene scene = makeBuiltin("sphere").scene;
  Renderer renderer = makeRenderer(scene), other = makeRenderer(scene);
  const auto clipped = [](std::vector<float> colors) {
    for (float& value : colors) value = std::min(value, 1.0f);
    return colors;
  };
  double plain = 0, joined = 0;
  for (int step = 0; step < 24; ++step) {
    Camera camera = scene.cameras.front();
    camera.eye.x += 0.01f * static_cast<float>(step);
    const std::vector<float> found =
        clipped(frame(renderer, camera, settingsWith({{"image.antialiasing", "temporal"}})));
    if (step < 20) continue;
    const std::vector<float> truth = clipped(samples(other, camera, settingsWith({}), 64));
    plain += rmse(clipped(frame(other, camera, settingsWith({}))), truth);
    joined += rmse(found, truth);
  }
  EXPECT_GT(plain / 4, 0.02);
  EXPECT_LT(joined, 0.4 * plain);
}

}  // namespace
}  // namespace halfsilver::testing
