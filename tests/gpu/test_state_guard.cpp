#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <halfsilver/gl/buffer.h>
#include <halfsilver/gl/texture.h>
#include "gl/draw_state.h"
#include "gl/framebuffer.h"
#include "gl/state_guard.h"
#include "gpu/context_fixture.h"

namespace halfsilver {
namespace {

constexpr GLuint kUnits = 18, kImages = 8, kBuffers = 16;

// Everything that a caller may have set, read back as text: one line each, so that a difference says where.
class Snapshot {
 public:
  explicit Snapshot(const gl::Api& api) : api_(api) {
    for (const GLenum name : {GL_CURRENT_PROGRAM,
                              GL_VERTEX_ARRAY_BINDING,
                              GL_DRAW_FRAMEBUFFER_BINDING,
                              GL_READ_FRAMEBUFFER_BINDING,
                              GL_DEPTH_FUNC,
                              GL_DEPTH_WRITEMASK,
                              GL_CULL_FACE_MODE,
                              GL_FRONT_FACE,
                              GL_CLIP_ORIGIN,
                              GL_CLIP_DEPTH_MODE,
                              GL_PROVOKING_VERTEX,
                              GL_ACTIVE_TEXTURE,
                              GL_SHADER_STORAGE_BUFFER_BINDING,
                              GL_UNIFORM_BUFFER_BINDING,
                              GL_DRAW_INDIRECT_BUFFER_BINDING,
                              GL_DISPATCH_INDIRECT_BUFFER_BINDING,
                              GL_PIXEL_PACK_BUFFER_BINDING,
                              GL_PIXEL_UNPACK_BUFFER_BINDING,
                              GL_PACK_ALIGNMENT,
                              GL_PACK_ROW_LENGTH,
                              GL_PACK_SKIP_ROWS,
                              GL_UNPACK_ALIGNMENT,
                              GL_UNPACK_ROW_LENGTH,
                              GL_UNPACK_SKIP_PIXELS,
                              GL_POLYGON_MODE,
                              GL_POLYGON_OFFSET_FACTOR,
                              GL_POLYGON_OFFSET_UNITS})
      integers(name);
    for (const GLenum name : {GL_DEPTH_TEST, GL_DEPTH_CLAMP, GL_STENCIL_TEST, GL_CULL_FACE, GL_POLYGON_OFFSET_FILL,
                              GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD, GL_COLOR_LOGIC_OP, GL_DITHER, GL_MULTISAMPLE,
                              GL_SAMPLE_ALPHA_TO_COVERAGE, GL_PRIMITIVE_RESTART, GL_CLIP_DISTANCE0})
      line("enabled", name, 0, api.IsEnabled(name));
    for (GLuint i = 0; i < 16; ++i) viewport(i);
    for (GLuint i = 0; i < 8; ++i) drawBuffer(i);
    for (GLuint i = 0; i < kImages; ++i)
      for (const GLenum name : {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYERED,
                                GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT})
        indexed(name, i);
    for (GLuint i = 0; i < kBuffers; ++i)
      for (const GLenum name :
           {GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE})
        indexed(name, i);
    for (GLuint i = 0; i < 2; ++i)
      for (const GLenum name : {GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE})
        indexed(name, i);
    units();
  }

  const std::vector<std::string>& lines() const { return lines_; }

 private:
  template <class Value>
  void line(const char* kind, GLenum name, GLuint index, Value value) {
    lines_.push_back(std::string(kind) + " " + std::to_string(name) + "[" + std::to_string(index) +
                     "] = " + std::to_string(value));
  }
  void integers(GLenum name) {
    std::array<GLint, 4> values{};
    api_.GetIntegerv(name, values.data());
    line("integer", name, 0, values[0]);
  }
  void indexed(GLenum name, GLuint index) {
    GLint64 value = 0;
    api_.GetInteger64i_v(name, index, &value);
    line("indexed", name, index, value);
  }
  void viewport(GLuint index) {
    std::array<float, 4> box{};
    std::array<double, 2> depth{};
    std::array<GLint, 4> scissor{};
    api_.GetFloati_v(GL_VIEWPORT, index, box.data());
    api_.GetDoublei_v(GL_DEPTH_RANGE, index, depth.data());
    api_.GetIntegeri_v(GL_SCISSOR_BOX, index, scissor.data());
    for (const float value : box) line("viewport", GL_VIEWPORT, index, value);
    for (const double value : depth) line("depth range", GL_DEPTH_RANGE, index, value);
    for (const GLint value : scissor) line("scissor", GL_SCISSOR_BOX, index, value);
    line("enabled", GL_SCISSOR_TEST, index, api_.IsEnabledi(GL_SCISSOR_TEST, index));
  }
  void drawBuffer(GLuint index) {
    for (const GLenum name : {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA,
                              GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA})
      indexed(name, index);
    std::array<GLboolean, 4> mask{};
    api_.GetBooleani_v(GL_COLOR_WRITEMASK, index, mask.data());
    for (const GLboolean value : mask) line("mask", GL_COLOR_WRITEMASK, index, value);
    line("enabled", GL_BLEND, index, api_.IsEnabledi(GL_BLEND, index));
  }
  void units() {
    GLint active = 0;
    api_.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint i = 0; i < kUnits; ++i) {
      api_.ActiveTexture(GL_TEXTURE0 + i);
      for (const GLenum name : {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_3D,
                                GL_TEXTURE_BINDING_BUFFER, GL_SAMPLER_BINDING})
        integers(name);
    }
    api_.ActiveTexture(static_cast<GLenum>(active));
  }

