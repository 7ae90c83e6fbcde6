// Smooth edges: stills of many samples, the edges of one picture, frames joined over time.
#include <algorithm>
#include <cmath>
#include <vector>

#include "gpu/light_fixture.h"
#include "gpu/smooth_edges.h"

namespace halfsilver::testing {
namespace {

// Diagonal stripes on a wall, three pixels wide from roomCamera(), and a mirror floor before it.
Scene stripedRoom() {
  Scene scene;
  const std::uint32_t dark = addMaterial(scene, diffuse({0.05f, 0.05f, 0.1f}));
  const std::uint32_t bright = addMaterial(scene, diffuse({0.9f, 0.7f, 0.4f}));
  const std::uint32_t floor = addMaterial(scene, mirror(0.8f, glm::vec3(0.1f)));
  addQuad(scene, {0, 0, -3}, {4, 0, 0}, {0, 3, 0}, dark);
  for (int i = -6; i < 7; ++i)
    addQuad(scene, {0.65f * static_cast<float>(i), 0.3f, -2.98f}, {0.16f, 0.03f, 0}, {0.31f, 0.9f, 0}, bright);
  addQuad(scene, {0, -0.8f, -1}, {4, 0, 0}, {0, 0, -2}, floor);
  scene.sky = evenSky(glm::vec3(1));
  return scene;
}

Camera roomCamera(float x = 0) { return lookAt({x, 0.4f, 1.5f}, {x, 0, -3}); }

Settings smooth(const char* antialiasing) {
  return settingsWith({{"trace.method", "exact"}, {"image.antialiasing", antialiasing}});
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return largest;
}

class Samples : public SmoothEdges {};

TEST_F(Samples, OneSampleIsTheFrame) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const Settings settings = smooth("none");
  const std::vector<float> plain = frame(renderer, roomCamera(), settings);
  const std::vector<float> plainShown = shown();
  EXPECT_GT(rmse(plain, std::vector<float>(plain.size(), plain[0])), 0.05) << "there must be something to see";
  EXPECT_EQ(samples(renderer, roomCamera(), settings, 1), plain);
  EXPECT_EQ(shown(), plainShown);
}

TEST_F(Samples, ErrorFallsAtLeastAsTheRootOfTheirNumber) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const std::vector<float> truth = samples(renderer, roomCamera(), smooth("none"), 512);
  double before = 0;
  for (const std::uint32_t count : {1u, 4u, 16u, 64u}) {
    SCOPED_TRACE(count);
    const double error = rmse(samples(renderer, roomCamera(), smooth("none"), count), truth);
    EXPECT_GT(error, 1e-5);
    if (count > 1) {
      EXPECT_LT(error, 0.55 * before);
    }
    before = error;
  }
}

TEST_F(Samples, LayersBesideTheColorAreThoseOfTheLastSample) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const Frame plain = drawWith(renderer, roomCamera(), smooth("none"), kWidth, kHeight);
  renderer.refine(roomCamera(), smooth("none"), target_, 1);
  const Image beside = renderer.readLayers();
  renderer.refine(roomCamera(), smooth("none"), target_, 0);
  const Frame both{renderer.readLayers(), renderer.report()};
  EXPECT_NE(both.plane("R"), plain.plane("R"));
  EXPECT_NE(Frame({beside, {}}).plane("depth.Z"), plain.plane("depth.Z"));
  for (const char* layer : {"depth.Z", "normal.Z", "hit.T", "hit.id", "reflection.G"})
    EXPECT_EQ(both.plane(layer), plain.plane(layer)) << layer;
  EXPECT_GE(both.report.memory.pictures, 16u * kWidth * kHeight);
}

