#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include <halfsilver/ray_reader.h>
#include "gpu/light_fixture.h"
#include "gpu/ray_queues.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
using glm::vec4;
constexpr std::uint32_t kQueue = 8;  // rays that fit

// A ray of a queue, with what the effect knows of it.
struct QueuedRay {
  shared::Ray ray;
  shared::RayPath path;
};

// Rays and their hits made by hand, on a quad in the plane y = 0 (triangles 0 and 1) whose light is emission alone.
class ReflectionShade : public LightTest {
 protected:
  void setUp(const Material& material, int width = 4, int height = 2) {
    scene_ = Scene();
    addQuad(scene_, vec3(0), {4, 0, 0}, {0, 0, -4}, addMaterial(scene_, material));
    scene_.sky = evenSky(vec3(0.25f, 0.5f, 1));
    settings.shadow.skyDirections = 0;
    Camera camera;
    camera.eye = {0, 8, 8};
    draw(scene_, camera, width, height);
  }

  QueuedRay ray(std::uint32_t pixel, const vec3& origin, const vec3& direction, const vec3& throughput = vec3(1)) {
    return {{origin, FAR_AWAY, glm::normalize(direction), NO_TRIANGLE},
            {throughput, 5.0f, pixel, RAY_REFLECTION, 0, 0}};
  }

  // The rays have the slots of their place in the list.
  RayQueue queueOf(const std::vector<QueuedRay>& queued) {
    std::vector<shared::Ray> rays;
    std::vector<shared::RayPath> paths;
    for (const QueuedRay& each : queued) {
      rays.push_back(each.ray);
      paths.push_back(each.path);
      paths.back().slot = static_cast<std::uint32_t>(paths.size() - 1);
    }
    return makeQueue(api, rays, paths);
  }

  // Shades first rays and brings their light to the pixels.
  void shade(const RayQueue& first, const std::vector<shared::Hit>& found, RayQueue* next = nullptr,
             const std::vector<shared::HitSurface>& surfaces = {}) {
    makeSlots(first.capacity);
    shadeOn(first, first, found, next, surfaces, 0);
  }

  // The same for rays of a later generation, which add to the slots of the first.
  void shadeOn(const RayQueue& first, const RayQueue& rays, const std::vector<shared::Hit>& found,
               RayQueue* next = nullptr, const std::vector<shared::HitSurface>& surfaces = {}, int generation = 1) {
    Hits hits;
    hits.hits = gl::makeBuffer(api, std::span<const shared::Hit>(found), "hits");
    if (!surfaces.empty()) hits.surfaces = gl::makeBuffer(api, std::span<const shared::HitSurface>(surfaces), "s");
    reflectionEffect.shade(view(), settings, rays, hits, {.generation = generation}, next, effectFrame_);
    reflectionEffect.resolve(view(), settings, first, {}, 0, effectFrame_, gbuffer);
  }

  vec4 reflection(int x, int y) { return pixels(gbuffer.reflection)[static_cast<std::size_t>(4 * y + x)]; }

  static void expectColor(const vec4& found, const vec3& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2e-3f) << "channel " << c;
  }

  // With contents of an earlier frame.
  void makeSlots(std::size_t count) {
    effectFrame_.slots = gl::makeBuffer(
        api, std::span<const shared::Radiance>(std::vector<shared::Radiance>(count, {vec3(9), 0})), "slots");
  }

  Scene scene_;
  EffectFrame effectFrame_;
  const vec3 sky_{0.25f, 0.5f, 1};
};

Material glowing(Material material, const vec3& color) {
  material.emissive = color;
  return material;
}

const shared::Hit kMiss{HIT_MISS, NO_TRIANGLE, 0, 0};
const shared::Hit kOverflow{HIT_OVERFLOW, NO_TRIANGLE, 0, 0};

TEST_F(ReflectionShade, MissShowsTheSkyAndOverflowLeavesThePixelUntraced) {
  setUp(diffuse(vec3(1)));
  const RayQueue queue = queueOf(
      {ray(2, {0, 1, 0}, {1, 1, 0}), ray(5, {0, 1, 0}, {1, 1, 0}, vec3(0.5f, 1, 0)), ray(6, {0, 1, 0}, {0, 1, 0})});
  shade(queue, {kMiss, kMiss, kOverflow});
  expectColor(reflection(2, 0), sky_);
  EXPECT_EQ(reflection(2, 0).w, 1);
  expectColor(reflection(1, 1), sky_ * vec3(0.5f, 1, 0));
  EXPECT_EQ(reflection(2, 1), vec4(0));  // given up
  EXPECT_EQ(reflection(0, 0), vec4(0));  // no ray
}

