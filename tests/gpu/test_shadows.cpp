#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <random>

#include "gpu/light_fixture.h"
#include "passes/light_list.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
constexpr float kPi = glm::pi<float>();

// A floor of 20 x 20 meters with a box of 2 x 2 x 2 in its middle, lit so that a lit point of the floor has radiance 1.
struct Lit {
  Scene scene;
  std::uint32_t white = 0;
};

Lit floorAndBox() {
  Lit lit;
  lit.white = addMaterial(lit.scene, diffuse(vec3(1)));
  addQuad(lit.scene, vec3(0), {10, 0, 0}, {0, 0, -10}, lit.white);
  addBox(lit.scene, {-1, 0, -1}, {1, 2, 1}, lit.white);
  lit.scene.sky = blackSky();
  return lit;
}

Light bulb(const vec3& position, float candela) {
  Light light;
  light.type = LightType::point;
  light.position = position;
  light.intensity = candela;
  return light;
}

Light spot(const vec3& position, const vec3& target, float candela) {
  Light light = bulb(position, candela);
  light.type = LightType::spot;
  light.direction = glm::normalize(target - position);
  light.outerConeAngle = glm::radians(70.0f);
  return light;
}

using ShadowTest = LightTest;

// The box is 2 meters high and light falls at 45 degrees: its shadow ends 2 meters behind it.
TEST_F(ShadowTest, SunShadowLiesWhereGeometrySays) {
  Scene scene = floorAndBox().scene;
  scene.lights = {sun({1, -1, 0}, kPi)};
  const float lit = std::sqrt(0.5f);
  EXPECT_NEAR(shadeAt(scene, {-6, 6, 3}, {-2, 0, 0}).x, lit, 1e-3f);
  for (const float x : {1.05f, 1.5f, 2.0f, 2.9f}) {
    SCOPED_TRACE(x);
    EXPECT_EQ(shadeAt(scene, {6, 6, 3}, {x, 0, 0}).x, 0);
    EXPECT_NEAR(shadeAt(scene, {6, 6, 3}, {x, 0, 1.1f}).x, lit, 1e-3f);
  }
  for (const float x : {3.1f, 4.0f, 9.5f}) {
    SCOPED_TRACE(x);
    EXPECT_NEAR(shadeAt(scene, {6, 6, 3}, {x, 0, 0}).x, lit, 1e-3f);
  }
  EXPECT_NEAR(shadeAt(scene, {0, 6, 3}, {0, 2, 0}).x, lit, 1e-3f);  // the box's top
}

// A ground of many quads, 5 km wide, with two crates 2 km from each other and a tower.
TEST_F(ShadowTest, SunShadowsOfSmallThingsAreThereOnGroundsOfAnyKindWhereverTheEyeIs) {
  constexpr int kSide = 12;
  constexpr float kHalf = 2500, kQuad = kHalf / kSide;
  const float lit = std::sqrt(0.5f);
  for (const bool tower : {false, true}) {
    SCOPED_TRACE(tower);
    Scene scene;
    const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
    scene.sky = blackSky();
    scene.lights = {sun({1, -1, 0}, kPi)};
    for (int z = 0; z < kSide; ++z)
      for (int x = 0; x < kSide; ++x)
        addQuad(scene,
                {kQuad * static_cast<float>(2 * x + 1 - kSide), 0, kQuad * static_cast<float>(2 * z + 1 - kSide)},
                {kQuad, 0, 0}, {0, 0, -kQuad}, white);
    const vec3 places[] = {{10, 0, 0}, {1700, 0, 1200}};
    for (const vec3& at : places) addBox(scene, at - vec3(0.5f, 0, 0.5f), at + vec3(0.5f, 1, 0.5f), white);
    if (tower) addBox(scene, {-400, 0, -10}, {-380, 300, 10}, white);
    for (const vec3& at : places) {
      SCOPED_TRACE(at.x);
      const vec3 eye = at + vec3(3, 2, 1);
      for (const float x : {0.6f, 1.0f, 1.4f}) EXPECT_EQ(shadeAt(scene, eye, at + vec3(x, 0, 0)).x, 0) << x;
      for (const vec3& beside : {vec3(1.65f, 0, 0), vec3(1, 0, 0.65f), vec3(0.1f, 0, 1.5f), vec3(8, 0, 1)})
        EXPECT_NEAR(shadeAt(scene, eye, at + beside).x, lit, 5e-3f) << beside.x;
    }
    EXPECT_NEAR(shadeAt(scene, {-40, 5, 3}, {-50, 0, 0}).x, lit, 5e-3f);
    if (tower) {
      EXPECT_EQ(shadeAt(scene, {-100, 5, 3}, {-100, 0, 0}).x, 0);
    }
    EXPECT_LE(shadows.maps.shape().depth, 6);
  }
}

