// What changes in a scene between frames, and what that costs: pictures are those of a renderer that was given the
// scene as it is now, and structures are built when something has moved and not otherwise.
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

constexpr int kWidth = 80, kHeight = 60;

bool took(const FrameReport& report, const std::string& stage) {
  return std::any_of(report.times.begin(), report.times.end(),
                     [&](const StageTime& time) { return time.stage == stage; });
}

// A soup above a mirror, lit by a lamp and the sun, with a leaf whose alpha is between 0.3 and 1.
Scene litSoup() {
  Scene scene = soup(400);
  scene.materials[1].metallic = 0.6f;
  scene.materials[1].roughness = 0.2f;
  auto leaf = plainTexture(8, 8, {60, 200, 60, 255}, true);
  for (std::size_t i = 0; i < 64; ++i) leaf->texels[4 * i + 3] = i % 8 < 4 ? 90 : 255;
  scene.textures = {leaf};
  Material material = plain({1, 1, 1});
  material.alphaMode = AlphaMode::mask;
  material.alphaCutoff = 0.1f;
  material.doubleSided = true;
  material.baseColorTexture.texture = 0;
  scene.materials.push_back(material);
  addQuad(scene, {-1.8f, 0.1f, -0.2f}, {1.8f, 0.1f, -0.2f}, {1.8f, 1.2f, -0.2f}, {-1.8f, 1.2f, -0.2f}, 2);
  Light sun, lamp;
  sun.direction = glm::normalize(glm::vec3(0.4f, -1, -0.3f));
  lamp.type = LightType::point;
  lamp.position = {0.5f, 1.8f, 0.5f};
  lamp.intensity = 3;
  scene.lights = {sun, lamp};
  return scene;
}

class SceneChangeTest : public TracingTest, public ::testing::WithParamInterface<const char*> {
 protected:
  SceneChangeTest() { set(settings_, "trace.method", GetParam()); }

  // Changes the scene of a renderer that has drawn it. The next picture is another one, and the one of a renderer that
  // sees the changed scene first.
  void expectFollowed(const std::function<void(Scene&)>& edit, const SceneChange& change) {
    Scene scene = litSoup();
    Renderer renderer = makeRenderer(scene);
    const Frame before = drawWholeWith(renderer, kAbove, settings_, kWidth, kHeight);
    EXPECT_GT(before.report.selected, 500u);
    edit(scene);
    renderer.update(scene, change);
    const Frame after = drawWholeWith(renderer, kAbove, settings_, kWidth, kHeight);
    EXPECT_TRUE(after.layers.data != before.layers.data);
    EXPECT_TRUE(after.layers.data == draw(scene, kAbove, settings_, kWidth, kHeight).layers.data);
  }

  Settings settings_ = settingsWith({{"shadow.resolution", "256"},
                                     {"shadow.sky_directions", "4"},
                                     {"voxels.resolution", "64"},
                                     {"abuffer.resolution", "64"}});
};

TEST_P(SceneChangeTest, ALightThatMovesMovesItsLightAndShadows) {
  expectFollowed([](Scene& scene) { scene.lights[1].position = {-1.2f, 0.9f, -1.0f}; }, {.lights = true});
}

TEST_P(SceneChangeTest, ALightChangesItsColor) {
  expectFollowed([](Scene& scene) { scene.lights[0].color = {1, 0.1f, 0.3f}; }, {.lights = true});
}

TEST_P(SceneChangeTest, LightsComeAndGo) {
  expectFollowed([](Scene& scene) { scene.lights.push_back(scene.lights[1]); }, {.lights = true});
  expectFollowed([](Scene& scene) { scene.lights.clear(); }, {.lights = true});
}

TEST_P(SceneChangeTest, AMaterialChangesItsColor) {
  expectFollowed([](Scene& scene) { scene.materials[1].baseColor = {0.1f, 0.2f, 0.9f, 1}; }, {.materials = true});
}

