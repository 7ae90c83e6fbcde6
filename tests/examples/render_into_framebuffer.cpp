// Renders into one rectangle of a framebuffer that an engine owns, beside what the engine draws itself. The engine has
// its own GL functions and state; Renderer::render() draws inside the rectangle and puts the state back, so the engine
// goes on as if nothing had happened. The program then checks that by reading pixels and state.
#include <GL/glcorearb.h>
#include <halfsilver/builtin.h>
#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/renderer.h>

#include <array>
#include <cstdio>
#include <set>
#include <vector>

namespace {

constexpr int kWidth = 240, kHeight = 108;
constexpr int kSceneWidth = 192;  // the scene on the left, the engine's panel to the right of it

// The engine's own way to GL; any loader will do.
struct EngineGl {
  explicit EngineGl(const halfsilver::Context& context) {
    const auto load = [getProcAddress = context.getProcAddress()](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(getProcAddress(name));
    };
    load(genFramebuffers, "glGenFramebuffers");
    load(bindFramebuffer, "glBindFramebuffer");
    load(framebufferTexture, "glFramebufferTexture");
    load(genTextures, "glGenTextures");
    load(bindTexture, "glBindTexture");
    load(texStorage, "glTexStorage2D");
    load(enable, "glEnable");
    load(isEnabled, "glIsEnabled");
    load(viewport, "glViewport");
    load(scissor, "glScissor");
    load(clearColor, "glClearColor");
    load(clear, "glClear");
    load(getIntegers, "glGetIntegerv");
    load(readPixels, "glReadPixels");
  }

  PFNGLGENFRAMEBUFFERSPROC genFramebuffers;
  PFNGLBINDFRAMEBUFFERPROC bindFramebuffer;
  PFNGLFRAMEBUFFERTEXTUREPROC framebufferTexture;
  PFNGLGENTEXTURESPROC genTextures;
  PFNGLBINDTEXTUREPROC bindTexture;
  PFNGLTEXSTORAGE2DPROC texStorage;
  PFNGLENABLEPROC enable;
  PFNGLISENABLEDPROC isEnabled;
  PFNGLVIEWPORTPROC viewport;
  PFNGLSCISSORPROC scissor;
  PFNGLCLEARCOLORPROC clearColor;
  PFNGLCLEARPROC clear;
  PFNGLGETINTEGERVPROC getIntegers;
  PFNGLREADPIXELSPROC readPixels;
};

// Leaves the new framebuffer bound.
GLuint makeFramebuffer(const EngineGl& gl) {
  GLuint color = 0, framebuffer = 0;
  gl.genTextures(1, &color);
  gl.bindTexture(GL_TEXTURE_2D, color);
  gl.texStorage(GL_TEXTURE_2D, 1, GL_RGBA8, kWidth, kHeight);
  gl.genFramebuffers(1, &framebuffer);
  gl.bindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.framebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, color, 0);
  return framebuffer;
}

void clearPanel(const EngineGl& gl, int y, int height) {
  gl.scissor(kSceneWidth, y, kWidth - kSceneWidth, height);
  gl.clear(GL_COLOR_BUFFER_BIT);
}

std::vector<GLint> state(const EngineGl& gl) {
  std::vector<GLint> values{gl.isEnabled(GL_SCISSOR_TEST), gl.isEnabled(GL_BLEND)};
  for (const GLenum name : {GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_TEXTURE_BINDING_2D,
                            GL_CURRENT_PROGRAM, GL_VIEWPORT, GL_SCISSOR_BOX}) {
    std::array<GLint, 4> value{};
    gl.getIntegers(name, value.data());
    values.insert(values.end(), value.begin(), value.end());
  }
  return values;
}

std::vector<std::uint32_t> colors(const EngineGl& gl, int x, int width) {
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * kHeight);
  gl.readPixels(x, 0, width, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return pixels;
}

bool expect(bool holds, const char* what) {
  if (!holds) std::fprintf(stderr, "not so: %s\n", what);
  return holds;
}

bool run() {
  const halfsilver::Context context = halfsilver::makeContext(halfsilver::ContextKind::automatic);  // a window's, say
  const EngineGl gl(context);
  halfsilver::Renderer renderer(context.getProcAddress());
  const halfsilver::Scene scene = halfsilver::makeBuiltin("sphere").scene;
  renderer.setScene(scene);

  // The engine's frame begins: half of its panel in orange, with state that would ruin a careless renderer's picture.
  const GLuint framebuffer = makeFramebuffer(gl);
  gl.viewport(3, 5, 7, 9);
  gl.enable(GL_SCISSOR_TEST);
  gl.enable(GL_BLEND);
  gl.clearColor(1, 0.6f, 0, 1);
  clearPanel(gl, 0, kHeight / 2);

  const std::vector<GLint> before = state(gl);
  renderer.render(scene.cameras.front(), halfsilver::Settings{}, {framebuffer, 0, 0, kSceneWidth, kHeight});
  const std::vector<GLint> after = state(gl);

  // It goes on with the other half, with the framebuffer, the color and the scissor test that it had set.
  clearPanel(gl, kHeight / 2, kHeight - kHeight / 2);

  const std::vector<std::uint32_t> picture = colors(gl, 0, kSceneWidth);
  const std::vector<std::uint32_t> panel = colors(gl, kSceneWidth, kWidth - kSceneWidth);
  const std::set<std::uint32_t> inPicture(picture.begin(), picture.end()), inPanel(panel.begin(), panel.end());
  bool good = expect(before == after, "render() leaves the state as it was");
  good &= expect(inPicture.size() > 1000, "the scene is in its rectangle");
  good &= expect(inPanel == std::set<std::uint32_t>{0xff0099ff}, "the panel has the engine's color alone");
  return good;
}

}  // namespace

int main() {
  try {
    return run() ? 0 : 1;
  } catch (const halfsilver::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.kind());
  }
}