TEST_F(ShadowTest, MapsAroundTheEyeStayUntilItHasGoneFar) {
  Scene scene;
  const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
  addQuad(scene, vec3(0), {2500, 0, 0}, {0, 0, -2500}, white);
  for (const float x : {-1000.0f, 1000.0f}) addBox(scene, {x, 0, 0}, {x + 1, 1, 1}, white);
  const GpuScene uploaded = uploadScene(api, scene);
  const auto at = [&](const vec3& eye) {
    return shadowBoxes(uploaded.clusters.all(), uploaded.extents.bounds(), 864, eye);
  };
  const ShadowBoxes first = at({1000, 2, 3});
  ASSERT_GE(first.around.size(), 2u);
  int changes = 0;
  for (float x = 1000; x < 1050; x += 0.5f) changes += at({x, 2, 3}) != at({x + 0.5f, 2, 3});
  EXPECT_GE(changes, 5);
  EXPECT_LE(changes, 25);
  EXPECT_NE(at({1100, 2, 3}), first);
  EXPECT_EQ(at({1100, 2, 3}).around.size(), first.around.size());
  // Each box holds the eye and lies within the next.
  for (std::size_t i = 0; i < first.around.size(); ++i) {
    const Bounds& box = first.around[i];
    EXPECT_LE(box.low.x, 1000);
    EXPECT_GE(box.high.x, 1000);
    if (i == 0) continue;
    EXPECT_LE(box.low.x, first.around[i - 1].low.x);
    EXPECT_GE(box.high.x, first.around[i - 1].high.x);
  }
  // A room has no need of them.
  EXPECT_TRUE(shadowBoxes(uploadScene(api, floorAndBox().scene).clusters.all(), {vec3(-10), vec3(10)}, 864, vec3(0))
                  .around.empty());
}

TEST_F(ShadowTest, MapsAroundTheEyeTakeNoLightsShadow) {
  Scene scene;
  const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
  addQuad(scene, vec3(0), {25000, 0, 0}, {0, 0, -25000}, white);
  for (const float x : {-10000.0f, 10000.0f}) addBox(scene, {x, 0, 0}, {x + 1, 1, 1}, white);
  const GpuScene uploaded = uploadScene(api, scene);
  const Bounds& whole = uploaded.extents.bounds();
  const ShadowBoxes boxes = shadowBoxes(uploaded.clusters.all(), whole, 8192, {10000, 2, 3});
  ASSERT_GE(boxes.around.size(), 2u);
  scene.lights = {sun({1, -1, 0}, kPi), sun({1, -1, 0.5f}, kPi), bulb({0, 5, 0}, 1)};
  LightListLimits limits;
  limits.skyDirections = 0;
  limits.layers = 9;
  const LightList list = makeLightList(whole, scene.lights, blackSky(), limits, boxes);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GE(list.lights[i].shadowLayer, 0.0f) << i;
  EXPECT_LE(list.layers, 9);
  ASSERT_EQ(list.warnings.size(), 1u);
  EXPECT_NE(list.warnings[0].find("of a directional light"), std::string::npos);
  limits.layers = 64;
  EXPECT_TRUE(makeLightList(whole, scene.lights, blackSky(), limits, boxes).warnings.empty());
}

