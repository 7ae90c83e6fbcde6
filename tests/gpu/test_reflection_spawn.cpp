#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <halfsilver/ray_reader.h>
#include "effects/reflection/reflection_effect.h"
#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "frame/surface_reader.h"
#include "gpu/context_fixture.h"
#include "gpu/shader_function.h"
#include "passes/gbuffer.h"

namespace halfsilver {
namespace {

using testing::addQuad;

struct Selection {
  shared::RayCount count{};
  std::vector<shared::Ray> rays;
  std::vector<std::uint32_t> pixelsOfRays;  // of the same rays
  std::vector<std::uint32_t> pixels;        // sorted
  std::vector<glm::vec4> position;
  std::vector<GLuint> contributions;
  shared::FrameConstants frame{};
};

class ReflectionSpawn : public testing::ContextTest {
 protected:
  // Left half mirror, right half rough, a strip at the top without surface.
  static Scene twoWalls() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].mirror = 0.8f;
    scene.materials[1].roughness = 1;
    addQuad(scene, {-9, -9, -3}, {0, -9, -3}, {0, 1, -3}, {-9, 1, -3}, 0);
    addQuad(scene, {0, -9, -3}, {9, -9, -3}, {9, 1, -3}, {0, 1, -3}, 1);
    return scene;
  }

  // All of the screen.
  static Scene mirrorWall() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].mirror = 1.0f;
    addQuad(scene, {-9, -9, -3}, {9, -9, -3}, {9, 9, -3}, {-9, 9, -3}, 0);
    return scene;
  }

  float shade = 0;  // deferred radiance of all pixels

  Selection select(const Scene& scene, const Settings& settings, int width, int height) {
    const GpuScene gpu = uploadScene(api, scene);
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.target = {0, 0, -1};
    Selection result;
    result.frame = makeFrameConstants(camera, gpu.extents.bounds(), scene.sky, settings, width, height, {});
    const gl::Buffer constants =
        gl::makeBuffer(api, std::span<const shared::FrameConstants>(&result.frame, 1), "frame");
    gl::Profiler profiler(api);
    const ShadowMaps unshadowed;
    GBuffer buffer;
    const FrameView view{gpu, unshadowed, constants, result.frame, profiler, buffer};
    GBufferPass(api).run(view, buffer);
    const glm::vec4 shaded(glm::vec3(shade), 0);
    api.ClearTexImage(buffer.shaded.name(), 0, GL_RGBA, GL_FLOAT, &shaded);
    ReflectionEffect effect(api);
    RayQueue queue;
    EffectFrame frame;
    effect.spawn(view, 0, 1, queue, frame);
    effect.spawn(view, 0, 1, queue, frame);  // a second frame starts from zero
    effect.measure(view, queue, frame);
    EXPECT_EQ(queue.capacity, static_cast<std::uint32_t>(width * height));
    EXPECT_LE(queue.bytes(), 4u * queue.capacity + 16 + sizeof(shared::RayCount)) << "a pixel is four bytes";
    result.count = queue.count.read<shared::RayCount>(1)[0];
    EXPECT_EQ(result.count.source, RAYS_OF_PIXELS);
    RayReader reader(api);
    reader.submit(view, queue, result.count.count);
    const std::span<const shared::Ray> rays = reader.rays(view, queue);
    result.rays.assign(rays.begin(), rays.end());
    result.pixelsOfRays = result.pixels = queue.rays.read<std::uint32_t>(result.count.count);
    result.contributions = frame.contributions.counts.read<GLuint>(CONTRIBUTION_CLASSES);
    EXPECT_GE(frame.slots.bytes(), result.pixels.size() * sizeof(shared::Radiance));
    std::sort(result.pixels.begin(), result.pixels.end());
    result.position = SurfaceReader(api).read(view).positions;
    EXPECT_EQ(std::set<std::uint32_t>(result.pixels.begin(), result.pixels.end()).size(), result.pixels.size());
    return result;
  }
};