TEST_F(Samples, BeginAnewIfAnythingOfThePictureChanges) {
  Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const auto refine = [&](const Camera& camera, const Settings& settings, const Target& target) {
    renderer.refine(camera, settings, target, renderer.samples());
    return renderer.samples();
  };
  Settings settings = smooth("none");
  EXPECT_EQ(refine(roomCamera(), settings, target_), 1u);
  EXPECT_EQ(refine(roomCamera(), settings, target_), 2u);
  settings.image.exposure = 1;
  EXPECT_EQ(refine(roomCamera(), settings, target_), 3u) << "the light is the same";
  EXPECT_EQ(refine(roomCamera(0.1f), settings, target_), 1u);
  settings.trace.bounces = 2;
  EXPECT_EQ(refine(roomCamera(0.1f), settings, target_), 1u);
  EXPECT_EQ(refine(roomCamera(0.1f), settings, {target_.framebuffer, 0, 0, 32, 32}), 1u);
  EXPECT_EQ(refine(roomCamera(0.1f), settings, {target_.framebuffer, 0, 0, 32, 32}), 2u);
  scene.sky = evenSky(glm::vec3(0.5f));
  renderer.update(scene, {.sky = true});
  EXPECT_EQ(refine(roomCamera(0.1f), settings, {target_.framebuffer, 0, 0, 32, 32}), 1u);
  renderer.forgetHistory();
  EXPECT_EQ(refine(roomCamera(0.1f), settings, {target_.framebuffer, 0, 0, 32, 32}), 1u);
}

class Fxaa : public SmoothEdges {};

TEST_F(Fxaa, BringsEdgesNearerToManySamplesAndLeavesTheRest) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  samples(renderer, roomCamera(), smooth("none"), 64);
  const std::vector<float> truth = shown();
  frame(renderer, roomCamera(), smooth("none"));
  const std::vector<float> plain = shown();
  const std::vector<float> radiance = frame(renderer, roomCamera(), smooth("fxaa"));
  const std::vector<float> smoothed = shown();
  EXPECT_GT(rmse(plain, truth), 0.02);
  EXPECT_LT(rmse(smoothed, truth), 0.85 * rmse(plain, truth));
  EXPECT_EQ(radiance, frame(renderer, roomCamera(), smooth("none"))) << "the layers are not concerned";
  std::size_t changed = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) changed += std::abs(plain[i] - smoothed[i]) > 1.5f / 255;
  EXPECT_LT(changed, plain.size() / 2);
}

class Temporal : public SmoothEdges {
 protected:
  std::vector<float> frames(Renderer& renderer, const Camera& camera, int count) {
    std::vector<float> last;
    for (int i = 0; i < count; ++i) last = frame(renderer, camera, smooth("temporal"));
    return last;
  }
};

TEST_F(Temporal, AStillCameraGivesTheMeanOfSamples) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const std::vector<float> mean = samples(renderer, roomCamera(), smooth("none"), 16);
  EXPECT_LT(largestDifference(frames(renderer, roomCamera(), 16), mean), 1e-5);
}

TEST_F(Temporal, AMovingCameraComesNearerToManySamples) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  double plain = 0, joined = 0;
  for (int step = 0; step < 16; ++step) {
    const Camera camera = roomCamera(0.013f * static_cast<float>(step));
    const std::vector<float> found = frame(renderer, camera, smooth("temporal"));
    if (step < 8) continue;
    Renderer other = makeRenderer(scene);
    const std::vector<float> truth = samples(other, camera, smooth("none"), 64);
    plain += rmse(frame(other, camera, smooth("none")), truth);
    joined += rmse(found, truth);
  }
  EXPECT_GT(plain / 8, 0.02);
  EXPECT_LT(joined, 0.3 * plain);
}

// Turned by so many pixels to the right and, half as many, up.
Camera turned(Camera camera, float pixels, int height) {
  const float pixel = 2 * std::tan(0.5f * camera.verticalFov) / static_cast<float>(height);
  const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
  camera.target = camera.eye + forward + pixels * pixel * (right + 0.5f * glm::cross(right, forward));
  return camera;
}

