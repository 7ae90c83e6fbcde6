#include <algorithm>
#include <cmath>
#include <cstring>

#include "frame/surface_reader.h"
#include "gpu/light_fixture.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
using glm::vec4;

// A quad that fills the lower half of the picture, seen at 45 degrees; the sky above.
class CompositeTest : public LightTest {
 protected:
  void setUp(const Material& material, const vec3& sky) {
    Scene scene;
    addQuad(scene, vec3(0), {100, 0, 0}, {0, 0, -100}, addMaterial(scene, material));
    scene.sky = evenSky(sky);
    settings.shadow.skyDirections = 0;
    Camera camera;
    camera.eye = {0, 1, 1};
    camera.target = {0, 0, 0};
    camera.verticalFov = 1e-3f;
    draw(scene, camera, 16, 16);
  }

  void trace(const vec4& radiance) { api.ClearTexImage(gbuffer.reflection.name(), 0, GL_RGBA, GL_FLOAT, &radiance); }

  static void expectColor(const vec4& found, const vec3& expected, float tolerance = 1e-3f) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
    EXPECT_EQ(found.w, 1);
  }
};

float encode(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

Material glowing(Material material, const vec3& color) {
  material.emissive = color;
  return material;
}

TEST_F(CompositeTest, DullSurfaceShowsItsOwnLight) {
  setUp(glowing(diffuse(vec3(0)), {0.3f, 0.2f, 0.1f}), vec3(0));
  trace({9, 9, 9, 1});
  expectColor(middle(composite(CompositePass::Output::linear)), {0.3f, 0.2f, 0.1f});
}

TEST_F(CompositeTest, PerfectMirrorShowsItsReflection) {
  setUp(glowing(mirror(1), vec3(7)), vec3(0.5f));
  trace({0.4f, 0.3f, 0.2f, 1});
  expectColor(middle(composite(CompositePass::Output::linear)), {0.4f, 0.3f, 0.2f});
  trace({9, 9, 9, 0});  // not traced: the sky
  expectColor(middle(composite(CompositePass::Output::linear)), vec3(0.5f));
}

TEST_F(CompositeTest, NeighboursStandInForWhatIsNotTraced) {
  setUp(mirror(1), vec3(0.5f));
  const auto traceOneOf = [&](int spacing) {
    std::vector<vec4> texels;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        texels.push_back(x % spacing == 1 && y % spacing == 1 ? vec4(0.1f * static_cast<float>(x), 2, 3, 1) : vec4(0));
    api.TextureSubImage2D(gbuffer.reflection.name(), 0, 0, 0, 16, 16, GL_RGBA, GL_FLOAT, texels.data());
  };
  traceOneOf(4);  // a sixteenth
  const std::vector<vec4> filled = composite(CompositePass::Output::linear);
  for (int y = 3; y < 12; ++y)
    for (int x = 3; x < 12; ++x) {
      const vec4& found = filled[static_cast<std::size_t>(16 * y + x)];
      EXPECT_NEAR(found.y, 2, 1e-3f);
      EXPECT_NEAR(found.x, 0.1f * static_cast<float>(x), 0.21f);  // never from further away than it reaches
    }
  settings.select.fill = Fill::sky;
  setUp(mirror(1), vec3(0.5f));
  traceOneOf(4);
  const std::vector<vec4> sky = composite(CompositePass::Output::linear);
  expectColor(sky[16 * 7 + 7], vec3(0.5f));
  EXPECT_NEAR(sky[16 * 9 + 9].y, 2, 1e-3f);
}

TEST_F(CompositeTest, SurfacesThatFaceElsewhereDoNotStandIn) {
  Scene scene;
  const std::uint32_t material = addMaterial(scene, mirror(1));
  addQuad(scene, {-100, 0, 0}, {100, 0, 0}, {0, 0, -100}, material);  // one lies, the other stands behind it
  addQuad(scene, {-100, 0, 0}, {100, 0, 0}, {0, 100, 0}, material);
  scene.sky = evenSky(vec3(0.5f));
  settings.shadow.skyDirections = 0;
  Camera camera;
  camera.eye = {0, 1, 1};
  camera.target = {0, 0.5f, 0.5f};
  camera.verticalFov = 1.0f;
  draw(scene, camera, 16, 16);
  const std::vector<vec4> normals = SurfaceReader(api).read(view()).normals;
  std::vector<vec4> texels;
  std::size_t lying = 0;
  for (std::size_t i = 0; i < 256; ++i) {
    const bool up = normals[i].y > 0.5f;
    lying += up;
    texels.push_back(up ? vec4(4, 0, 0, 1) : vec4(0));
  }
  ASSERT_GT(lying, 60u);
  ASSERT_LT(lying, 200u);
  api.TextureSubImage2D(gbuffer.reflection.name(), 0, 0, 0, 16, 16, GL_RGBA, GL_FLOAT, texels.data());
  const std::vector<vec4> image = composite(CompositePass::Output::linear);
  for (std::size_t i = 0; i < 256; ++i) expectColor(image[i], texels[i].w > 0 ? vec3(4, 0, 0) : vec3(0.5f));
}

TEST_F(CompositeTest, BlendsByFresnel) {
  setUp(glowing(mirror(0.2f), vec3(1)), vec3(0));
  trace({0, 2, 0, 1});
  const float f = 0.2f + 0.8f * std::pow(1 - std::sqrt(0.5f), 5.0f);
  expectColor(middle(composite(CompositePass::Output::linear)), {1 - f, 1 - f + 2 * f, 1 - f});
}

TEST_F(CompositeTest, RoughnessFadesTheTracedShareIntoTheSky) {
  Material metal;
  metal.baseColor = vec4(1);
  metal.roughness = 0.3f;  // fade 1/4
  setUp(metal, vec3(2));
  trace({0, 0, 0, 1});
  expectColor(middle(composite(CompositePass::Output::linear)), vec3(0.75f * 2), 0.01f);
}

TEST_F(CompositeTest, UnlitIsNotBlended) {
  Material material = diffuse({0.2f, 0.4f, 0.6f});
  material.unlit = true;
  material.roughness = 0;
  material.specular = 1;
  setUp(material, vec3(5));
  trace({9, 9, 9, 1});
  expectColor(middle(composite(CompositePass::Output::linear)), {0.2f, 0.4f, 0.6f});
}

TEST_F(CompositeTest, PixelsWithoutSurfaceShowTheSky) {
  setUp(diffuse(vec3(0)), {0.1f, 0.2f, 0.3f});
  Scene scene;
  scene.materials.emplace_back();
  scene.sky = evenSky({0.1f, 0.2f, 0.3f});
  draw(scene, Camera(), 4, 4);
  trace({9, 9, 9, 1});
  for (const vec4& pixel : composite(CompositePass::Output::linear)) expectColor(pixel, {0.1f, 0.2f, 0.3f});
}

TEST_F(CompositeTest, DisplayIsExposedAndEncoded) {
  settings.image.toneMap = ToneMap::none;
  settings.image.exposure = 1;
  setUp(glowing(diffuse(vec3(0)), {0.25f, 0.1f, 0.001f}), vec3(0));
  const std::vector<vec4> image = composite(CompositePass::Output::display);
  expectColor(middle(image), {encode(0.5f), encode(0.2f), encode(0.002f)}, 0.51f / 255);
  // The dither averages out over its tile of 8 x 8 pixels and stays within half a step.
  vec4 mean(0);
  for (const vec4& pixel : image) mean += pixel / static_cast<float>(image.size());
  expectColor(mean / mean.w, {encode(0.5f), encode(0.2f), encode(0.002f)}, 1e-4f);
}

// Contrast around 0.3, a shoulder that rises for ever and never reaches beyond white; the order of channels stays.
TEST_F(CompositeTest, FilmicCurve) {
  float last = -1;
  for (const float radiance : {0.0f, 0.05f, 0.2f, 0.45f, 0.7f, 1.0f, 2.0f, 5.0f, 50.0f}) {
    SCOPED_TRACE(radiance);
    setUp(glowing(diffuse(vec3(0)), radiance * vec3(1, 0.5f, 0.25f)), vec3(0));
    vec4 mean(0);
    const std::vector<vec4> image = composite(CompositePass::Output::display);
    for (const vec4& pixel : image) mean += pixel / static_cast<float>(image.size());
    EXPECT_GT(mean.x, last);
    EXPECT_LE(mean.x, 1);
    EXPECT_LE(mean.z, mean.y);
    EXPECT_LE(mean.y, mean.x);
    if (radiance < 0.3f) {
      EXPECT_NEAR(mean.x, encode(0.3f * std::pow(radiance / 0.3f, 1.12f)), 2e-3f);
    }
    if (radiance == 50.0f) {
      EXPECT_GT(mean.z, 0.8f);  // the brightest light is nearly white
    }
    last = mean.x;
  }
}

TEST_F(CompositeTest, KeepsToItsRectangle) {
  setUp(glowing(diffuse(vec3(0)), {1, 0, 0}), vec3(0));
  settings.image.toneMap = ToneMap::none;
  const gl::Texture target(api, {.format = GL_RGBA32F, .width = 32, .height = 32}, "target");
  const vec4 before(0, 0, 1, 0.5f);
  api.ClearTexImage(target.name(), 0, GL_RGBA, GL_FLOAT, &before);
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, target);
  compositePass.run(view(), CompositePass::Output::linear, {framebuffer.name(), 5, 9, gbuffer.width, gbuffer.height});
  const std::vector<vec4> image = pixels(target);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const vec4& pixel = image[static_cast<std::size_t>(32 * y + x)];
      const bool inside = x >= 5 && x < 21 && y >= 9 && y < 25;
      ASSERT_EQ(pixel, inside ? vec4(1, 0, 0, 1) : before) << x << ", " << y;
    }
}

}  // namespace
}  // namespace halfsilver::testing