// Ten rows of tiles in six batches would be two rows each, which fill five.
TEST_F(ReflectionSpawn, NoBatchIsEmpty) {
  const ReflectionEffect effect(api);
  GBuffer buffer;
  buffer.width = 64;
  buffer.height = 77;
  const GpuScene scene;
  const ShadowMaps unshadowed;
  const gl::Buffer constants;
  const shared::FrameConstants frame{};
  gl::Profiler profiler(api);
  const FrameView view{scene, unshadowed, constants, frame, profiler, buffer};
  for (std::uint32_t tiles = 1; tiles <= 10; ++tiles) {
    const int rows = 8 * static_cast<int>(tiles);
    const int batches = effect.batches(view, {}, tiles * 8 * 64);
    EXPECT_EQ(batches, (buffer.height + rows - 1) / rows) << tiles << " rows of tiles fit";
  }
}

TEST_F(ReflectionSpawn, ReflectivePixelsOnly) {
  const int width = 101, height = 67;
  const Selection selection = select(twoWalls(), {}, width, height);
  std::size_t expected = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec4& position = selection.position[static_cast<std::size_t>(y * width + x)];
      expected += position[3] > 0 && position[0] < 0;
    }
  ASSERT_GT(expected, 1500u);
  EXPECT_NEAR(static_cast<double>(selection.count.count), static_cast<double>(expected), height);  // the middle column
  EXPECT_EQ(selection.count.reflecting, selection.count.count);
  EXPECT_EQ(selection.count.groupsX, (selection.count.count + 63) / 64);
  EXPECT_EQ(selection.count.groupsY, 1u);
  EXPECT_EQ(selection.count.groupsZ, 1u);
  for (std::size_t i = 0; i < selection.rays.size(); ++i) {
    const shared::Ray& ray = selection.rays[i];
    const std::uint32_t pixel = selection.pixelsOfRays[i];
    const glm::vec4& position = selection.position[pixel];
    EXPECT_EQ(ray.origin, glm::vec3(position));
    EXPECT_EQ(ray.maxDistance, FAR_AWAY);
    // The wall's normal is +z: x and y go on, z turns round.
    const glm::vec3 view = glm::normalize(glm::vec3(position));
    EXPECT_LT(glm::distance(ray.direction, glm::vec3(view.x, view.y, -view.z)), 1e-6f);
    EXPECT_LT(ray.excluded, 2u);
  }
}

TEST_F(ReflectionSpawn, Modes) {
  Settings settings;
  settings.select.mode = SelectMode::all;
  const Selection all = select(twoWalls(), settings, 64, 64);
  std::size_t surfaces = 0;
  for (const glm::vec4& position : all.position) surfaces += position.w > 0;
  EXPECT_EQ(all.count.count, surfaces);
  EXPECT_GT(surfaces, 2000u);
  EXPECT_LT(surfaces, 4096u);

  settings.select.mode = SelectMode::none;
  const Selection none = select(twoWalls(), settings, 64, 64);
  EXPECT_EQ(none.count.count, 0u);
  EXPECT_EQ(none.count.groupsX, 0u);
  EXPECT_EQ(none.count.groupsY, 1u);

  settings.select.mode = SelectMode::reflective;
  settings.select.minReflectivity = 0.9f;
  EXPECT_EQ(select(twoWalls(), settings, 64, 64).count.count, 0u);
  settings.select.minReflectivity = 0.7f;
  EXPECT_GT(select(twoWalls(), settings, 64, 64).count.count, 1000u);
}