TEST_F(ShadowTest, SpotAndPointShadowsLieWhereGeometrySays) {
  // From 4 meters above the floor over x = -3, the box's far upper edge at x = 1 throws its shadow to x = 5.
  const vec3 from(-3, 4, 0);
  for (const bool cone : {false, true}) {
    SCOPED_TRACE(cone ? "spot" : "point");
    Scene scene = floorAndBox().scene;
    scene.lights = {cone ? spot(from, {1, 0, 0}, 100) : bulb(from, 100)};
    EXPECT_GT(shadeAt(scene, {-6, 6, 3}, {-2, 0, 0}).x, 0.5f);
    EXPECT_GT(shadeAt(scene, {8, 6, 3}, {5.4f, 0, 0}).x, 0.05f);
    for (const float x : {1.1f, 3.0f, 4.5f}) {
      SCOPED_TRACE(x);
      EXPECT_EQ(shadeAt(scene, {8, 6, 3}, {x, 0, 0}).x, 0);
    }
  }
}

// A lamp inside a room lights all six sides: every layer of its cube is turned right and nothing shadows itself.
TEST_F(ShadowTest, LampLightsAllSidesOfARoom) {
  Scene scene;
  addBox(scene, vec3(-2), vec3(2), addMaterial(scene, diffuse(vec3(1))), true);
  // A small plate before each side, each with its own offset, to be seen as a shadow behind it.
  const std::uint32_t plate = 0;
  scene.sky = blackSky();
  scene.lights = {bulb(vec3(0), kPi)};
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      vec3 n(0), u(0), v(0);
      n[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = 1;
      Scene shadowed = scene;
      addQuad(shadowed, n + 0.5f * u, 0.1f * u, 0.1f * v, plate);
      SCOPED_TRACE(::testing::Message() << "axis " << axis << " side " << side);
      const vec3 eye = -1.5f * n - 1.5f * u + 0.3f * v;
      const auto expected = [&](const vec3& p) { return 2 / std::pow(glm::length(p), 3.0f); };
      for (const vec3& offset : {0.0f * u, -1.0f * u, 1.7f * u + 1.7f * v, 1.0f * v}) {
        const vec3 p = 2.0f * n + offset;
        EXPECT_NEAR(shadeAt(shadowed, eye, p).x, expected(p), 5e-3f * expected(p));
      }
      EXPECT_EQ(shadeAt(shadowed, vec3(-1.5f * n - 1.5f * u), 2.0f * n + 1.0f * u).x, 0);
    }
}

// Left half transparent, right half opaque.
TEST_F(ShadowTest, AlphaCutsHolesIntoShadows) {
  Lit lit;
  Scene& scene = lit.scene;
  lit.white = addMaterial(scene, diffuse(vec3(1)));
  auto texture = std::make_shared<Texture>();
  texture->width = 2;
  texture->height = 1;
  texture->texels = {255, 255, 255, 0, 255, 255, 255, 255};
  scene.textures.push_back(texture);
  Material leaf = diffuse(vec3(1));
  leaf.alphaMode = AlphaMode::mask;
  leaf.baseColorTexture.texture = 0;
  leaf.baseColorTexture.wrapU = Wrap::clamp;
  addQuad(scene, vec3(0), {10, 0, 0}, {0, 0, -10}, lit.white);
  addQuad(scene, {0, 1, 0}, {2, 0, 0}, {0, 0, -2}, addMaterial(scene, leaf));
  scene.sky = blackSky();
  scene.lights = {sun({0, -1, 0}, kPi)};
  EXPECT_NEAR(shadeAt(scene, {-1, 0.5f, 0.1f}, {-1, 0, 0}).x, 1, 1e-3f);
  EXPECT_EQ(shadeAt(scene, {1, 0.5f, 0.1f}, {1, 0, 0}).x, 0);
  EXPECT_NEAR(shadeAt(scene, {3, 0.5f, 0.1f}, {3, 0, 0}).x, 1, 1e-3f);
}