TEST_P(SceneChangeTest, AMirrorBecomesARoughMetal) {
  expectFollowed(
      [](Scene& scene) {
        scene.materials[0].mirror.reset();
        scene.materials[0].metallic = 1;
        scene.materials[0].roughness = 0.2f;
      },
      {.materials = true});
}

TEST_P(SceneChangeTest, AnOpaqueLeafGetsHoles) {
  expectFollowed([](Scene& scene) { scene.materials[2].alphaCutoff = 0.6f; }, {.materials = true});
}

TEST_P(SceneChangeTest, ASheetLosesItsBack) {
  expectFollowed([](Scene& scene) { scene.materials[1].doubleSided = false; }, {.materials = true});
}

TEST_P(SceneChangeTest, TheSkyChangesItsGradient) {
  expectFollowed([](Scene& scene) { scene.sky.zenith = {0.9f, 0.2f, 0.1f}; }, {.sky = true});
}

TEST_P(SceneChangeTest, AnImageReplacesTheGradientOfTheSky) {
  expectFollowed(
      [](Scene& scene) {
        scene.sky.imageWidth = 8;
        scene.sky.imageHeight = 4;
        for (int i = 0; i < 8 * 4 * 3; ++i) scene.sky.image.push_back(0.03f * static_cast<float>(i % 17));
      },
      {.sky = true});
}

TEST_P(SceneChangeTest, AllAtOnce) {
  expectFollowed(
      [](Scene& scene) {
        scene.lights[1].intensity = 9;
        scene.materials[1].baseColor = {0.1f, 0.9f, 0.2f, 1};
        scene.sky.horizon = {0.2f, 0.1f, 0.5f};
        for (std::size_t v = 4; v < 604; ++v) scene.vertices[v].position.y += 0.1f;
      },
      {.materials = true, .lights = true, .sky = true, .moved = {{4, 300}, {304, 300}}});
}

// What the renderer was not told of does not reach the picture. (Exact rays read the caller's materials.)
TEST_P(SceneChangeTest, LightsAndSkyStayAsTheyAreUnlessTheChangeNamesThem) {
  Scene scene = litSoup();
  Renderer renderer = makeRenderer(scene);
  const Frame before = drawWholeWith(renderer, kAbove, settings_, kWidth, kHeight);
  scene.lights.clear();
  scene.sky.zenith = {9, 9, 9};
  renderer.update(scene, {.materials = true});
  renderer.update(scene, {});
  EXPECT_TRUE(drawWith(renderer, kAbove, settings_, kWidth, kHeight).layers.data == before.layers.data);
}

class KeptStructureTest : public SceneChangeTest {};

TEST_P(KeptStructureTest, OnlyMovesBuild) {
  Scene scene = litSoup();
  Renderer renderer = makeRenderer(scene);
  std::uint64_t fragments = 0;
  const auto builds = [&] {
    const FrameReport report = drawWith(renderer, kAbove, settings_, kWidth, kHeight).report;
    // The GPU finds out by itself whether rays wait for anything: there is a section, but no fragment is made.
    const std::uint64_t before = std::exchange(fragments, report.memory.fragments);
    return took(report, "voxelize") || (took(report, "build") && (fragments == 0 || fragments != before));
  };
  EXPECT_TRUE(builds()) << "the first frame";
  EXPECT_FALSE(builds());
  scene.lights[1].position.x += 0.5f;
  renderer.update(scene, {.lights = true});
  EXPECT_FALSE(builds()) << "a light";
  scene.materials[1].baseColor = {0.3f, 0.3f, 0.9f, 1};
  renderer.update(scene, {.materials = true});
  EXPECT_FALSE(builds()) << "a material";
  scene.sky.zenith = {1, 0, 0};
  renderer.update(scene, {.sky = true});
  EXPECT_FALSE(builds()) << "the sky";
  for (std::uint32_t v = 4; v < 64; ++v) scene.vertices[v].position.y += 0.1f;
  renderer.update(scene, {.moved = {{4, 60}}});
  EXPECT_TRUE(builds()) << "an object";
  EXPECT_FALSE(builds()) << "the object stands still";
}

