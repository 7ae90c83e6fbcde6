// Pictures that share depth with what the caller draws into the same framebuffer.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <vector>

#include <halfsilver/error.h>
#include "gl/draw_state.h"
#include "gl/program.h"
#include "gpu/light_fixture.h"
#include "gpu/render_fixture.h"
#include "temporary_folder.h"

namespace halfsilver::testing {
namespace {

constexpr int kWidth = 64, kHeight = 48;

// A mirror floor with a box on it under an open sky.
Scene boxOnFloor() {
  Scene scene;
  const std::uint32_t floor = addMaterial(scene, mirror(0.6f, {0.2f, 0.3f, 0.2f}));
  const std::uint32_t box = addMaterial(scene, diffuse({0.8f, 0.5f, 0.3f}));
  addQuad(scene, {0, 0, -1}, {3, 0, 0}, {0, 0, -3}, floor);
  addBox(scene, {-0.7f, 0, -1.5f}, {0.6f, 1.1f, -0.5f}, box);
  scene.sky = evenSky(glm::vec3(0.8f));
  return scene;
}

// The caller's: a long box through the floor and through the side of the scene's box, up into the sky, and one behind.
Scene callersObjects() {
  Scene objects;
  addBox(objects, {0.3f, -0.3f, -2.2f}, {0.9f, 1.6f, -0.2f}, addMaterial(objects, diffuse(glm::vec3(1))));
  addBox(objects, {-0.9f, 0.2f, -3}, {-0.1f, 1.9f, -2.5f}, 0);
  return objects;
}

Camera camera(float nearPlane = 0, float farPlane = 0) {
  Camera camera = lookAt({0.5f, 1.2f, 3}, {0, 0.6f, -1});
  camera.nearPlane = nearPlane;
  camera.farPlane = farPlane;
  return camera;
}

struct Pixels {
  std::vector<std::uint32_t> color;
  std::vector<float> depth;
};

enum class Way { plain, fxaa, temporal, samples };
constexpr Way kWays[] = {Way::plain, Way::fxaa, Way::temporal, Way::samples};

class TargetDepth : public RenderTest {
 protected:
  TargetDepth() {
    std::ofstream(shaders_ / "object.vert")
        << "uniform mat4 clip;\nuniform vec3 a, b, c;\n"
           "void main() { gl_Position = clip * vec4(gl_VertexID == 0 ? a : gl_VertexID == 1 ? b : c, 1); }\n";
    std::ofstream(shaders_ / "object.frag")
        << "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1, 0, 1, 1); }\n";
    ::setenv("HALFSILVER_SHADERS", shaders_.path().c_str(), 1);
    object_ = gl::Program::raster(api, "object.vert", "object.frag");
    ::unsetenv("HALFSILVER_SHADERS");
    useDepth(GL_DEPTH_COMPONENT32F);
  }

  void useDepth(GLenum format) {
    depth_ = gl::Texture(api, {.format = format, .width = kWidth, .height = kHeight}, "the caller's depth");
    framebuffer_.attach(GL_COLOR_ATTACHMENT0, color_);
    framebuffer_.attach(GL_DEPTH_ATTACHMENT, depth_);
  }
  Target target(DepthUse depth) const { return {framebuffer_.name(), 0, 0, kWidth, kHeight, depth}; }

  void clear(float depth) {
    gl::DrawState{.viewport = {0, 0, kWidth, kHeight}, .depthWrite = true}.apply(api);
    const float color[] = {0, 1, 0, 1};
    api.ClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, color);
    api.ClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &depth);
  }
  static float farthest(DepthUse depth) { return depth == DepthUse::reversed ? 0.0f : 1.0f; }

  // As a caller would, who knows of the renderer nothing but these matrices.
  void drawObjects(const Scene& objects, const CameraMatrices& matrices, DepthUse depth) {
    const bool reversed = depth == DepthUse::reversed;
    framebuffer_.bind();
    vertexArray_.bind();
    gl::DrawState{.viewport = {0, 0, kWidth, kHeight},
                  .depthTest = true,
                  .depthFunction = static_cast<GLenum>(reversed ? GL_GREATER : GL_LESS),
                  .depthWrite = true,
                  .clipDepth = static_cast<GLenum>(reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE),
                  .cullFaces = true}
        .apply(api);
    object_.set("clip", matrices.projection * matrices.view);
    object_.use();
    for (const Triangle& triangle : objects.triangles) {
      const char* names[] = {"a", "b", "c"};
      for (std::size_t i = 0; i < 3; ++i) object_.set(names[i], objects.vertices[triangle.vertices[i]].position);
      api.DrawArrays(GL_TRIANGLES, 0, 3);
    }
  }

