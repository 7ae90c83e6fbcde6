// Which views of the shadow maps are drawn, and drawn again.
#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <random>
#include <vector>

#include "gpu/light_fixture.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
constexpr float kPi = glm::pi<float>();

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

class ShadowViewsTest : public LightTest {
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

}  // namespace
}  // namespace halfsilver::testing