TEST_F(ReflectionShade, HitOnADullSurfaceShowsItsLight) {
  setUp(glowing(diffuse(vec3(0)), {0.9f, 0.3f, 0.1f}));
  const RayQueue queue = queueOf({ray(0, {0, 1, 0}, {1, -1, 0}, vec3(0.5f))});
  RayQueue next = makeQueue(api, kQueue);
  shade(queue, {{std::sqrt(2.0f), 0, 0.3f, 0.3f}}, &next);
  expectColor(reflection(0, 0), 0.5f * vec3(0.9f, 0.3f, 0.1f));
  EXPECT_EQ(reflection(0, 0).w, 1);
  EXPECT_EQ(next.count.read<shared::RayCount>(1)[0].count, 0u);
}

TEST_F(ReflectionShade, LitHitEqualsTheDeferredPixel) {
  Material material;
  material.baseColor = {0.7f, 0.5f, 0.2f, 1};
  material.metallic = 0.3f;
  material.roughness = 0.5f;
  setUp(material);
  scene_.lights = {sun({1, -2, 0.5f}, 3)};
  settings.shadow.skyDirections = 12;
  const vec3 eye(1, 2, 1.5f), target(0.4f, 0, 0.3f);
  const vec4 deferred = shadeAt(scene_, eye, target);
  const std::vector<vec4> blended = composite(CompositePass::Output::linear);
  const vec3 view = glm::normalize(target - eye);
  // Barycentrics of the point in the first triangle (-4, 4), (4, 4), (4, -4).
  const float u = (target.x + 4) / 8 - (4 - target.z) / 8, v = (4 - target.z) / 8;
  ASSERT_GE(u, 0);
  shade(queueOf({ray(0, eye, view)}), {{glm::distance(eye, target), 0, u, v}});
  const vec4 found = pixels(gbuffer.reflection)[0];
  EXPECT_GT(glm::length(vec3(deferred)), 0.3f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], middle(blended)[c], 2e-3f);
}

// W = 1: nothing of the surface's own light. W = 0.5: half of each.
TEST_F(ReflectionShade, LastBounceReflectsTheSky) {
  setUp(glowing(mirror(1), vec3(7)));
  shade(queueOf({ray(0, {0, 2, 0}, {0, -1, 0})}), {{2, 0, 0.25f, 0.5f}});
  expectColor(reflection(0, 0), sky_);
  setUp(glowing(mirror(0.5f), vec3(3)));
  shade(queueOf({ray(0, {0, 2, 0}, {0, -1, 0})}), {{2, 0, 0.25f, 0.5f}});
  expectColor(reflection(0, 0), 0.5f * vec3(3) + 0.5f * sky_);
}

TEST_F(ReflectionShade, SecondBounceIsSentOnAndAdded) {
  setUp(glowing(mirror(0.5f), vec3(3)));
  const vec3 direction = glm::normalize(vec3(1, -1, 0.5f));
  const float t = 2 / -direction.y;
  const vec3 hit = vec3(0, 2, 0) + t * direction;
  const float u = (hit.x + 4) / 8 - (4 - hit.z) / 8, v = (4 - hit.z) / 8;
  ASSERT_GE(u, 0);
  RayQueue next = makeQueue(api, kQueue);
  const RayQueue queue = queueOf(
      {ray(0, {0, 2, 0}, direction), ray(3, {0, 2, 0}, {0, 1, 0}), ray(5, {0, 2, 0}, direction, vec3(0, 0.5f, 1))});
  shade(queue, {{t, 0, u, v}, kMiss, {t, 0, u, v}}, &next);
  const float cosine = -direction.y;
  const float share = 0.5f + 0.5f * std::pow(1 - cosine, 5.0f);
  expectColor(reflection(0, 0), vec3((1 - share) * 3));

  const shared::RayCount count = next.count.read<shared::RayCount>(1)[0];
  ASSERT_EQ(count.count, 2u);
  EXPECT_EQ(count.groupsX, 1u);
  EXPECT_EQ(count.groupsY, 1u);
  EXPECT_EQ(count.groupsZ, 1u);
  const auto rays = next.rays.read<shared::Ray>(2);
  const auto paths = next.paths.read<shared::RayPath>(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const bool first = paths[i].pixel == 0;
    EXPECT_TRUE(first || paths[i].pixel == 5);
    EXPECT_EQ(paths[i].slot, first ? 0u : 2u);
    EXPECT_LT(glm::distance(rays[i].origin, hit), 1e-5f);
    EXPECT_LT(glm::distance(rays[i].direction, direction * vec3(1, -1, 1)), 1e-5f);
    EXPECT_EQ(rays[i].maxDistance, FAR_AWAY);
    EXPECT_EQ(rays[i].excluded, 0u);
    const vec3 throughput = share * (first ? vec3(1) : vec3(0, 0.5f, 1));
    EXPECT_LT(glm::distance(paths[i].throughput, throughput), 1e-5f);
    EXPECT_NEAR(paths[i].pathLength, 5 + t, 1e-4f);
  }

  shadeOn(queue, next, {kMiss, kOverflow});
  const bool firstMissed = paths[0].pixel == 0;
  const vec4 missed = firstMissed ? reflection(0, 0) : reflection(1, 1);
  const vec3 throughput = firstMissed ? vec3(1) : vec3(0, 0.5f, 1);
  expectColor(missed, throughput * ((1 - share) * 3 + share * sky_));
}