  Pixels read() const {
    Pixels pixels{std::vector<std::uint32_t>(kWidth * kHeight), std::vector<float>(kWidth * kHeight)};
    color_.read(GL_RGBA, GL_UNSIGNED_BYTE, pixels.color.size() * 4, pixels.color.data());
    depth_.read(GL_DEPTH_COMPONENT, GL_FLOAT, pixels.depth.size() * 4, pixels.depth.data());
    return pixels;
  }

  // A picture of one way, with what the caller draws before and after each of its frames.
  Pixels picture(Renderer& renderer, const Camera& from, Way way, DepthUse depth,
                 const std::function<void()>& before = {}, const std::function<void()>& after = {}) {
    const char* names[] = {"none", "fxaa", "temporal", "none"};
    const Settings settings =
        settingsWith({{"trace.method", "exact"}, {"image.antialiasing", names[static_cast<std::size_t>(way)]}});
    const bool one = way == Way::plain || way == Way::fxaa;
    renderer.forgetHistory();
    for (std::uint32_t i = 0; i < (one ? 1u : 3u); ++i) {
      clear(farthest(depth));
      if (before) before();
      if (way == Way::samples)
        renderer.refine(from, settings, target(depth), i);
      else
        renderer.render(from, settings, target(depth));
      if (after) after();
    }
    return read();
  }

  TemporaryFolder shaders_;
  gl::Program object_;
  gl::EmptyVertexArray vertexArray_{api};
  gl::Texture color_{api, {.format = GL_RGBA8, .width = kWidth, .height = kHeight}, "the caller's picture"};
  gl::Texture depth_;
  gl::Framebuffer framebuffer_{api};
};

std::size_t count(const std::vector<float>& values, float value) {
  return static_cast<std::size_t>(std::count(values.begin(), values.end(), value));
}

TEST_F(TargetDepth, ACopyOfTheSceneThatTheCallerDrawsHasItsDepths) {
  const Scene scene = boxOnFloor();
  Renderer renderer = makeRenderer(scene);
  for (const DepthUse depth : {DepthUse::standard, DepthUse::reversed})
    for (const Camera& from : {camera(), camera(0, 9), camera(0.3f), camera(0.3f, 7.5f)}) {
      SCOPED_TRACE(::testing::Message() << "reversed " << (depth == DepthUse::reversed) << ", near " << from.nearPlane
                                        << ", far " << from.farPlane);
      const Pixels ours = picture(renderer, from, Way::plain, depth);
      clear(farthest(depth));
      drawObjects(scene, renderer.matrices(from, target(depth)), depth);
      const Pixels copy = read();
      std::size_t surfaces = 0, wrong = 0;
      for (std::size_t i = 0; i < copy.depth.size(); ++i) {
        surfaces += copy.depth[i] != farthest(depth);
        wrong += !(std::abs(copy.depth[i] - ours.depth[i]) < 2e-6f);
      }
      EXPECT_EQ(wrong, 0u);
      EXPECT_GT(surfaces, 1000u);
      EXPECT_EQ(count(ours.depth, farthest(depth)), ours.depth.size() - surfaces);
      EXPECT_GT(ours.depth.size() - surfaces, 500u) << "there is a sky";
      EXPECT_GT(*std::max_element(ours.depth.begin(), ours.depth.end()) -
                    *std::min_element(ours.depth.begin(), ours.depth.end()),
                0.03f);
    }
}