// Changes of values from one picture to the next beyond those of the truth.
double flicker(const std::vector<std::vector<float>>& pictures, const std::vector<std::vector<float>>& truth) {
  double sum = 0;
  for (std::size_t step = 1; step < truth.size(); ++step)
    for (std::size_t i = 0; i < truth[step].size(); ++i)
      sum += std::max(
          0.0f, std::abs(pictures[step][i] - pictures[step - 1][i]) - std::abs(truth[step][i] - truth[step - 1][i]));
  return sum;
}

TEST_F(Temporal, ASlowPanFlickersAtMostAQuarterAsMuch) {
  const Scene scene = stripedRoom();
  Renderer joined = makeRenderer(scene), plain = makeRenderer(scene), many = makeRenderer(scene);
  std::vector<std::vector<float>> withHistory, single, truth;
  for (int step = 0; step < 32; ++step) {
    const Camera camera = turned(roomCamera(), 0.25f * static_cast<float>(step), kHeight);
    const std::vector<float> found = frame(joined, camera, smooth("temporal"));
    if (step < 24) continue;
    withHistory.push_back(found);
    single.push_back(frame(plain, camera, smooth("none")));
    truth.push_back(samples(many, camera, smooth("none"), 64));
  }
  EXPECT_GT(flicker(single, truth) / static_cast<double>(7 * single[0].size()), 0.01);
  EXPECT_LT(flicker(withHistory, truth), 0.25 * flicker(single, truth));
}

TEST_F(Temporal, ASmallerPictureBeginsAnotherHistory) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene), fresh = makeRenderer(scene);
  const Target small{target_.framebuffer, 0, 0, kWidth / 2, kHeight / 2};
  const auto last = [&](Renderer& drawing) {
    for (float x : {0.0f, 0.02f}) drawing.render(roomCamera(x), smooth("temporal"), small);
    return std::pair(colors(drawing.readLayers()), drawing.report().memory.pictures);
  };
  frames(renderer, roomCamera(0.1f), 3);
  EXPECT_EQ(last(renderer), last(fresh));
}

TEST_F(Temporal, AStoppedCameraConverges) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  for (int step = 0; step < 6; ++step)
    frame(renderer, roomCamera(0.05f * static_cast<float>(step)), smooth("temporal"));
  const Camera camera = roomCamera(0.3f);
  const double moving = [&] {
    Renderer other = makeRenderer(scene);
    return rmse(frames(renderer, camera, 1), samples(other, camera, smooth("none"), 256));
  }();
  Renderer other = makeRenderer(scene);
  const std::vector<float> truth = samples(other, camera, smooth("none"), 256);
  const double settled = rmse(frames(renderer, camera, 40), truth), later = rmse(frames(renderer, camera, 80), truth);
  EXPECT_LT(settled, 0.5 * moving);
  EXPECT_LT(later, 0.7 * settled);
}

// A box that jumps, its image in the floor and its shadow: four frames later nothing of them is left where they were.
TEST_F(Temporal, NothingOfAFastObjectIsLeftAfterFourFrames) {
  Scene scene = stripedRoom();
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  addBox(scene, {-1.3f, -0.7f, -1.6f}, {-0.8f, 0, -1.2f}, addMaterial(scene, diffuse({1, 0, 0})));
  scene.lights = {sun({0.3f, -1, -0.5f}, 2)};
  const VertexRange box{first, static_cast<std::uint32_t>(scene.vertices.size()) - first};
  Renderer renderer = makeRenderer(scene);
  const std::vector<float> before = frames(renderer, roomCamera(), 24);
  for (std::uint32_t v = box.first; v < box.first + box.count; ++v) scene.vertices[v].position.x += 1.9f;
  renderer.updateVertices(scene, std::span(&box, 1));
  const std::vector<float> after = frames(renderer, roomCamera(), 4);

  Renderer other = makeRenderer(scene);
  const std::vector<float> truth = samples(other, roomCamera(), smooth("none"), 64);
  const auto column = [](std::size_t i) { return static_cast<int>(i / 3) % kWidth; };
  double gone = 0, ghost = 0;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (column(i) >= kWidth / 2) continue;
    if (std::abs(before[i] - truth[i]) < 0.1f) continue;
    ++changed;
    gone += std::abs(static_cast<double>(before[i] - truth[i]));
    ghost += std::abs(static_cast<double>(after[i] - truth[i]));
  }
  EXPECT_GT(changed, 300u);
  // What is left is the error of four samples, and hardly a trace of the box.
  Renderer fresh = makeRenderer(scene);
  const std::vector<float> four = frames(fresh, roomCamera(), 4);
  double noise = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (column(i) < kWidth / 2 && std::abs(before[i] - truth[i]) >= 0.1f)
      noise += std::abs(static_cast<double>(four[i] - truth[i]));
  EXPECT_LT(ghost, noise + 0.02 * gone);
}

