#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/builtin.h>
#include <halfsilver/gl/profiler.h>
#include "gl/draw_state.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gpu/binding_audit.h"
#include "gpu/tracing_scenes.h"
#include "temporary_folder.h"

// No pass leans on what somebody else has bound or set.
namespace halfsilver::testing {
namespace {

// Small programs that are right or wrong on purpose.
class BindingAuditTest : public ContextTest {
 protected:
  BindingAuditTest() : watched_(gl::Api::load(audit_.getProcAddress())), buffer_(watched_, 64, "numbers") {
    ::setenv("HALFSILVER_SHADERS", folder_.path().c_str(), 1);
    const std::string header = "layout(local_size_x = 1) in;\n";
    write("copy.comp", header +
                           "layout(std430, binding = 2) readonly buffer InBlock { uint from; };\n"
                           "layout(std430, binding = 5) buffer OutBlock { uint to; };\n"
                           "void main() { to = from; }\n");
    write("other.comp", header +
                            "layout(std430, binding = 5) buffer OtherBlock { uint other; };\n"
                            "void main() { other = 1u; }\n");
    write("texture.comp", header +
                              "layout(binding = 3) uniform sampler2D pictures[2];\n"
                              "layout(std140, binding = 1) uniform StepBlock { uint steps; };\n"
                              "layout(rgba8, binding = 4) writeonly uniform image2D result;\n"
                              "void main() { imageStore(result, ivec2(0), texelFetch(pictures[0], ivec2(steps), 0) + "
                              "texelFetch(pictures[1], ivec2(0), 0)); }\n");
    write("corner.vert", "void main() { gl_Position = vec4(gl_VertexID & 1, gl_VertexID >> 1, 0, 1); }\n");
    write("white.frag", "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1); }\n");
  }
  ~BindingAuditTest() override { ::unsetenv("HALFSILVER_SHADERS"); }

  void write(const std::string& file, const std::string& text) const { std::ofstream(folder_ / file) << text; }
  gl::Program compute(const std::string& file) const { return gl::Program::compute(watched_, file); }

  const std::vector<std::string>& complaints() const { return audit_.complaints(); }

  TemporaryFolder folder_;
  BindingAudit audit_{context.getProcAddress()};
  gl::Api watched_;
  gl::Profiler profiler_{watched_};
  gl::Buffer buffer_;
};

TEST_F(BindingAuditTest, FindsNothingInAPassThatBindsAll) {
  const gl::Program copy = compute("copy.comp");
  for (int i = 0; i < 2; ++i) {
    const auto section = profiler_.section("copy");
    copy.use();
    buffer_.bindStorage(2);
    buffer_.bindStorage(5);
    watched_.DispatchCompute(1, 1, 1);
  }
  EXPECT_EQ(complaints(), std::vector<std::string>{});
  EXPECT_EQ(audit_.checks("copy"), 2u);
}

TEST_F(BindingAuditTest, NamesABlockThatAnotherPassBound) {
  const gl::Program copy = compute("copy.comp");
  const auto frame = profiler_.section("frame");
  buffer_.bindStorage(2);
  {
    const auto section = profiler_.section("first");
    copy.use();
    buffer_.bindStorage(5);
    watched_.DispatchCompute(1, 1, 1);
  }
  const auto section = profiler_.section("second");
  buffer_.bindStorage(2);
  buffer_.bindStorage(5);
  watched_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, 0);
  watched_.DispatchCompute(1, 1, 1);
  EXPECT_EQ(complaints(), (std::vector<std::string>{
                              "pass 'first': block InBlock (number 2) of program copy.comp was not bound by the pass",
                              "pass 'second': program copy.comp was not chosen by the pass",
                              "pass 'second': block OutBlock (number 5) of program copy.comp was not bound by the "
                              "pass"}));
}

TEST_F(BindingAuditTest, NamesANumberWithTwoMeanings) {
  const gl::Program copy = compute("copy.comp"), other = compute("other.comp");
  const auto run = [&](const gl::Program& program) {
    program.use();
    buffer_.bindStorage(2);
    buffer_.bindStorage(5);
    watched_.DispatchCompute(1, 1, 1);
  };
  for (const gl::Program* program : {&copy, &other}) {
    const auto section = profiler_.section("apart");
    run(*program);
  }
  EXPECT_EQ(complaints(), std::vector<std::string>{}) << "passes may differ";
  const auto section = profiler_.section("both");
  run(copy);
  run(other);
  EXPECT_EQ(complaints(), (std::vector<std::string>{"pass 'both': storage number 5 is OutBlock of program copy.comp "
                                                    "and OtherBlock of program other.comp"}));
}

TEST_F(BindingAuditTest, NamesTexturesImagesAndUniformBlocks) {
  const gl::Program program = compute("texture.comp");
  const gl::Texture texture(watched_, {.format = GL_RGBA8, .width = 4, .height = 4}, "test");
  const auto bindAll = [&] {
    texture.bind(3);
    texture.bind(4);
    texture.bindImage(4, GL_WRITE_ONLY);
    buffer_.bindUniform(1);
  };
  bindAll();
  const auto section = profiler_.section("texture");
  program.use();
  texture.bind(3);
  watched_.DispatchCompute(1, 1, 1);
  const std::vector<std::string> found = complaints();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0],
            "pass 'texture': uniform block StepBlock (number 1) of program texture.comp was not bound by the pass");
  const std::vector<std::string> units(found.begin() + 1, found.end());
  for (const char* text : {"sampler pictures[1] (unit 4)", "image result (unit 4)"})
    EXPECT_TRUE(units[0].find(text) != std::string::npos || units[1].find(text) != std::string::npos)
        << text << "\n"
        << units[0] << "\n"
        << units[1];
  bindAll();
  watched_.DispatchCompute(1, 1, 1);
  EXPECT_EQ(complaints().size(), 3u) << "all is bound now";
}