TEST_F(TargetDepth, WhateverSmoothsEdgesDepthIsThatOfTheNewestFrame) {
  const Scene scene = boxOnFloor();
  Renderer renderer = makeRenderer(scene);
  const Camera from = camera(0.3f, 9);
  std::vector<std::vector<float>> seen;
  for (const DepthUse depth : {DepthUse::standard, DepthUse::reversed})
    for (const Way way : kWays) {
      SCOPED_TRACE(static_cast<int>(way));
      const Pixels ours = picture(renderer, from, way, depth);
      const std::vector<float> along = Frame{renderer.readLayers(), {}}.plane("depth.Z");
      const glm::mat4 projection = renderer.matrices(from, target(depth)).projection;
      std::size_t wrong = 0;
      for (std::size_t y = 0; y < kHeight; ++y)
        for (std::size_t x = 0; x < kWidth; ++x) {
          const float z = along[(kHeight - 1 - y) * kWidth + x];  // rows from the top
          const glm::vec4 clip = projection * glm::vec4(0, 0, -z, 1);
          const float ndc = clip.z / clip.w;
          const float expected = z <= 0 ? farthest(depth) : depth == DepthUse::reversed ? ndc : 0.5f * ndc + 0.5f;
          wrong += !(std::abs(ours.depth[y * kWidth + x] - expected) < 2e-6f);
        }
      EXPECT_EQ(wrong, 0u);
      EXPECT_GT(count(ours.depth, farthest(depth)), 500u);
      seen.push_back(ours.depth);
    }
  EXPECT_EQ(seen[0], seen[1]) << "fxaa moves no sample";
  EXPECT_NE(seen[0], seen[2]);
  EXPECT_NE(seen[0], seen[3]);
}

TEST_F(TargetDepth, TheNearerSurfaceIsSeenWhoeverDrawsFirst) {
  const Scene scene = boxOnFloor(), objects = callersObjects();
  Renderer renderer = makeRenderer(scene);
  const Camera from = camera(0.3f);
  const std::uint32_t magenta = 0xffff00ff;
  for (const GLenum format : {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24}) {
    useDepth(format);
    for (const DepthUse depth : {DepthUse::standard, DepthUse::reversed})
      for (const Way way : kWays) {
        SCOPED_TRACE(::testing::Message() << "format " << format << ", reversed " << (depth == DepthUse::reversed)
                                          << ", way " << static_cast<int>(way));
        const auto draw = [&] { drawObjects(objects, renderer.matrices(from, target(depth)), depth); };
        clear(farthest(depth));
        draw();
        const Pixels theirs = read();
        const Pixels ours = picture(renderer, from, way, depth);
        const Pixels after = picture(renderer, from, way, depth, {}, draw);
        const Pixels before = picture(renderer, from, way, depth, draw);
        std::size_t wrong = 0, hidden = 0, hiding = 0, beforeSky = 0;
        for (std::size_t i = 0; i < theirs.depth.size(); ++i) {
          const bool drawn = theirs.color[i] == magenta;
          const float sign = depth == DepthUse::reversed ? -1.0f : 1.0f;
          const bool nearer = drawn && sign * theirs.depth[i] < sign * ours.depth[i];
          hidden += drawn && !nearer;
          hiding += nearer;
          beforeSky += nearer && ours.depth[i] == farthest(depth);
          wrong += before.color[i] != (nearer ? magenta : ours.color[i]) ||
                   before.depth[i] != (nearer ? theirs.depth[i] : ours.depth[i]);
        }
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(before.color, after.color);
        EXPECT_EQ(before.depth, after.depth);
        EXPECT_GT(hidden, 50u);
        EXPECT_GT(beforeSky, 50u);
        EXPECT_GT(hiding, beforeSky + 50);
      }
  }
}

TEST_F(TargetDepth, WithoutAUseDepthStaysAndThePictureCoversAll) {
  const Scene scene = boxOnFloor();
  Renderer renderer = makeRenderer(scene);
  for (const Way way : kWays) {
    SCOPED_TRACE(static_cast<int>(way));
    const Pixels standard = picture(renderer, camera(), way, DepthUse::standard);
    const Pixels reversed = picture(renderer, camera(), way, DepthUse::reversed);
    const auto draw = [&] { drawObjects(callersObjects(), renderer.matrices(camera(), target({})), {}); };
    clear(1);
    draw();
    const std::vector<float> theirs = read().depth;
    const Pixels plain = picture(renderer, camera(), way, DepthUse::none, draw);
    EXPECT_EQ(plain.color, standard.color) << "a picture before nothing but cleared depth is the same";
    EXPECT_EQ(plain.color, reversed.color);
    EXPECT_EQ(plain.depth, theirs);
    EXPECT_LT(count(theirs, 1), theirs.size() - 200);
  }
}