// A sheet that the camera sees from one side only still casts its shadow, whichever side the light comes from.
TEST_F(ShadowTest, BothFacesOfASheetCastShadows) {
  for (const float side : {-1.0f, 1.0f}) {
    Scene scene;
    const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
    addQuad(scene, vec3(0), {10, 0, 0}, {0, 0, -10}, white);
    addQuad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, side}, white);
    scene.sky = blackSky();
    scene.lights = {sun({0, -1, 0}, kPi)};
    EXPECT_EQ(shadeAt(scene, {0.5f, 0.5f, 0}, {0.2f, 0, 0.1f}).x, 0);
    EXPECT_NEAR(shadeAt(scene, {3, 2, 0}, {2, 0, 0}).x, 1, 1e-3f);
  }
}

// Neither acne on a bare floor nor light under the edges of what stands on it, at any height of the sun.
TEST_F(ShadowTest, NoAcneAndNoGapAtContact) {
  for (const float elevation : {5.0f, 20.0f, 45.0f, 90.0f}) {
    SCOPED_TRACE(elevation);
    Scene scene = floorAndBox().scene;
    const float angle = glm::radians(elevation);
    scene.lights = {sun({std::cos(angle), -std::sin(angle), 0.2f * std::cos(angle)}, kPi)};
    Camera camera;
    camera.eye = {-5.5f, 12, 0};
    camera.target = {-5.5f, 0, 0};
    camera.up = {0, 0, -1};
    camera.verticalFov = glm::radians(30.0f);
    draw(scene, camera, 64, 64);
    const float expected = -scene.lights[0].direction.y;
    for (const glm::vec4& pixel : pixels(gbuffer.shaded)) ASSERT_NEAR(pixel.x, expected, 2e-3f);
    if (elevation < 80) {
      EXPECT_LT(shadeAt(scene, {6, 3, 0}, {1.03f, 0, 0}).x, 0.3f * expected);
    }
  }
}

// A plate of 512 triangles, which are neighbors in the scene.
void addPlate(Scene& scene, const vec3& center, const vec3& halfU, const vec3& halfV, std::uint32_t material) {
  constexpr int kSide = 16;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const float u = static_cast<float>(2 * x + 1 - kSide) / kSide, v = static_cast<float>(2 * y + 1 - kSide) / kSide;
      addQuad(scene, center + u * halfU + v * halfV, halfU / 16.0f, halfV / 16.0f, material);
    }
}

// A room of 4 x 4 x 4 meters with a lamp in its middle and a plate before each side: +x, -x, +y, -y, +z, -z.
Scene roomOfPlates() {
  Scene scene;
  const std::uint32_t white = addMaterial(scene, diffuse(vec3(1)));
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {1.0f, -1.0f}) {
      vec3 n(0), u(0), v(0);
      n[axis] = side;
      u[(axis + 1) % 3] = 0.4f;
      v[(axis + 2) % 3] = 0.4f;
      addPlate(scene, n, u, v, white);
    }
  addBox(scene, vec3(-2), vec3(2), white, true);
  scene.sky = evenSky(vec3(1));
  scene.lights = {bulb(vec3(0), kPi), sun({0.3f, -1, 0.2f}, 1)};
  return scene;
}

class ShadowViewsTest : public ShadowTest {
 protected:
  ShadowViewsTest() {
    settings.shadow.resolution = 128;
    settings.shadow.skyDirections = 4;
  }

  // What `maps` holds, brought up to date.
  std::vector<float> drawn(const Scene& scene, const ShadowChange& change, ShadowMaps& maps) {
    shadowPass.run(gpu, scene.lights, scene.sky, settings.shadow, {}, change, maps, profiler);
    const gl::Texture::Shape& shape = maps.maps.shape();
    std::vector<float> depth(static_cast<std::size_t>(shape.width * shape.height * shape.depth));
    maps.maps.read(GL_DEPTH_COMPONENT, GL_FLOAT, depth.size() * sizeof(float), depth.data());
    return depth;
  }
};

