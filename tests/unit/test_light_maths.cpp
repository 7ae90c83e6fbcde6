#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "passes/light_list.h"
#include "passes/sky_light.h"

namespace halfsilver {
namespace {

using glm::vec3;
constexpr float kPi = glm::pi<float>();

Sky evenSky(const vec3& radiance) {
  Sky sky;
  sky.zenith = sky.horizon = sky.ground = radiance;
  return sky;
}

void expectNear(const vec3& found, const vec3& expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
}

vec3 irradiance(const SkyLight& light, const vec3& normal) {
  vec3 sum(0);
  for (const SkyDirection& d : light.directions) sum += d.irradiance * std::max(0.0f, glm::dot(normal, d.direction));
  return sum;
}

TEST(SkyLight, EvenSkyGivesTheClosedForm) {
  for (const int count : {1, 2, 7, 12, 32}) {
    SCOPED_TRACE(count);
    const SkyLight light = integrateSky(evenSky({1, 2, 3}), count);
    ASSERT_EQ(light.directions.size(), static_cast<std::size_t>(count));
    expectNear(light.upper, kPi * vec3(1, 2, 3), 1e-3f);
    expectNear(light.lower, kPi * vec3(1, 2, 3), 1e-3f);
    expectNear(irradiance(light, {0, 1, 0}), kPi * vec3(1, 2, 3), 1e-3f);
    for (const SkyDirection& d : light.directions) EXPECT_GT(d.direction.y, 0);
    // A wall sees half of the upper sky.
    if (count >= 7) {
      for (const vec3& wall : {vec3(1, 0, 0), vec3(0, 0, -1), vec3(0.6f, 0, 0.8f)})
        EXPECT_NEAR(irradiance(light, wall).x, kPi / 2, 0.12f * kPi);
    }
  }
}

TEST(SkyLight, GradientKeepsItsHalvesApart) {
  Sky sky;
  sky.zenith = {0, 0, 1};
  sky.horizon = {0, 0, 1};
  sky.ground = {1, 0, 0};
  sky.intensity = 2;
  const SkyLight light = integrateSky(sky, 12);
  expectNear(light.upper, {0, 0, 2 * kPi}, 1e-3f);
  EXPECT_GT(light.lower.x, 1.9f * kPi);
  EXPECT_LT(light.lower.z, 0.05f * kPi);
  for (const SkyDirection& d : light.directions) EXPECT_EQ(d.irradiance.x, 0);
}

// One bright texel: all its light comes from one direction, which points at it.
TEST(SkyLight, SunInAnImageIsFound) {
  Sky sky;
  sky.imageWidth = 256;
  sky.imageHeight = 128;
  sky.image.assign(256 * 128 * 3, 0.0f);
  const int x = 210, y = 25;
  const std::size_t texel = 3 * (static_cast<std::size_t>(y) * 256 + static_cast<std::size_t>(x));
  for (std::size_t c = 0; c < 3; ++c) sky.image[texel + c] = 1000;
  const SkyLight light = integrateSky(sky, 12);
  ASSERT_EQ(light.directions.size(), 1u);
  // u = 0.5 + atan2(x, -z) / 2 pi, v = acos(y) / pi.
  const float across = 2 * kPi * ((210.5f / 256) - 0.5f), down = kPi * 25.5f / 128;
  const vec3 expected(std::sin(down) * std::sin(across), std::cos(down), -std::sin(down) * std::cos(across));
  EXPECT_GT(glm::dot(light.directions[0].direction, expected), std::cos(0.04f));
  const float solidAngle = 2 * kPi / 256 * kPi / 128 * std::sin(down);
  EXPECT_NEAR(light.directions[0].irradiance.x, 1000 * solidAngle, 0.02f * 1000 * solidAngle);
}

TEST(SkyLight, ValuesThatAreNoLightAreLeftOut) {
  Sky sky;
  sky.imageWidth = 2;
  sky.imageHeight = 1;
  sky.image = {NAN, -5, 1, INFINITY, -INFINITY, 1};
  const SkyLight light = integrateSky(sky, 12);
  EXPECT_TRUE(std::isfinite(light.upper.x));
  EXPECT_EQ(light.upper.y, 0);
  EXPECT_NEAR(light.upper.z, kPi, 1e-3f);
}

TEST(SkyLight, BlackSkyHasNoDirections) { EXPECT_TRUE(integrateSky(evenSky(vec3(0)), 12).directions.empty()); }

Bounds box(const vec3& low, const vec3& high) {
  Bounds bounds;
  bounds.add(low);
  bounds.add(high);
  return bounds;
}

Light light(LightType type) {
  Light made;
  made.type = type;
  made.position = {1, 2, 3};
  made.direction = glm::normalize(vec3(0.3f, -1, 0.2f));
  return made;
}

// Every view of a direction holds all of the bounds, with a margin, and its matrix agrees with its place in the maps.
TEST(LightList, DirectionalViewsHoldTheBounds) {
  for (const Bounds& bounds : {box({-3, 0, -8}, {20, 5, 2}), box({-1, 0, -1}, {1, 0, 1}), box(vec3(2), vec3(2))}) {
    const Light lights[] = {light(LightType::directional)};
    const LightList list = makeLightList(bounds, lights, evenSky(vec3(1)), {});
    ASSERT_EQ(list.views.size(), 13u);
    EXPECT_EQ(list.layers, 2);
    for (std::size_t i = 0; i < list.views.size(); ++i) {
      const ShadowView& view = list.views[i];
      const glm::vec2 low = glm::vec2(view.rectangle.x, view.rectangle.y) / 1024.0f;
      const glm::vec2 high = low + glm::vec2(view.rectangle.z, view.rectangle.w) / 1024.0f;
      EXPECT_EQ(list.lights[i].shadowLayer, view.layer);
      Bounds places;
      for (unsigned corner = 0; corner < 8; ++corner) {
        const vec3 p(corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                     corner & 4 ? bounds.high.z : bounds.low.z);
        const glm::vec4 clip = view.worldToClip * glm::vec4(p, 1);
        const glm::vec4 place = list.lights[i].shadow[0] * glm::vec4(p, 1);
        EXPECT_LE(std::max({std::abs(clip.x), std::abs(clip.y), std::abs(clip.z)}), 1);
        places.add(place);
      }
      EXPECT_GT(places.low.x, low.x + 3.0f / 1024);
      EXPECT_GT(places.low.y, low.y + 3.0f / 1024);
      EXPECT_LT(places.high.x, high.x - 3.0f / 1024);
      EXPECT_LT(places.high.y, high.y - 3.0f / 1024);
      EXPECT_GE(places.low.z, 0);
      EXPECT_LE(places.high.z, 1);
    }
  }
}

TEST(LightList, ViewsDoNotOverlap) {
  const Light lights[] = {light(LightType::point), light(LightType::spot), light(LightType::directional)};
  LightListLimits limits;
  limits.skyDirections = 32;
  const LightList list = makeLightList(box(vec3(-1), vec3(1)), lights, evenSky(vec3(1)), limits);
  ASSERT_EQ(list.views.size(), 6u + 1 + 1 + 32);
  EXPECT_EQ(list.layers, 6 + 1 + 1 + 2);
  for (std::size_t a = 0; a < list.views.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const ShadowView &p = list.views[a], &q = list.views[b];
      const bool apart = p.layer != q.layer || p.rectangle.x + p.rectangle.z <= q.rectangle.x ||
                         q.rectangle.x + q.rectangle.z <= p.rectangle.x ||
                         p.rectangle.y + p.rectangle.w <= q.rectangle.y ||
                         q.rectangle.y + q.rectangle.w <= p.rectangle.y;
      EXPECT_TRUE(apart) << a << ", " << b;
    }
}

TEST(LightList, NarrowRoom) {
  const std::vector<Light> lights(5, light(LightType::directional));
  const auto shadowed = [](const LightList& list) {
    int count = 0;
    for (const shared::GpuLight& l : list.lights) count += l.shadowLayer != NO_SHADOW ? 1 : 0;
    return count;
  };
  LightListLimits limits;
  limits.resolution = 128;  // four tiles of 64 a layer
  limits.layers = 7;
  LightList list = makeLightList(box(vec3(-1), vec3(1)), lights, evenSky(vec3(1)), limits);
  EXPECT_EQ(shadowed(list), 5 + 8);
  EXPECT_EQ(list.layers, 7);
  ASSERT_EQ(list.warnings.size(), 1u);
  EXPECT_NE(list.warnings[0].find("8 of 12"), std::string::npos) << list.warnings[0];
  limits.layers = 3;
  list = makeLightList(box(vec3(-1), vec3(1)), lights, evenSky(vec3(1)), limits);
  EXPECT_EQ(shadowed(list), 3);
  EXPECT_EQ(list.layers, 3);
  EXPECT_EQ(list.warnings.size(), 2u);
  // The sky's light is not lost with its directions.
  float up = 0;
  for (std::size_t i = list.ranges.direct; i < list.lights.size(); ++i)
    if (list.lights[i].direction.y < 0) up += list.lights[i].color.x;
  EXPECT_GT(up, kPi * 0.99f);
}

// Shaders find a kind of light by its range.
TEST(LightList, EachKindLiesInItsRange) {
  const Light lights[] = {light(LightType::point), light(LightType::directional), light(LightType::spot)};
  for (const int directions : {0, 12}) {
    LightListLimits limits;
    limits.skyDirections = directions;
    const LightList list = makeLightList(box(vec3(-1), vec3(1)), lights, evenSky(vec3(1)), limits);
    const LightRanges& ranges = list.ranges;
    EXPECT_EQ(ranges.direct, 3u);
    EXPECT_EQ(ranges.skyDirections, static_cast<std::uint32_t>(directions));
    EXPECT_EQ(ranges.hemispheres, directions == 0 ? 3u : 2u);
    ASSERT_EQ(list.lights.size(), ranges.direct + ranges.skyDirections + ranges.hemispheres);
    EXPECT_EQ(list.lights[0].type, LIGHT_POINT);
    EXPECT_EQ(list.lights[1].type, LIGHT_DIRECTIONAL);
    EXPECT_EQ(list.lights[2].type, LIGHT_SPOT);
    for (std::size_t i = 0; i < list.lights.size(); ++i)
      EXPECT_EQ(list.lights[i].shadowLayer >= 0, i < ranges.direct + ranges.skyDirections) << i;
  }
}

TEST(LightList, ARectangleShinesAlongItsAxesCrossProduct) {
  Light source = light(LightType::rectangle);
  source.width = 3;
  source.height = 0.5f;
  source.color = {1, 2, 4};
  source.intensity = 10;
  for (const vec3& up : {vec3(0, 0, -2), vec3(1, 0, 0), source.direction, vec3(0)}) {
    source.up = up;
    const shared::GpuLight packed = makeLightList(box(vec3(-1), vec3(1)), {&source, 1}, evenSky(vec3(0)), {}).lights[0];
    EXPECT_EQ(packed.type, LIGHT_RECTANGLE);
    EXPECT_NEAR(glm::length(packed.halfWidth), 1.5f, 1e-5f);
    EXPECT_NEAR(glm::length(packed.halfHeight), 0.25f, 1e-5f);
    EXPECT_LT(glm::distance(glm::cross(packed.halfWidth, packed.halfHeight), 0.375f * source.direction), 1e-5f);
    EXPECT_NEAR(glm::dot(packed.halfWidth, up), 0, 1e-5f) << "up lies along the height";
    EXPECT_EQ(packed.area, 1.5f);
    EXPECT_LT(glm::distance(packed.color / packed.area, vec3(10, 20, 40)), 1e-4f) << "nits";
    EXPECT_EQ(packed.shadowLayers, 6) << "all of a half space";
  }
}

TEST(LightList, ASphereIsAsBrightAsItsOutline) {
  Light source = light(LightType::sphere);
  source.radius = 0.5f;
  source.intensity = 8;
  const LightList list = makeLightList(box(vec3(-1), vec3(1)), {&source, 1}, evenSky(vec3(1)), {});
  EXPECT_EQ(list.lights[0].type, LIGHT_SPHERE);
  EXPECT_EQ(list.lights[0].radius, 0.5f);
  EXPECT_NEAR(list.lights[0].color.x, 8 * kPi * 0.25f, 1e-4f) << "candela";
  EXPECT_EQ(list.lights[0].shadowLayers, 6);
  // What other surfaces send on is that of a point as bright.
  Light point = light(LightType::point);
  point.intensity = 8 * kPi * 0.25f;
  const LightList same = makeLightList(box(vec3(-1), vec3(1)), {&point, 1}, evenSky(vec3(1)), {});
  EXPECT_NEAR(list.lights.back().color.x, same.lights.back().color.x, 1e-4f);
}

// Of the flux of a rectangle, pi times area times radiance, 0.54 comes back from the six sides of a cube of side 2.
TEST(LightList, ARectanglesFluxIsThatOfALambertEmitter) {
  Light source = light(LightType::rectangle);
  source.width = source.height = 2;
  source.intensity = 3;
  const LightList with = makeLightList(box(vec3(-1), vec3(1)), {&source, 1}, evenSky(vec3(1)), {});
  EXPECT_NEAR(with.lights.back().color.x, 0.54f * kPi * 4 * 3 / 24 / 3, 2e-3f);
}

// Under a black sky there is direct light alone: the closed forms hold.
TEST(LightList, BounceNeedsASky) {
  const Light lights[] = {light(LightType::directional)};
  EXPECT_EQ(makeLightList(box(vec3(-1), vec3(1)), lights, evenSky(vec3(0)), {}).lights.size(), 1u);
  LightListLimits limits;
  limits.skyDirections = 0;
  const LightList list = makeLightList(box(vec3(-1), vec3(1)), lights, evenSky(vec3(1)), limits);
  // The sun, the sky above, what comes from below and what comes back from above.
  ASSERT_EQ(list.lights.size(), 4u);
  // A cube of side 2: the sun's flux over the area of its six sides, 0.54 of it sent on.
  const vec3 d = glm::abs(lights[0].direction);
  const float bounce = 0.54f * (d.x + d.y + d.z) * 4 / 24;
  EXPECT_NEAR(list.lights[2].color.x, kPi + bounce, 2e-3f);
  EXPECT_NEAR(list.lights[3].color.x, bounce / 3, 2e-3f);
}

}  // namespace
}  // namespace halfsilver