TEST_F(TargetDepth, SamplesInATargetThatKeepsTheirDepthHideThoseBehindThem) {
  const Scene scene = boxOnFloor();
  Renderer renderer = makeRenderer(scene);
  const Settings settings = settingsWith({{"trace.method", "exact"}});
  for (const DepthUse depth : {DepthUse::standard, DepthUse::reversed}) {
    const Pixels right = picture(renderer, camera(0.3f), Way::samples, depth);
    const std::vector<float> sum = renderer.readLayers().data;
    renderer.forgetHistory();
    clear(farthest(depth));
    std::vector<float> nearest(right.depth.size(), farthest(depth));
    for (std::uint32_t sample = 0; sample < 3; ++sample) {
      renderer.refine(camera(0.3f), settings, target(depth), sample);
      const std::vector<float> now = read().depth;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const bool nearer = depth == DepthUse::reversed ? now[i] >= nearest[i] : now[i] <= nearest[i];
        EXPECT_TRUE(nearer) << "depth is that of the nearest sample so far";
        nearest[i] = now[i];
      }
    }
    EXPECT_EQ(renderer.readLayers().data, sum) << "the mean itself misses nothing";
    const Pixels kept = read();
    std::size_t hidden = 0, shown = 0;
    for (std::size_t i = 0; i < kept.color.size(); ++i) {
      hidden += kept.color[i] != right.color[i];
      shown += kept.depth[i] == right.depth[i];
      EXPECT_TRUE(kept.color[i] == right.color[i] || kept.depth[i] != right.depth[i]) << "what is not hidden is right";
    }
    EXPECT_GT(hidden, 8u);
    EXPECT_GT(shown, 500u);
  }
}

TEST_F(TargetDepth, OutsideTheRectangleNothingChanges) {
  const Scene scene = boxOnFloor();
  Renderer renderer = makeRenderer(scene);
  clear(1);
  const Pixels empty = read();
  const Target part{framebuffer_.name(), 16, 8, 32, 24, DepthUse::standard};
  renderer.render(camera(), settingsWith({{"trace.method", "exact"}}), part);
  const Pixels pixels = read();
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y * kWidth + x); };
  std::size_t drawn = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
      const bool same = pixels.color[at(x, y)] == empty.color[at(x, y)] && pixels.depth[at(x, y)] == 1;
      if (!inside) {
        ASSERT_TRUE(same) << x << ", " << y;
      }
      drawn += pixels.depth[at(x, y)] < 1;
    }
  EXPECT_GT(drawn, 200u);
  for (const glm::ivec2 pixel : {glm::ivec2(16, 4), glm::ivec2(14, 9)}) {
    const auto picked = renderer.pick(pixel.x, pixel.y);
    ASSERT_TRUE(picked);
    const CameraMatrices matrices = renderer.matrices(camera(), part);
    const glm::vec4 seen = matrices.projection * matrices.view * glm::vec4(picked->position, 1);
    EXPECT_NEAR((0.5f * seen.x / seen.w + 0.5f) * 32, static_cast<float>(pixel.x) + 0.5f, 1e-3f);
    EXPECT_NEAR((0.5f * seen.y / seen.w + 0.5f) * 24, static_cast<float>(pixel.y) + 0.5f, 1e-3f);
    EXPECT_NEAR(0.5f * seen.z / seen.w + 0.5f, pixels.depth[at(part.x + pixel.x, part.y + pixel.y)], 2e-6f);
  }
}

TEST_F(TargetDepth, ATargetWithoutDepthIsDrawnAsWithNone) {
  const Scene scene = boxOnFloor();
  Renderer renderer = makeRenderer(scene);
  const std::vector<std::uint32_t> plain = picture(renderer, camera(), Way::plain, DepthUse::none).color;
  framebuffer_ = gl::Framebuffer(api);
  framebuffer_.attach(GL_COLOR_ATTACHMENT0, color_);
  renderer.render(camera(), settingsWith({{"trace.method", "exact"}}), target(DepthUse::reversed));
  EXPECT_EQ(read().color, plain);
  EXPECT_GT(std::count(plain.begin(), plain.end(), plain.back()), 0);
  EXPECT_NE(plain.front(), plain.back());
}

TEST_F(TargetDepth, MatricesNeedASceneASizeAndACamera) {
  Renderer renderer([this](const char* name) { return context.getProcAddress()(name); });
  EXPECT_THROW(static_cast<void>(renderer.matrices(camera(), target({}))), Error);
  renderer.setScene(boxOnFloor());
  EXPECT_NO_THROW(static_cast<void>(renderer.matrices(camera(), target({}))));
  EXPECT_THROW(static_cast<void>(renderer.matrices(camera(), {})), Error);
  EXPECT_THROW(static_cast<void>(renderer.matrices(lookAt({1, 2, 3}, {1, 2, 3}), target({}))), Error);
}

}  // namespace
}  // namespace halfsilver::testing