TEST_F(ReflectionShade, NoRayBelowTheThreshold) {
  settings.select.minReflectivity = 0.6f;
  setUp(glowing(mirror(0.5f), vec3(3)));
  RayQueue next = makeQueue(api, kQueue);
  shade(queueOf({ray(0, {0, 2, 0}, {0, -1, 0})}), {{2, 0, 0.25f, 0.5f}}, &next);
  EXPECT_EQ(next.count.read<shared::RayCount>(1)[0].count, 0u);
  EXPECT_EQ(next.count.read<shared::RayCount>(1)[0].groupsX, 0u);
  expectColor(reflection(0, 0), 0.5f * vec3(3) + 0.5f * sky_);
}

TEST_F(ReflectionShade, UnlitHitIsItsColor) {
  Material material = diffuse({0.2f, 0.4f, 0.6f});
  material.unlit = true;
  material.roughness = 0;
  setUp(material);
  RayQueue next = makeQueue(api, kQueue);
  shade(queueOf({ray(0, {0, 2, 0}, {0, -1, 0})}), {{2, 0, 0.25f, 0.5f}}, &next);
  expectColor(reflection(0, 0), {0.2f, 0.4f, 0.6f});
  EXPECT_EQ(next.count.read<shared::RayCount>(1)[0].count, 0u);
}

// Color, normal and reflectivity come from the method's store, whatever the triangle says.
TEST_F(ReflectionShade, StoredSurfacesReplaceTheTrianglesOwn) {
  Material material = diffuse(vec3(1));
  material.metallic = 1;
  material.roughness = 1;  // times a texture's
  settings.select.maxRoughness = 0.4f;
  setUp(material);
  const vec3 metal(0.8f, 0.4f, 0.2f);
  const float luminance = glm::dot(metal, vec3(0.2126f, 0.7152f, 0.0722f));
  const shared::HitSurface stored{metal, 0, glm::normalize(vec3(1, 1, 0)), luminance * 0.5f};
  RayQueue next = makeQueue(api, kQueue);
  shade(queueOf({ray(0, {0, 2, 0}, {0, -1, 0})}), {{2, 1, 0, 0}}, &next, {stored});
  ASSERT_EQ(next.count.read<shared::RayCount>(1)[0].count, 1u);
  const shared::Ray sent = next.rays.read<shared::Ray>(1)[0];
  const shared::RayPath path = next.paths.read<shared::RayPath>(1)[0];
  EXPECT_LT(glm::distance(sent.direction, vec3(1, 0, 0)), 1e-5f);
  EXPECT_LT(glm::distance(sent.origin, vec3(0)), 1e-5f);
  const vec3 fresnel = metal + (1.0f - metal) * std::pow(1 - std::sqrt(0.5f), 5.0f);
  EXPECT_LT(glm::distance(path.throughput, 0.5f * fresnel), 1e-4f);
  EXPECT_EQ(sent.excluded, 1u);
}