  const gl::Api& api_;
  std::vector<std::string> lines_;
};

class StateGuardTest : public testing::ContextTest {
 protected:
  StateGuardTest()
      : buffer(api, 4096, "test"),
        plane(api, {.format = GL_RGBA8, .width = 4, .height = 4}, "test"),
        array(api, {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32UI, .width = 4, .height = 4, .depth = 3}, "test"),
        volume(api, {.target = GL_TEXTURE_3D, .format = GL_R8, .width = 4, .height = 4, .depth = 4}, "test"),
        framebuffer(api),
        vertices(api) {
    api.CreateSamplers(1, &sampler);
    framebuffer.attach(GL_COLOR_ATTACHMENT0, plane);
  }
  ~StateGuardTest() override { api.DeleteSamplers(1, &sampler); }

  // Sets a state that is nowhere GL's initial one, different for each seed.
  void scramble(GLuint seed) {
    for (const GLenum name : {GL_DEPTH_TEST, GL_DEPTH_CLAMP, GL_STENCIL_TEST, GL_CULL_FACE, GL_POLYGON_OFFSET_FILL,
                              GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD, GL_COLOR_LOGIC_OP, GL_PRIMITIVE_RESTART,
                              GL_SAMPLE_ALPHA_TO_COVERAGE, GL_CLIP_DISTANCE0})
      api.Enable(name);
    api.Disable(GL_DITHER);
    api.Disable(GL_MULTISAMPLE);
    api.DepthFunc(GL_NEVER + seed % 8);
    api.DepthMask(GL_FALSE);
    api.CullFace(GL_FRONT);
    api.FrontFace(GL_CW);
    api.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    api.PolygonOffset(static_cast<float>(seed), 2.0f);
    api.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    api.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    for (GLuint i = 0; i < 16; ++i) {
      const float place = static_cast<float>(seed + i);
      api.ViewportIndexedf(i, place, 2 * place, 10 + place, 20 + place);
      api.DepthRangeIndexed(i, 0.25, 0.5);
      api.ScissorIndexed(i, 1, static_cast<GLint>(seed), 3, static_cast<GLsizei>(4 + i));
      api.Enablei(GL_SCISSOR_TEST, i);
    }
    for (GLuint i = 0; i < 8; ++i) {
      i % 2 ? api.Enablei(GL_BLEND, i) : api.Disablei(GL_BLEND, i);
      api.BlendFuncSeparatei(i, GL_SRC_COLOR + i % 4, GL_DST_COLOR, GL_ZERO, GL_SRC_COLOR + seed % 4);
      api.BlendEquationSeparatei(i, GL_MIN, GL_MAX);
      api.ColorMaski(i, GL_FALSE, i % 2 == 0, GL_FALSE, GL_TRUE);
    }
    framebuffer.bind();
    api.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.name());
    vertices.bind();
    bind(seed);
  }

  void bind(GLuint seed) {
    for (GLuint i = 0; i < kUnits; ++i) {
      for (const gl::Texture* texture : {&plane, &array, &volume})
        if ((i + seed) % 3) texture->bind(i);
      api.BindSampler(i, sampler);
    }
    api.ActiveTexture(GL_TEXTURE0 + seed % kUnits);
    for (GLuint i = 0; i < kImages; ++i)
      api.BindImageTexture(i, array.name(), 0, GL_FALSE, static_cast<GLint>((i + seed) % 3), GL_READ_WRITE, GL_R32UI);
    for (GLuint i = 0; i < kBuffers; ++i)
      if ((i + seed) % 4)
        api.BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer.name(), 256 * (i % 4), 64 * ((i + seed) % 4));
      else
        buffer.bindStorage(i);
    api.BindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
    for (GLuint i = 0; i < 2; ++i) api.BindBufferRange(GL_UNIFORM_BUFFER, i, buffer.name(), 256 * i, 16 * seed);
    for (const GLenum target : {GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER,
                                GL_PIXEL_UNPACK_BUFFER, GL_UNIFORM_BUFFER})
      api.BindBuffer(target, buffer.name());
    for (const GLenum name : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT}) api.PixelStorei(name, 1);
    for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS})
      api.PixelStorei(name, static_cast<GLint>(seed));
  }

  gl::Buffer buffer;
  gl::Texture plane, array, volume;
  gl::Framebuffer framebuffer;
  gl::EmptyVertexArray vertices;
  GLuint sampler = 0;
};

// How many lines differ.
int differences(const Snapshot& a, const Snapshot& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.lines().size(); ++i) count += a.lines()[i] != b.lines()[i];
  return count;
}