TEST_F(Temporal, ACutLeavesNothingOfTheFrameBefore) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const std::vector<float> alone = frames(renderer, roomCamera(1), 2);
  renderer.setScene(scene);
  frames(renderer, roomCamera(), 3);
  renderer.forgetHistory();
  EXPECT_EQ(frames(renderer, roomCamera(1), 2), alone);
  // Without being told, the history is followed.
  renderer.setScene(scene);
  frames(renderer, roomCamera(), 3);
  EXPECT_NE(frames(renderer, roomCamera(1), 2), alone);
}

TEST_F(Temporal, SamplesOfAStillInBetweenBeginAnotherHistory) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const std::vector<float> alone = frames(renderer, roomCamera(1), 2);
  renderer.setScene(scene);
  frames(renderer, roomCamera(), 3);
  samples(renderer, roomCamera(), smooth("temporal"), 4);
  EXPECT_EQ(frames(renderer, roomCamera(1), 2), alone);
}

TEST_F(Temporal, AFrameThatCannotBeDrawnBeginsAnotherHistory) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  const std::vector<float> alone = frames(renderer, roomCamera(1), 2);
  renderer.setScene(scene);
  Camera nowhere = roomCamera(1);
  nowhere.target = nowhere.eye;
  EXPECT_THROW(frame(renderer, nowhere, smooth("temporal")), Error);
  EXPECT_EQ(frames(renderer, roomCamera(1), 2), alone);
}

TEST_F(Temporal, FramesUnderWayAreThoseThatFollowEachOther) {
  const Scene scene = stripedRoom();
  const auto cameraAt = [](int step) { return roomCamera(0.02f * static_cast<float>(step)); };
  Renderer inTurn = makeRenderer(scene), ahead = makeRenderer(scene);
  const Settings settings = smooth("temporal");
  ahead.begin(cameraAt(0), settings, kWidth, kHeight);
  for (int step = 0; step < 5; ++step) {
    SCOPED_TRACE(step);
    const std::vector<float> expected = frame(inTurn, cameraAt(step), settings);
    const std::vector<float> expectedShown = shown();
    ahead.begin(cameraAt(step + 1), settings, kWidth, kHeight);
    ahead.finish(target_);
    EXPECT_EQ(colors(ahead.readLayers()), expected);
    EXPECT_EQ(shown(), expectedShown);
  }
  ahead.finish(target_);
}

TEST_F(Temporal, OtherSettingsTakeItsMemoryBack) {
  const Scene scene = stripedRoom();
  Renderer renderer = makeRenderer(scene);
  frames(renderer, roomCamera(), 1);
  EXPECT_GE(renderer.report().memory.pictures, 300u * kWidth * kHeight);
  frame(renderer, roomCamera(), smooth("none"));
  EXPECT_EQ(renderer.report().memory.pictures, 0u);
}

}  // namespace
}  // namespace halfsilver::testing