INSTANTIATE_TEST_SUITE_P(AllMethods, SceneChangeTest,
                         ::testing::Values("exact", "identity", "bvh", "attributes", "auto"),
                         [](const auto& method) { return std::string(method.param); });
INSTANTIATE_TEST_SUITE_P(KeepingMethods, KeptStructureTest, ::testing::Values("exact", "identity", "bvh", "auto"),
                         [](const auto& method) { return std::string(method.param); });

// Counts the tracers that a renderer makes.
class SettingsChangeTest : public TracingTest {
 protected:
  Renderer countingRenderer() {
    const auto make = [this, exact = makeExactTracerFactory(scene_, 2)](const gl::Api& gl, const Settings& settings) {
      ++tracers_;
      return exact(gl, settings);
    };
    Renderer renderer([this](const char* name) { return context.getProcAddress()(name); },
                      {{methodInfo("exact"), make}});
    renderer.setScene(scene_);
    return renderer;
  }

  Scene scene_ = litSoup();
  int tracers_ = 0;
};

// Sliders that no structure depends on.
const std::pair<const char*, const char*> kSliders[] = {
    {"trace.bounces", "3"},
    {"trace.bounces", "2"},
    {"image.exposure", "1.5"},
    {"select.fraction", "0.5"},
    {"select.max_roughness", "0.7"},
    {"select.min_reflectivity", "0.1"},
    {"select.min_contribution", "0.2"},
    {"select.pattern", "region"},
    {"select.fill", "sky"},
    {"select.mode", "all"},
    {"scene.cull_back_faces", "false"},
    {"image.tone_map", "none"},
    {"image.antialiasing", "fxaa"},
};

TEST_F(SettingsChangeTest, SlidersMakeNoExactTracerAndNoHierarchy) {
  Renderer renderer = countingRenderer();
  const Settings plainSettings = settingsWith({{"trace.method", "exact"}});
  const Frame first = drawWith(renderer, kAbove, plainSettings, kWidth, kHeight);
  EXPECT_TRUE(took(first.report, "build"));
  int other = 0;
  for (const auto& [name, value] : kSliders) {
    SCOPED_TRACE(name);
    Settings settings = plainSettings;
    set(settings, name, value);
    const Frame frame = drawWith(renderer, kAbove, settings, kWidth, kHeight);
    EXPECT_FALSE(took(frame.report, "build"));
    EXPECT_EQ(tracers_, 1);
    other += frame.layers.data != first.layers.data;
  }
  EXPECT_GE(other, 5);
  EXPECT_EQ(drawWith(renderer, kAbove, plainSettings, kWidth, kHeight).layers.data, first.layers.data);
  Settings method = plainSettings;
  set(method, "trace.method", "identity");
  drawWith(renderer, kAbove, method, kWidth, kHeight);
  drawWith(renderer, kAbove, plainSettings, kWidth, kHeight);
  EXPECT_EQ(tracers_, 2);
}

// Rays of later bounces ask for bricks once; from then on, a slider moves over what is there.
TEST_F(SettingsChangeTest, SlidersBuildNothingOfTheIdentityMethodTwice) {
  Renderer renderer = countingRenderer();
  const Settings plainSettings = settingsWith({{"trace.method", "identity"}});
  FrameReport before = drawWith(renderer, kAbove, plainSettings, kWidth, kHeight).report;
  EXPECT_TRUE(took(before, "voxelize"));
  for (const bool again : {false, true})
    for (const auto& [name, value] : kSliders) {
      SCOPED_TRACE(name);
      Settings settings = plainSettings;
      set(settings, name, value);
      const FrameReport report = drawWith(renderer, kAbove, settings, kWidth, kHeight).report;
      EXPECT_FALSE(took(report, "voxelize"));
      EXPECT_TRUE(!again || report.memory.fragments == before.memory.fragments);
      before = report;
    }
}