TEST_F(StateGuardTest, RestoresWhatTheCallerHadSet) {
  scramble(5);
  const Snapshot before(api);
  {
    const gl::StateGuard guard(api);
    scramble(7);
    EXPECT_GT(differences(before, Snapshot(api)), 50) << "the guarded code must have changed something";
  }
  EXPECT_EQ(before.lines(), Snapshot(api).lines());
}

TEST_F(StateGuardTest, StartsFromInitialValues) {
  const auto setKeptValues = [this] {
    for (GLuint i = 0; i < 16; ++i) {
      api.ViewportIndexedf(i, 0, 0, 4, 4);
      api.ScissorIndexed(i, 0, 0, 4, 4);
    }
  };
  setKeptValues();
  const Snapshot initial(api);
  scramble(5);
  setKeptValues();
  EXPECT_GT(differences(initial, Snapshot(api)), static_cast<int>(initial.lines().size() / 2));
  const gl::StateGuard guard(api);
  EXPECT_EQ(initial.lines(), Snapshot(api).lines());
}

TEST_F(StateGuardTest, StartsFromInitialValuesIfTheCallerKeepsNone) {
  const auto setBoxes = [this] {  // which stay as they are: each pass sets its own
    for (GLuint i = 0; i < 16; ++i) {
      api.ViewportIndexedf(i, 0, 0, 4, 4);
      api.ScissorIndexed(i, 0, 0, 4, 4);
    }
  };
  setBoxes();
  const Snapshot initial(api);
  scramble(5);
  gl::Api careless = api;
  careless.restoresState = false;
  { const gl::StateGuard guard(careless); }
  setBoxes();
  EXPECT_EQ(initial.lines(), Snapshot(api).lines());
}

TEST_F(StateGuardTest, RestoresTheInitialState) {
  const Snapshot before(api);
  {
    const gl::StateGuard guard(api);
    scramble(3);
  }
  EXPECT_EQ(before.lines(), Snapshot(api).lines());
}

TEST_F(StateGuardTest, DrawStateIsWhatItsNamesSay) {
  scramble(3);
  gl::DrawState{.viewport = {1, 2, 3, 4},
                .depthTest = true,
                .depthFunction = GL_GREATER,
                .depthWrite = true,
                .clipDepth = GL_ZERO_TO_ONE,
                .cullFaces = true,
                .culledFace = GL_FRONT,
                .frontFace = GL_CW,
                .colorWrite = false}
      .apply(api);
  const auto integer = [this](GLenum name) {
    std::array<GLint, 4> values{};
    api.GetIntegerv(name, values.data());
    return values;
  };
  EXPECT_EQ(integer(GL_VIEWPORT), (std::array<GLint, 4>{1, 2, 3, 4}));
  EXPECT_EQ(integer(GL_DEPTH_FUNC)[0], GL_GREATER);
  EXPECT_EQ(integer(GL_DEPTH_WRITEMASK)[0], GL_TRUE);
  EXPECT_EQ(integer(GL_CLIP_DEPTH_MODE)[0], GL_ZERO_TO_ONE);
  EXPECT_EQ(integer(GL_CLIP_ORIGIN)[0], GL_LOWER_LEFT);
  EXPECT_EQ(integer(GL_CULL_FACE_MODE)[0], GL_FRONT);
  EXPECT_EQ(integer(GL_FRONT_FACE)[0], GL_CW);
  EXPECT_EQ(integer(GL_COLOR_WRITEMASK), (std::array<GLint, 4>{}));
  EXPECT_EQ(integer(GL_DEPTH_RANGE), (std::array<GLint, 4>{0, std::numeric_limits<GLint>::max()}));
  for (GLuint i = 0; i < 16; ++i) EXPECT_FALSE(api.IsEnabledi(GL_SCISSOR_TEST, i)) << i;
  for (const GLenum name : {GL_DEPTH_TEST, GL_CULL_FACE}) EXPECT_TRUE(api.IsEnabled(name)) << name;
  for (const GLenum name : {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_BLEND, GL_COLOR_LOGIC_OP, GL_POLYGON_OFFSET_FILL,
                            GL_DEPTH_CLAMP, GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD})
    EXPECT_FALSE(api.IsEnabled(name)) << name;

  gl::DrawState{.viewport = {0, 0, 8, 8}}.apply(api);
  for (const GLenum name : {GL_DEPTH_TEST, GL_CULL_FACE}) EXPECT_FALSE(api.IsEnabled(name)) << name;
  EXPECT_EQ(integer(GL_DEPTH_WRITEMASK)[0], GL_FALSE);
  EXPECT_EQ(integer(GL_CLIP_DEPTH_MODE)[0], GL_NEGATIVE_ONE_TO_ONE);
  EXPECT_EQ(integer(GL_FRONT_FACE)[0], GL_CCW);
  EXPECT_EQ(integer(GL_COLOR_WRITEMASK), (std::array<GLint, 4>{1, 1, 1, 1}));
}

}  // namespace
}  // namespace halfsilver