TEST_F(BindingAuditTest, NamesIndirectArgumentsThatAnotherPassBound) {
  const gl::Program other = compute("other.comp");
  buffer_.fill(1);
  watched_.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer_.name());
  const auto section = profiler_.section("indirect");
  other.use();
  buffer_.bindStorage(5);
  watched_.DispatchComputeIndirect(0);
  EXPECT_EQ(complaints(), (std::vector<std::string>{"pass 'indirect': the arguments of an indirect dispatch with "
                                                    "program other.comp were not bound by the pass"}));
}

TEST_F(BindingAuditTest, NamesDrawStateThatThePassDoesNotSet) {
  const gl::Program program = gl::Program::raster(watched_, "corner.vert", "white.frag");
  const gl::Texture color(watched_, {.format = GL_RGBA8, .width = 4, .height = 4}, "test");
  const gl::Framebuffer framebuffer(watched_);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
  const gl::EmptyVertexArray vertices(watched_);
  const auto draw = [&](bool state) {
    program.use();
    framebuffer.bind();
    if (state) {
      vertices.bind();
      gl::DrawState{.viewport = {0, 0, 4, 4}, .depthTest = true, .cullFaces = true}.apply(watched_);
    }
    watched_.DrawArrays(GL_TRIANGLES, 0, 3);
  };
  {
    const auto section = profiler_.section("whole");
    draw(true);
  }
  EXPECT_EQ(complaints(), std::vector<std::string>{});
  const auto section = profiler_.section("part");
  draw(false);
  EXPECT_EQ(complaints().size(), 16u) << "all but the framebuffer";
  const std::string end = " was not set by the pass that draws with program white.frag";
  for (const char* state : {"viewport", "vertex array", "depth function", "front face", "color mask"})
    EXPECT_NE(std::find(complaints().begin(), complaints().end(), std::string("pass 'part': the ") + state + end),
              complaints().end())
        << state;
}

using Values = std::initializer_list<std::pair<const char*, const char*>>;

// The public renderer, watched.
class Bindings : public ContextTest {
 protected:
  // A still frame, one more, and one after the last vertices have moved.
  void expectNothingBorrowed(Scene scene, const Camera& camera, const Values& values) {
    Settings settings;
    set(settings, "shadow.resolution", "64");
    set(settings, "shadow.sky_directions", "4");
    set(settings, "trace.bounces", "2");
    for (const auto& [name, value] : values) set(settings, name, value);

    BindingAudit audit(context.getProcAddress());
    Renderer renderer(audit.getProcAddress());
    renderer.setScene(scene);
    render(renderer, camera, settings);
    render(renderer, camera, settings);
    const VertexRange moving{static_cast<std::uint32_t>(scene.vertices.size()) - 30, 30};
    for (std::uint32_t v = moving.first; v < moving.first + moving.count; ++v)
      scene.vertices[v].position += glm::vec3(0.01f, 0.02f, 0);
    renderer.updateVertices(scene, std::span(&moving, 1));
    render(renderer, camera, settings);
    const FrameReport report = renderer.report();
    renderer.readLayers();

    EXPECT_GT(report.selected, 100u) << "there must be rays";
    for (const char* pass : {"shadow", "gbuffer", "select", "build", "trace", "shade", "composite"})
      EXPECT_GT(audit.checks(pass), 0u) << pass;
    EXPECT_EQ(audit.checks("voxelize") > 0, settings.trace.method != "depth-cube") << "which has no voxels";
    for (const std::string& complaint : audit.complaints()) ADD_FAILURE() << complaint;
  }