TEST_F(SettingsChangeTest, CullingCanBeToggled) {
  for (const char* method : {"exact", "identity"}) {
    SCOPED_TRACE(method);
    scene_.materials[1].doubleSided = false;
    Renderer renderer = countingRenderer();
    Settings settings = settingsWith({{"trace.method", method}});
    const Frame culled = drawWith(renderer, kAbove, settings, kWidth, kHeight);
    set(settings, "scene.cull_back_faces", "false");
    const Frame whole = drawWith(renderer, kAbove, settings, kWidth, kHeight);
    EXPECT_NE(whole.plane("hit.id"), culled.plane("hit.id"));
    EXPECT_EQ(whole.layers.data, drawOnce(scene_, kAbove, settings, kWidth, kHeight).layers.data);
    set(settings, "scene.cull_back_faces", "true");
    EXPECT_EQ(drawWith(renderer, kAbove, settings, kWidth, kHeight).layers.data, culled.layers.data);
  }
}

class RefusedChangeTest : public SettingsChangeTest {
 protected:
  static void expectUsageError(const std::function<void()>& call) {
    try {
      call();
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    }
  }
};

TEST_F(RefusedChangeTest, OtherCountsAreAnotherScene) {
  Renderer renderer = countingRenderer();
  const Settings settings = settingsWith({{"trace.method", "identity"}});
  const Frame before = drawWith(renderer, kAbove, settings, kWidth, kHeight);
  Scene vertices = scene_, triangles = scene_, materials = scene_, textures = scene_;
  vertices.vertices.emplace_back();
  triangles.triangles.pop_back();
  materials.materials.emplace_back();
  textures.textures.push_back(textures.textures[0]);
  for (const Scene* other : {&vertices, &triangles, &materials, &textures})
    expectUsageError([&] { renderer.update(*other, {.materials = true, .lights = true, .moved = {{0, 4}}}); });
  const auto count = static_cast<std::uint32_t>(scene_.vertices.size());
  expectUsageError([&] { renderer.update(scene_, {.moved = {{0, 4}, {count - 1, 2}}}); });
  expectUsageError([&] { renderer.update(scene_, SceneChange::everything()); });
  EXPECT_EQ(drawWith(renderer, kAbove, settings, kWidth, kHeight).layers.data, before.layers.data);
}

TEST_F(RefusedChangeTest, TexturesThatWereNotUploadedCannotBeNamed) {
  auto unused = plainTexture(4, 4, {255, 0, 0, 255}, true);
  scene_.textures.push_back(unused);
  Renderer renderer = countingRenderer();
  Scene other = scene_;
  other.materials[1].baseColorTexture.texture = 1;
  expectUsageError([&] { renderer.update(other, {.materials = true}); });
  other.materials[1].baseColorTexture.texture = 0;
  renderer.update(other, {.materials = true});
}

TEST_F(RefusedChangeTest, NothingChangesWhileAFrameIsUnderWay) {
  Renderer renderer = countingRenderer();
  const Settings settings = settingsWith({{"trace.method", "identity"}});
  const Frame before = drawWith(renderer, kAbove, settings, kWidth, kHeight);
  const gl::Texture color(api, {.format = GL_RGBA8, .width = kWidth, .height = kHeight}, "test picture");
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
  Scene other = scene_;
  other.lights.clear();
  renderer.begin(kAbove, settings, kWidth, kHeight);
  expectUsageError([&] { renderer.update(other, {.lights = true}); });
  expectUsageError([&] { renderer.updateVertices(other, std::vector<VertexRange>{{0, 4}}); });
  expectUsageError([&] { renderer.setScene(other); });
  renderer.finish({framebuffer.name(), 0, 0, kWidth, kHeight});
  EXPECT_EQ(renderer.readLayers().data, before.layers.data);
  renderer.update(other, {.lights = true});
  EXPECT_NE(drawWith(renderer, kAbove, settings, kWidth, kHeight).layers.data, before.layers.data);
}

TEST_F(RefusedChangeTest, AChangeNeedsAScene) {
  Renderer renderer([this](const char* name) { return context.getProcAddress()(name); });
  expectUsageError([&] { renderer.update(scene_, {.lights = true}); });
  expectUsageError([&] { renderer.begin(kAbove, {}, kWidth, kHeight); });
}

}  // namespace
}  // namespace halfsilver::testing
