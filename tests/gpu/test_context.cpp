#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/gl/api.h>
#include <halfsilver/gl/texture.h>
#include "gl/framebuffer.h"

namespace halfsilver {
namespace {

constexpr int kSize = 64;

GLuint compileProgram(const gl::Api& api, const char* vertexText, const char* fragmentText) {
  const GLuint program = api.CreateProgram();
  for (const auto& [type, text] : {std::pair{GL_VERTEX_SHADER, vertexText}, {GL_FRAGMENT_SHADER, fragmentText}}) {
    const GLuint shader = api.CreateShader(static_cast<GLenum>(type));
    api.ShaderSource(shader, 1, &text, nullptr);
    api.CompileShader(shader);
    api.AttachShader(program, shader);
    api.DeleteShader(shader);
  }
  api.LinkProgram(program);
  GLint linked = 0;
  api.GetProgramiv(program, GL_LINK_STATUS, &linked);
  EXPECT_TRUE(linked);
  return program;
}

// A triangle with a gradient and a curve in it, over a cleared background, as bytes.
std::vector<std::uint8_t> draw(const Context& context) {
  const gl::Api api = gl::Api::load(context.getProcAddress());
  const char* vertexText =
      "#version 450 core\n"
      "out vec2 place;\n"
      "void main() {\n"
      "  place = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
      "  gl_Position = vec4(place * 1.6 - 0.8, 0.0, 1.0);\n"
      "}\n";
  const char* fragmentText =
      "#version 450 core\n"
      "in vec2 place;\n"
      "out vec4 color;\n"
      "void main() { color = vec4(place, 0.5 + 0.5 * sin(20.0 * place.x * place.y), 1.0); }\n";
  const GLuint program = compileProgram(api, vertexText, fragmentText);
  const gl::Texture texture(api, {.format = GL_RGBA8, .width = kSize, .height = kSize}, "picture");
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, texture);
  const gl::EmptyVertexArray vertices(api);
  framebuffer.bind();
  vertices.bind();
  api.UseProgram(program);
  api.Viewport(0, 0, kSize, kSize);
  const std::array<float, 4> background{0.25f, 0.5f, 0.75f, 1.0f};
  api.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, background.data());
  api.DrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<std::uint8_t> pixels(kSize * kSize * 4);
  texture.read(GL_RGBA, GL_UNSIGNED_BYTE, pixels.size(), pixels.data());
  EXPECT_EQ(api.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  api.DeleteProgram(program);
  return pixels;
}

std::array<int, 4> pixel(const std::vector<std::uint8_t>& pixels, int x, int y) {
  const std::uint8_t* p = &pixels[static_cast<std::size_t>((y * kSize + x) * 4)];
  return {p[0], p[1], p[2], p[3]};
}

// The picture above, at places where its color is known.
void expectPicture(const std::vector<std::uint8_t>& pixels) {
  EXPECT_EQ(pixel(pixels, 0, 0), (std::array{64, 128, 191, 255}));
  EXPECT_EQ(pixel(pixels, kSize - 2, kSize - 2), (std::array{64, 128, 191, 255}));
  // The pixel's center, back through the vertex shader's map from place to the viewport.
  const auto place = [](int n) { return ((n + 0.5) / kSize * 2 - 1 + 0.8) / 1.6; };
  EXPECT_NEAR(pixel(pixels, 20, 12)[0], 255 * place(20), 1);
  EXPECT_NEAR(pixel(pixels, 20, 12)[1], 255 * place(12), 1);
}

// Why there can be no OSMesa: Mesa has none from 25.1 on. Empty if its library is there.
std::string osmesaLacks() {
  try {
    makeContext(ContextKind::osmesa);
  } catch (const Error& error) {
    const std::string what = error.what();
    if (what.find("cannot be loaded") != std::string::npos) return what;
  }
  return {};
}

class Contexts : public ::testing::TestWithParam<ContextKind> {
 protected:
  void SetUp() override {
    const std::string lacks = GetParam() == ContextKind::osmesa ? osmesaLacks() : std::string();
    if (!lacks.empty()) GTEST_SKIP() << lacks;
  }
};

TEST_P(Contexts, DrawsWithoutADisplay) {
  const Context context = makeContext(GetParam());
  EXPECT_STREQ(context.name(), GetParam() == ContextKind::egl ? "egl" : "osmesa");
  expectPicture(draw(context));
}

TEST_P(Contexts, SurvivesBeingMoved) {
  Context first = makeContext(GetParam());
  const auto getProcAddress = first.getProcAddress();
  const Context second = std::move(first);
  EXPECT_NE(getProcAddress("glDrawArrays"), nullptr);
  expectPicture(draw(second));
}

TEST_P(Contexts, CanBeMadeAgain) {
  for (int i = 0; i < 3; ++i) expectPicture(draw(makeContext(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Contexts, ::testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return kind.param == ContextKind::egl ? "egl" : "osmesa"; });

TEST(Context, EglComesFirst) { EXPECT_STREQ(makeContext(ContextKind::automatic).name(), "egl"); }

TEST(Context, EglAndOsmesaTakeTurns) {
  if (const std::string lacks = osmesaLacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  Context egl = makeContext(ContextKind::egl);
  const std::vector<std::uint8_t> eglPicture = draw(egl);
  const gl::Api eglApi = gl::Api::load(egl.getProcAddress());
  egl.release();

  Context osmesa = makeContext(ContextKind::osmesa);
  const std::vector<std::uint8_t> osmesaPicture = draw(osmesa);
  const gl::Api osmesaApi = gl::Api::load(osmesa.getProcAddress());
  osmesa.release();

  expectPicture(eglPicture);
  if (eglApi.version == osmesaApi.version && eglApi.renderer == osmesaApi.renderer) {
    EXPECT_EQ(eglPicture, osmesaPicture) << "the same Mesa draws the same picture";
  }

  egl.makeCurrent();
  EXPECT_EQ(draw(egl), eglPicture);
  egl.release();
  osmesa.makeCurrent();
  EXPECT_EQ(draw(osmesa), osmesaPicture);
}

std::string failure(ContextKind kind, const ContextOptions& options) {
  try {
    makeContext(kind, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::noContext);
    return error.what();
  }
  return "made a context";
}

TEST(Context, NamesTheMissingLibrary) {
  const ContextOptions options{.debug = false, .eglLibrary = "libEGL-absent.so.1", .osmesaLibrary = "libOSMesa-absent"};
  EXPECT_EQ(failure(ContextKind::egl, options),
            "no OpenGL 4.5 core context: EGL: the library libEGL-absent.so.1 cannot be loaded");
  EXPECT_EQ(failure(ContextKind::osmesa, options),
            "no OpenGL 4.5 core context: OSMesa: the library libOSMesa-absent cannot be loaded");
  EXPECT_EQ(failure(ContextKind::automatic, options),
            "no OpenGL 4.5 core context: EGL: the library libEGL-absent.so.1 cannot be loaded; OSMesa: the library "
            "libOSMesa-absent cannot be loaded");
}

TEST(Context, NamesTheMissingFunction) {
  EXPECT_EQ(failure(ContextKind::egl, {.debug = false, .eglLibrary = "libm.so.6", .osmesaLibrary = {}}),
            "no OpenGL 4.5 core context: EGL: the library has no function eglBindAPI");
}

TEST(Context, FallsBackToOsmesa) {
  if (const std::string lacks = osmesaLacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  const Context context =
      makeContext(ContextKind::automatic, {.debug = false, .eglLibrary = "libEGL-absent.so.1", .osmesaLibrary = {}});
  EXPECT_STREQ(context.name(), "osmesa");
  expectPicture(draw(context));
}

TEST(Api, NamesTheMissingFunction) {
  const Context context = makeContext(ContextKind::automatic);
  const auto getProcAddress = context.getProcAddress();
  const auto withoutDispatch = [&](const char* name) -> gl::Proc {
    return std::string(name) == "glDispatchCompute" ? nullptr : getProcAddress(name);
  };
  try {
    gl::Api::load(withoutDispatch);
    FAIL() << "a function is missing";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::noContext);
    EXPECT_NE(std::string(error.what()).find("glDispatchCompute"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace halfsilver