// The same triangles in an order without neighbors leave nothing to leave out.
TEST_F(ShadowViewsTest, LeaveOutOnlyWhatTheyDoNotSee) {
  Scene scene = roomOfPlates();
  gpu = uploadScene(api, scene);
  ShadowMaps maps, whole;
  const std::vector<float> depth = drawn(scene, {}, maps);
  EXPECT_EQ(maps.viewsDrawn, 6u + 1 + 4);
  std::vector<Triangle> scattered;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i)
    scattered.push_back(scene.triangles[i * 1009 % scene.triangles.size()]);
  scene.triangles = scattered;
  gpu = uploadScene(api, scene);
  EXPECT_TRUE(drawn(scene, {}, whole) == depth);
  // But for the room's twelve in one view: they are far larger than all others and stand alone.
  EXPECT_GE(whole.trianglesDrawn, 11 * scene.triangles.size() - 12);
  EXPECT_LT(maps.trianglesDrawn, 0.7 * static_cast<double>(whole.trianglesDrawn));
  EXPECT_LT(*std::min_element(depth.begin(), depth.end()), 0.5f);
}

TEST_F(ShadowViewsTest, AreDrawnAgainIfSomethingMovedInThem) {
  Scene scene = roomOfPlates();
  gpu = uploadScene(api, scene);
  ShadowMaps maps;
  const std::vector<float> before = drawn(scene, {}, maps);
  const auto expectFresh = [&](const std::vector<float>& depth) {
    ShadowMaps fresh;
    EXPECT_TRUE(depth == drawn(scene, {}, fresh));
  };
  EXPECT_TRUE(drawn(scene, {.everything = false, .moved = {}}, maps) == before);
  EXPECT_EQ(maps.viewsDrawn, 0u) << "nothing has changed";

  const VertexRange plate{0, 1024};  // before +x
  for (std::uint32_t v = 0; v < plate.count; ++v) scene.vertices[v].position.y += 0.3f;
  std::vector<Bounds> moved = updateScene(api, gpu, scene, {.moved = {plate}});
  const std::vector<float> after = drawn(scene, {.everything = false, .moved = moved}, maps);
  EXPECT_EQ(maps.viewsDrawn, 1u + 1 + 4) << "the lamp's side, the sun and the sky";
  EXPECT_TRUE(after != before);
  expectFresh(after);

  scene.lights[0].position.x += 0.1f;
  const std::vector<float> lamp = drawn(scene, {.everything = false, .moved = {}}, maps);
  EXPECT_EQ(maps.viewsDrawn, 6u) << "the lamp alone";
  expectFresh(lamp);

  // Out of the view of one side into that of another one.
  for (std::uint32_t v = 0; v < plate.count; ++v) scene.vertices[v].position += vec3(-1, 1.5f, 0);
  moved = updateScene(api, gpu, scene, {.moved = {plate}});
  expectFresh(drawn(scene, {.everything = false, .moved = moved}, maps));
}