TEST_F(ReflectionSpawn, FractionsAreExactNestedAndEven) {
  const Scene scene = mirrorWall();
  const int width = 150, height = 130;
  const double pixels = width * height;
  std::vector<std::uint32_t> smaller;
  for (const float fraction : {0.0f, 0.05f, 0.25f, 0.5f, 0.77f, 1.0f}) {
    Settings settings;
    settings.select.fraction = fraction;
    const Selection selection = select(scene, settings, width, height);
    EXPECT_EQ(selection.count.reflecting, static_cast<std::uint32_t>(pixels));
    EXPECT_NEAR(selection.count.count / pixels, fraction, fraction == 0 || fraction == 1 ? 0 : 0.01);
    EXPECT_TRUE(std::includes(selection.pixels.begin(), selection.pixels.end(), smaller.begin(), smaller.end()));
    // Every block of 10 x 10 pixels has its share.
    std::vector<int> blocks(15 * 13, 0);
    for (const std::uint32_t pixel : selection.pixels)
      ++blocks[static_cast<std::size_t>((pixel / width) / 10 * 15 + (pixel % width) / 10)];
    for (const int block : blocks) EXPECT_NEAR(block, 100 * fraction, 9) << "fraction " << fraction;
    smaller = selection.pixels;
  }
  EXPECT_EQ(smaller.size(), static_cast<std::size_t>(pixels));
}

TEST_F(ReflectionSpawn, RegionsAreNestedRectanglesAroundTheCenter) {
  const Scene scene = mirrorWall();
  const int width = 150, height = 131;
  std::vector<std::uint32_t> smaller;
  for (const float fraction : {0.0f, 0.001f, 0.05f, 0.25f, 0.5f, 0.77f, 1.0f}) {
    SCOPED_TRACE(fraction);
    Settings settings;
    settings.select.pattern = SelectPattern::region;
    settings.select.fraction = fraction;
    const Selection selection = select(scene, settings, width, height);
    EXPECT_TRUE(std::includes(selection.pixels.begin(), selection.pixels.end(), smaller.begin(), smaller.end()));
    smaller = selection.pixels;
    if (fraction == 0) {
      EXPECT_TRUE(selection.pixels.empty());
      continue;
    }
    ASSERT_FALSE(selection.pixels.empty());
    int left = width, right = -1, bottom = height, top = -1;
    for (const std::uint32_t pixel : selection.pixels) {
      const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
      left = std::min(left, x), right = std::max(right, x), bottom = std::min(bottom, y), top = std::max(top, y);
    }
    const int columns = right - left + 1, rows = top - bottom + 1;
    // No pixel of the rectangle is missing.
    EXPECT_EQ(selection.pixels.size(), static_cast<std::size_t>(columns * rows));
    EXPECT_EQ(left, width - 1 - right);
    EXPECT_EQ(bottom, height - 1 - top);
    EXPECT_NEAR(columns, std::sqrt(fraction) * width, 1.001);
    EXPECT_NEAR(rows, std::sqrt(fraction) * height, 1.001);
  }
  EXPECT_EQ(smaller.size(), static_cast<std::size_t>(width * height));
}

// Class of a contribution, as shared/structs.h says.
std::size_t classOf(double contribution) {
  const double octaves = std::log2(contribution) + CONTRIBUTION_OCTAVES;
  return static_cast<std::size_t>(octaves * CONTRIBUTION_CLASSES / CONTRIBUTION_OCTAVES);
}