// First rays are pixels of the G-buffer: their light is that of the same rays, stored.
TEST_F(ReflectionShade, PixelsAreShadedAsTheRaysThatStartThere) {
  settings.trace.bounces = 2;
  setUp(glowing(mirror(0.5f), {0.9f, 0.3f, 0.1f}), 31, 17);
  RayQueue pixelQueue;
  reflectionEffect.spawn(view(), 0, 1, pixelQueue, effectFrame_);
  const std::uint32_t count = pixelQueue.count.read<shared::RayCount>(1)[0].count;
  ASSERT_GT(count, 100u);
  RayReader reader(api);
  reader.submit(view(), pixelQueue, count);
  const std::span<const shared::Ray> rays = reader.rays(view(), pixelQueue);
  const std::vector<std::uint32_t> numbers = pixelQueue.rays.read<std::uint32_t>(count);
  std::vector<shared::RayPath> paths;
  std::vector<shared::Hit> found;
  for (std::uint32_t i = 0; i < count; ++i) {
    paths.push_back({vec3(1), glm::distance(rays[i].origin, frame.eye), numbers[i], RAY_REFLECTION, i, 1});
    found.push_back(i % 3 == 0 ? kMiss : i % 7 == 0 ? kOverflow : shared::Hit{0.5f, 0, 0.3f, 0.3f});
  }
  const RayQueue stored = makeQueue(api, {rays.begin(), rays.end()}, paths);
  std::vector<vec4> pictures[2];
  for (int kind = 0; kind < 2; ++kind) {
    const vec4 nothing(0);
    api.ClearTexImage(gbuffer.reflection.name(), 0, GL_RGBA, GL_FLOAT, &nothing);
    RayQueue next = makeQueue(api, count);
    shade(kind == 0 ? pixelQueue : stored, found, &next);
    EXPECT_GT(next.count.read<shared::RayCount>(1)[0].count, count / 3);
    EXPECT_EQ(next.count.read<shared::RayCount>(1)[0].source, RAYS_STORED);
    pictures[kind] = pixels(gbuffer.reflection);
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_GT(std::count_if(pictures[0].begin(), pictures[0].end(), [](const vec4& p) { return p.w == 1 && p.x > 0; }),
            count / 2);
}

// Two unlike rays per pixel of one dispatch, in any order of the queue: one that hits and one that misses, some given
// up.
TEST_F(ReflectionShade, RaysOfOnePixelSumToTheSameBitsInAnyOrder) {
  constexpr std::uint32_t kWidth = 32, kHeight = 16, kPixels = kWidth * kHeight;
  setUp(glowing(diffuse(vec3(0)), {0.9f, 0.3f, 0.1f}), kWidth, kHeight);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  struct Shot {
    QueuedRay queued;
    shared::Hit hit;
  };
  std::vector<Shot> shots[2];
  for (std::uint32_t p = 0; p < kPixels; ++p) {
    for (std::uint32_t k = 0; k < 2; ++k) {
      const vec3 throughput(unit(random), unit(random), unit(random));
      const shared::Hit hit{1 + unit(random), 0, 0.3f, 0.3f};
      Shot shot{ray(kPixels - 1 - p, {0, 1, 0}, {1, k == 0 ? -1 : 1, 0}, throughput), k == 0 ? hit : kMiss};
      if (p % 5 == k) shot.hit = kOverflow;
      shot.queued.path.slot = 2 * p + k;
      shots[k].push_back(shot);
    }
  }
  const auto shadePixels = [&](const std::vector<Shot>& queue, std::uint32_t slotsPerPixel) {
    std::vector<shared::Ray> rays;
    std::vector<shared::RayPath> paths;
    std::vector<shared::Hit> found;
    for (const Shot& shot : queue) {
      rays.push_back(shot.queued.ray);
      paths.push_back(shot.queued.path);
      if (slotsPerPixel == 1) paths.back().slot /= 2;
      found.push_back(shot.hit);
    }
    makeSlots(kPixels * slotsPerPixel);
    const vec4 nothing(0);
    api.ClearTexImage(gbuffer.reflection.name(), 0, GL_RGBA, GL_FLOAT, &nothing);
    const RayQueue first = makeQueue(api, rays, paths);
    Hits hits;
    hits.hits = gl::makeBuffer(api, std::span<const shared::Hit>(found), "hits");
    reflectionEffect.shade(view(), settings, first, hits, {}, nullptr, effectFrame_);
    reflectionEffect.resolve(view(), first, effectFrame_, gbuffer, slotsPerPixel);
    return pixels(gbuffer.reflection);
  };
  const std::vector<vec4> one = shadePixels(shots[0], 1), other = shadePixels(shots[1], 1);

  std::vector<Shot> both = shots[0];
  both.insert(both.end(), shots[1].begin(), shots[1].end());
  const std::vector<vec4> sums = shadePixels(both, 2);
  std::size_t means = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float answered = one[i].w + other[i].w;
    ASSERT_EQ(sums[i].w, answered > 0 ? 1 : 0);
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(sums[i][c], (one[i][c] + other[i][c]) / std::max(answered, 1.0f));
    means += answered == 2 && one[i] != other[i] && one[i].x > 0 && other[i].x > 0;
  }
  EXPECT_GT(means, kPixels / 2);
  for (int order = 0; order < 100; ++order) {
    std::shuffle(both.begin(), both.end(), random);
    ASSERT_EQ(shadePixels(both, 2), sums) << order;
  }
}

}  // namespace
}  // namespace halfsilver::testing