// Plates that move one at a time or together, by a little or across the room; with a lamp that moves now and then.
TEST_F(ShadowViewsTest, HoldAfterAnyMovesWhatFreshMapsDo) {
  Scene scene = roomOfPlates();
  auto leaf = std::make_shared<Texture>();
  leaf->width = leaf->height = 8;
  for (std::size_t i = 0; i < 64; ++i)
    for (const int value : {255, 255, 255, i % 3 ? 255 : 0}) leaf->texels.push_back(static_cast<std::uint8_t>(value));
  scene.textures = {leaf};
  Material holes = scene.materials[0];
  holes.alphaMode = AlphaMode::mask;
  holes.baseColorTexture.texture = 0;
  const std::uint32_t leaves = addMaterial(scene, holes);
  for (std::size_t t = 0; t < 700; ++t) scene.triangles[t].material = leaves;  // a plate and a part of the next
  gpu = uploadScene(api, scene);
  ShadowMaps maps;
  std::vector<float> last = drawn(scene, {}, maps);
  const std::size_t stillBytes = maps.bytes();

  std::mt19937 random(11);
  std::uniform_real_distribution<float> small(-0.1f, 0.1f), large(-1.5f, 1.5f);
  std::size_t different = 0;
  for (int move = 0; move < 50; ++move) {
    SCOPED_TRACE(move);
    SceneChange change;
    for (std::uint32_t plate = 0; plate < 6; ++plate) {
      if (random() % 3) continue;
      // Now and then a part of a plate, which splits its clusters.
      VertexRange range{1024 * plate, 1024};
      if (random() % 4 == 0) range = {range.first + 4 * static_cast<std::uint32_t>(random() % 100), 300};
      auto& by = random() % 4 ? small : large;
      const vec3 shift(by(random), by(random), by(random));
      for (std::uint32_t v = range.first; v < range.first + range.count; ++v) scene.vertices[v].position += shift;
      change.moved.push_back(range);
    }
    if (move % 10 == 9) scene.lights[0].position += vec3(small(random));
    ShadowChange moved{.everything = false, .moved = {}};
    moved.add(updateScene(api, gpu, scene, change));
    const std::vector<float> depth = drawn(scene, moved, maps);
    ShadowMaps fresh;
    ASSERT_TRUE(depth == drawn(scene, {}, fresh));
    different += depth != last;
    last = depth;
  }
  EXPECT_GT(different, 40u);
  EXPECT_GT(maps.bytes(), stillBytes);
}

TEST_F(ShadowViewsTest, MayBeMoreAfterAMove) {
  Scene scene = roomOfPlates();
  gpu = uploadScene(api, scene);
  ShadowMaps maps;
  drawn(scene, {}, maps);
  for (std::uint32_t v = 0; v < 1024; ++v) scene.vertices[v].position.y += 0.05f;
  drawn(scene, {.everything = false, .moved = updateScene(api, gpu, scene, {.moved = {{0, 1024}}})}, maps);
  ASSERT_TRUE(maps.still);
  const auto expectFresh = [&] {
    const std::vector<float> depth = drawn(scene, {.everything = false, .moved = {}}, maps);
    ShadowMaps fresh;
    EXPECT_TRUE(depth == drawn(scene, {}, fresh));
    EXPECT_LT(*std::min_element(depth.begin(), depth.end()), 0.5f);
  };
  scene.lights.push_back(bulb({0.2f, 0.1f, 0}, kPi));
  expectFresh();
  settings.shadow.resolution = 96;
  expectFresh();
}

TEST_F(ShadowViewsTest, DrawOfAMoveWhatMovesAlone) {
  Scene scene = roomOfPlates();
  gpu = uploadScene(api, scene);
  ShadowMaps maps;
  drawn(scene, {}, maps);
  EXPECT_FALSE(maps.still) << "nothing has moved yet";
  for (int move = 0; move < 3; ++move) {
    for (std::uint32_t v = 0; v < 1024; ++v) scene.vertices[v].position.y += 0.05f;
    drawn(scene, {.everything = false, .moved = updateScene(api, gpu, scene, {.moved = {{0, 1024}}})}, maps);
    EXPECT_EQ(maps.viewsDrawn, 1u + 1 + 4) << "the lamp's side, the sun and the sky";
    if (move > 0) {
      EXPECT_EQ(maps.trianglesDrawn, (1 + 1 + 4) * 512u) << "the plate, but for the first move";
    }
  }
  EXPECT_EQ(maps.still.bytes(), maps.maps.bytes());
}