TEST_F(ReflectionSpawn, PixelsAreCountedByWhatTheirReflectionAdds) {
  Settings settings;
  settings.image.toneMap = ToneMap::none;
  Scene scene = mirrorWall();
  const int width = 64, height = 64;
  // A perfect mirror adds all, on white as on black: nothing of the surface is left.
  for (const float light : {0.0f, 1.0f}) {
    shade = light;
    const Selection selection = select(scene, settings, width, height);
    std::uint32_t counted = 0;
    for (std::size_t i = 0; i < selection.contributions.size(); ++i) {
      counted += selection.contributions[i];
      if (selection.contributions[i] > 0) {
        EXPECT_GE(i, classOf(std::exp2(-0.25)) - 1);
      }
    }
    EXPECT_EQ(counted, static_cast<std::uint32_t>(width * height));
  }
  // A weak one adds to the displayed color less on a bright surface than on a dark one, and less in white light.
  scene.materials[0].mirror = 0.04f;
  double before = 1;
  for (const float light : {0.0f, 0.1f, 0.5f, 0.9f}) {
    shade = light;
    const Selection selection = select(scene, settings, width, height);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < selection.contributions.size(); ++i) {
      sum += selection.contributions[i] * static_cast<double>(i);
      count += selection.contributions[i];
    }
    EXPECT_EQ(count, width * height);
    const double mean = std::exp2(sum / count * CONTRIBUTION_OCTAVES / CONTRIBUTION_CLASSES - CONTRIBUTION_OCTAVES);
    EXPECT_LT(mean, 0.9 * before) << light;
    before = mean;
  }
  EXPECT_LT(before, 0.03);
  EXPECT_GT(before, 0.001);
}

TEST_F(ReflectionSpawn, LeastContributionsGoFirstAndEqualOnesThinOut) {
  Settings settings;
  settings.image.toneMap = ToneMap::none;
  // A mirror's reflectance rises towards the edges of the screen, where it is seen at an angle.
  Scene scene = mirrorWall();
  scene.materials[0].mirror = 0.04f;
  const int width = 96, height = 96;
  std::vector<std::uint32_t> larger = select(scene, settings, width, height).pixels;
  EXPECT_EQ(larger.size(), static_cast<std::size_t>(width * height));
  bool thinned = false;
  for (const float least : {0.05f, 0.17f, 0.19f, 0.21f, 0.23f, 0.3f, 0.9f}) {
    SCOPED_TRACE(least);
    settings.select.minContribution = least;
    const Selection selection = select(scene, settings, width, height);
    EXPECT_EQ(selection.count.reflecting, static_cast<std::uint32_t>(width * height));
    EXPECT_TRUE(std::includes(larger.begin(), larger.end(), selection.pixels.begin(), selection.pixels.end()));
    EXPECT_LE(selection.pixels.size(), larger.size());
    larger = selection.pixels;
    // What is counted above the threshold is what is kept, but for the class that it falls into.
    double above = 0;
    const std::size_t at = classOf(static_cast<double>(least));
    for (std::size_t i = at + 1; i < selection.contributions.size(); ++i) above += selection.contributions[i];
    EXPECT_GE(static_cast<double>(larger.size()), above);
    EXPECT_LE(static_cast<double>(larger.size()), above + selection.contributions[at]);
    const double share = static_cast<double>(larger.size()) / (width * height);
    thinned = thinned || (share > 0.2 && share < 0.8);
  }
  EXPECT_TRUE(thinned);
  EXPECT_TRUE(larger.empty());
}

TEST_F(ReflectionSpawn, LargeQueuesStayBelowTheDispatchLimit) {
  // The counter alone: rows of groups where one axis is not enough.
  gl::Program finish = gl::Program::compute(api, "effects/common/ray_count.comp");
  for (const std::uint32_t count : {0u, 1u, 64u, 65u, 65535u * 64u, 65535u * 64u + 1u, 40000000u}) {
    shared::RayCount value{};
    value.count = count;
    gl::Buffer buffer = gl::makeBuffer(api, std::span<const shared::RayCount>(&value, 1), "ray count");
    buffer.bindStorage(SSBO_RAY_COUNT);
    finish.use();
    finish.set("capacity", count);
    api.DispatchCompute(1, 1, 1);
    api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const shared::RayCount result = buffer.read<shared::RayCount>(1)[0];
    EXPECT_LE(result.groupsX, 65535u);
    const std::uint64_t rays = std::uint64_t{64} * result.groupsX * result.groupsY;
    EXPECT_GE(rays, count);
    EXPECT_LE(rays, std::uint64_t{count} + 64 * std::uint64_t{result.groupsY + 1});
    EXPECT_EQ(result.count, count);
  }
}

}  // namespace
}  // namespace halfsilver