  void render(Renderer& renderer, const Camera& camera, const Settings& settings) const {
    const gl::Texture color(api, {.format = GL_RGBA8, .width = 64, .height = 48}, "test picture");
    const gl::Framebuffer framebuffer(api);
    framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
    renderer.render(camera, settings, {framebuffer.name(), 0, 0, 64, 48});
  }
};

Scene litSoup() {
  Scene scene = soup(300);
  Light light;
  light.type = LightType::point;
  light.position = {0, 2, 0};
  scene.lights = {light};
  return scene;
}

TEST_F(Bindings, OfTheDefaultOnTheSphere) {
  const Model model = makeBuiltin("sphere");
  expectNothingBorrowed(model.scene, model.scene.cameras.front(), {});
}

TEST_F(Bindings, OfIdentityLists) { expectNothingBorrowed(litSoup(), kAbove, {}); }

TEST_F(Bindings, OfIdentityListsThatFollowMoves) {
  expectNothingBorrowed(litSoup(), kAbove, {{"abuffer.keep", "true"}, {"voxels.axis", "own"}});
}

TEST_F(Bindings, OfALayeredDepthCube) {
  expectNothingBorrowed(litSoup(), kAbove, {{"trace.method", "depth-cube"}, {"abuffer.resolution", "128"}});
}

TEST_F(Bindings, OfVoxelsAlone) {
  expectNothingBorrowed(litSoup(), kAbove, {{"trace.method", "voxels"}, {"voxels.resolution", "32"}});
}

TEST_F(Bindings, OfShiftedEdges) {
  expectNothingBorrowed(litSoup(), kAbove,
                        {{"trace.method", "attributes"},
                         {"voxels.resolution", "32"},
                         {"voxels.raster", "shifted"},
                         {"voxels.axis", "normal"},
                         {"abuffer.resolution", "128"}});
}

TEST_F(Bindings, OfAttributesInPages) {
  expectNothingBorrowed(litSoup(), kAbove,
                        {{"trace.method", "attributes"},
                         {"voxels.resolution", "32"},
                         {"voxels.raster", "voxel"},
                         {"voxels.axis", "normal"},
                         {"abuffer.resolution", "128"}});
}

TEST_F(Bindings, OfAttributesInSortedLinkedListsOfThreeBuffers) {
  expectNothingBorrowed(litSoup(), kAbove,
                        {{"trace.method", "attributes"},
                         {"voxels.resolution", "32"},
                         {"voxels.raster", "abuffer"},
                         {"voxels.axis", "normal"},
                         {"abuffer.resolution", "128"},
                         {"abuffer.buffers", "three"},
                         {"abuffer.lists", "linked"},
                         {"abuffer.sorted", "true"},
                         {"search.test", "depth"}});
}

TEST_F(Bindings, OfWhittedsRays) {
  expectNothingBorrowed(litSoup(), kAbove, {{"trace.effect", "whitted"}, {"trace.bounces", "2"}});
  expectNothingBorrowed(litSoup(), kAbove, {{"trace.effect", "whitted"}, {"trace.method", "attributes"}});
}

TEST_F(Bindings, OfSmoothEdges) {
  for (const char* antialiasing : {"fxaa", "temporal"}) {
    SCOPED_TRACE(antialiasing);
    expectNothingBorrowed(litSoup(), kAbove, {{"image.antialiasing", antialiasing}});
  }
}

TEST_F(Bindings, OfGlossyReflectionsThatLookAtTheScreen) {
  expectNothingBorrowed(litSoup(), kAbove, {{"effect.glossy", "true"}, {"effect.samples", "2"}});
}

TEST_F(Bindings, OfClearCoats) {
  Scene scene = litSoup();
  for (Material& material : scene.materials) {
    material.coat = 1;
    material.sheenColor = {0.2f, 0.5f, 0.4f};
    material.anisotropy = 0.6f;
  }
  for (const char* shadows : {"maps", "rays", "refined"}) {
    SCOPED_TRACE(shadows);
    expectNothingBorrowed(scene, kAbove, {{"shadow.method", shadows}});
  }
  expectNothingBorrowed(scene, kAbove, {{"effect.glossy", "true"}});
}

TEST_F(Bindings, OfATally) { expectNothingBorrowed(litSoup(), kAbove, {{"trace.tally", "true"}}); }

TEST_F(Bindings, OfTracingInFragments) { expectNothingBorrowed(litSoup(), kAbove, {{"trace.stage", "fragment"}}); }

}  // namespace
}  // namespace halfsilver::testing