TEST_F(ShadowViewsTest, StayIfAMaterialChangesItsColorAndNotIfItsHolesDo) {
  Scene scene = roomOfPlates();
  Material holes = scene.materials[0];
  holes.alphaMode = AlphaMode::mask;
  const std::uint32_t leaves = addMaterial(scene, holes);
  scene.materials[leaves].baseColor.w = 0.6f;
  for (std::size_t t = 0; t < 512; ++t) scene.triangles[t].material = leaves;
  gpu = uploadScene(api, scene);
  ShadowMaps maps;
  drawn(scene, {}, maps);
  const auto move = [&] {
    for (std::uint32_t v = 0; v < 1024; ++v) scene.vertices[v].position.y += 0.05f;
    return ShadowChange{.everything = false, .moved = updateScene(api, gpu, scene, {.moved = {{0, 1024}}})};
  };
  drawn(scene, move(), maps);

  scene.materials[0].baseColor = {0.1f, 0.2f, 0.3f, 1};
  updateScene(api, gpu, scene, {.materials = true});
  const std::vector<float> before = drawn(scene, {.everything = false, .moved = {}}, maps);
  EXPECT_EQ(maps.viewsDrawn, 0u) << "a color";
  const std::vector<float> moved = drawn(scene, move(), maps);
  EXPECT_TRUE(moved != before);
  EXPECT_EQ(maps.trianglesDrawn, maps.viewsDrawn * 512u) << "what moves is still known";

  scene.materials[leaves].alphaCutoff = 0.9f;
  updateScene(api, gpu, scene, {.materials = true});
  const std::vector<float> gone = drawn(scene, {.everything = false, .moved = {}}, maps);
  EXPECT_EQ(maps.viewsDrawn, 6u + 1 + 4) << "holes";
  ShadowMaps fresh;
  EXPECT_TRUE(gone == drawn(scene, {}, fresh));
  EXPECT_TRUE(gone != moved);
}

TEST_F(ShadowViewsTest, ManyMovesBecomeOneBoxAroundThem) {
  ShadowChange change{.everything = false, .moved = {}};
  const std::vector<Bounds> boxes = {{vec3(-1), vec3(0)}, {}, {vec3(1, 2, 3), vec3(4)}};
  for (std::size_t i = 0; i < ShadowChange::kMaxMoved; ++i) {
    change.add(boxes);
    ASSERT_LE(change.moved.size(), ShadowChange::kMaxMoved);
  }
  change.moved.resize(ShadowChange::kMaxMoved);
  change.add(boxes);
  ASSERT_EQ(change.moved.size(), 1u);
  EXPECT_EQ(change.moved[0].low, vec3(-1));
  EXPECT_EQ(change.moved[0].high, vec3(4));
  EXPECT_FALSE(change.everything);
}

TEST_F(ShadowTest, SaysWhatThereIsNoRoomFor) {
  Scene scene = floorAndBox().scene;
  scene.sky = evenSky(vec3(1));
  for (int i = 0; i < 4; ++i) scene.lights.push_back(bulb({i, 5, 0}, 10));
  settings.shadow.resolution = 4096;  // 64 MiB a layer: 16 of them
  Camera camera;
  camera.eye = {8, 8, 8};
  draw(scene, camera, 8, 8);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("2 of 4 lights"), std::string::npos) << warnings[0];
  EXPECT_EQ(shadows.maps.shape().depth, 13);
  // The lights without shadows still shine.
  EXPECT_GT(middle(pixels(gbuffer.shaded)).x, 0.1f);
}

TEST_F(ShadowTest, SceneWithoutTrianglesOrLights) {
  Scene scene;
  scene.materials.emplace_back();
  Camera camera;
  draw(scene, camera, 4, 4);
  const glm::vec4 sky = middle(pixels(gbuffer.shaded));
  EXPECT_NEAR(sky.x, scene.sky.horizon.x, 0.3f);
  settings.shadow.skyDirections = 0;
  draw(scene, camera, 4, 4);
  EXPECT_NEAR(middle(pixels(gbuffer.shaded)).x, sky.x, 1e-6f);
}

}  // namespace
}  // namespace halfsilver::testing
