// Renders into a framebuffer of an engine's, among objects that the engine draws: both test and write one depth buffer,
// so each hides the other, whichever is drawn first, and where they cross both are seen. The engine has a window, GL
// functions and state of its own; Renderer::render() leaves that state as it was. The program then checks all of this
// by reading pixels and state.
//
//   render_into_framebuffer [picture.png]
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <halfsilver/builtin.h>
#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/renderer.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <set>
#include <vector>

#include "gl_state.h"

namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr int kExitFailed = 1, kExitNoContext = 4;

// A window with a GL 4.5 core context; hidden, since the program only looks at its own framebuffer.
class Window {
 public:
  Window() {
    if (!glfwInit()) return;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    window_ = glfwCreateWindow(kWidth, kHeight, "engine", nullptr, nullptr);
    if (window_) glfwMakeContextCurrent(window_);
  }
  ~Window() { glfwTerminate(); }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  explicit operator bool() const { return window_ != nullptr; }

 private:
  GLFWwindow* window_ = nullptr;
};

// The engine's own object: a box of one hue. It is no part of the scene, so no mirror shows it.
struct Box {
  glm::vec3 center, half, hue;
};

const Box kNear{{0.72f, 1.0f, 2.2f}, {0.12f, 0.16f, 0.12f}, {1, 0, 0}};   // before the mirror sphere
const Box kThrough{{-0.8f, 1.25f, 0.5f}, {0.6f, 0.2f, 0.2f}, {0, 1, 0}};  // through its surface
const Box kBehind{{-0.1f, 1.7f, -1.7f}, {0.8f, 0.8f, 0.3f}, {0, 0, 1}};   // behind it, looking over its edge

class BoxPainter {
 public:
  BoxPainter() {
    add(GL_VERTEX_SHADER, R"(#version 450
      uniform mat4 view, projection;
      uniform vec3 center, halfSize;
      out vec3 position;
      void main() {  // a box as one triangle strip: a bit for each vertex and axis
        position = center + halfSize * (2 * vec3(uvec3(0x287a, 0x02af, 0x31e3) >> gl_VertexID & 1u) - 1);
        gl_Position = projection * view * vec4(position, 1);
      })");
    add(GL_FRAGMENT_SHADER, R"(#version 450
      uniform vec3 hue;
      in vec3 position;
      layout(location = 0) out vec4 color;
      void main() {
        vec3 normal = normalize(cross(dFdx(position), dFdy(position)));
        color = vec4(hue * (0.65 + 0.3 * dot(normal, normalize(vec3(1, 3, 2)))), 1);
      })");
    glLinkProgram(program_);
    glCreateVertexArrays(1, &vertexArray_);
  }

  // Sets what it needs of GL's state itself, as an engine does.
  void draw(std::initializer_list<Box> boxes, GLuint framebuffer, const halfsilver::CameraMatrices& matrices) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, kWidth, kHeight);
    for (const GLenum off : {GL_BLEND, GL_SCISSOR_TEST, GL_CULL_FACE}) glDisable(off);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glUseProgram(program_);
    glBindVertexArray(vertexArray_);
    glUniformMatrix4fv(location("view"), 1, GL_FALSE, &matrices.view[0][0]);
    glUniformMatrix4fv(location("projection"), 1, GL_FALSE, &matrices.projection[0][0]);
    for (const Box& box : boxes) {
      glUniform3fv(location("center"), 1, &box.center[0]);
      glUniform3fv(location("halfSize"), 1, &box.half[0]);
      glUniform3fv(location("hue"), 1, &box.hue[0]);
      glDrawArrays(GL_TRIANGLE_STRIP, 0, 14);
    }
  }

 private:
  void add(GLenum type, const char* source) const {
    const GLuint shader = glCreateShader(type);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program_, shader);
    glDeleteShader(shader);
  }
  GLint location(const char* uniform) const { return glGetUniformLocation(program_, uniform); }

  GLuint program_ = glCreateProgram(), vertexArray_ = 0;
};

GLuint makeFramebuffer() {
  GLuint color = 0, depth = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &color);
  glTextureStorage2D(color, 1, GL_RGBA8, kWidth, kHeight);
  glCreateTextures(GL_TEXTURE_2D, 1, &depth);
  glTextureStorage2D(depth, 1, GL_DEPTH_COMPONENT24, kWidth, kHeight);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
  glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
  return framebuffer;
}

void clear(GLuint framebuffer) {
  const float black[] = {0, 0, 0, 1}, far = 1;
  glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, black);
  glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
}

// State that the engine needs elsewhere and that would ruin a careless renderer's picture.
void setOtherState() {
  GLuint buffer = 0, texture = 0;
  glCreateBuffers(1, &buffer);
  glNamedBufferData(buffer, 4096, nullptr, GL_STATIC_DRAW);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  for (GLuint index = 0; index < 8; ++index) glBindBufferRange(GL_SHADER_STORAGE_BUFFER, index, buffer, 256, 512);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffer);
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_RGBA8, 4, 4);
  for (GLuint unit = 0; unit < 16; ++unit) glBindTextureUnit(unit, texture);
  glBindImageTexture(0, texture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
  glActiveTexture(GL_TEXTURE5);
  glEnable(GL_SCISSOR_TEST);
  glScissor(7, 9, 2, 3);
  glViewport(3, 5, 7, 9);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_ONE);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT_AND_BACK);
  glDepthFunc(GL_NEVER);
  glDepthMask(GL_FALSE);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 5);
}

using Pixels = std::vector<std::uint8_t>;  // RGBA, rows from the bottom

Pixels read(GLuint framebuffer) {
  Pixels pixels(4 * kWidth * kHeight);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return pixels;
}

// Pixels of exactly the box's hue, which nothing in the scene has.
int seen(const Box& box, const Pixels& pixels) {
  int count = 0;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    bool same = true;
    for (int c = 0; c < 3; ++c) same &= (pixels[i + static_cast<std::size_t>(c)] > 0) == (box.hue[c] > 0);
    count += same;
  }
  return count;
}

bool write(const char* file, Pixels pixels) {
  constexpr std::size_t kRow = 4 * kWidth;
  for (std::size_t y = 0; y < kHeight / 2; ++y)  // rows of a file run downward
    std::swap_ranges(&pixels[y * kRow], &pixels[(y + 1) * kRow], &pixels[(kHeight - 1 - y) * kRow]);
  const std::vector<std::byte> png = halfsilver::encodePng(kWidth, kHeight, pixels);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  return static_cast<bool>(out.flush());
}

bool expect(bool holds, const char* what) {
  if (!holds) std::fprintf(stderr, "not so: %s\n", what);
  return holds;
}

bool run(const char* picture) {
  const GLuint framebuffer = makeFramebuffer();
  const BoxPainter painter;
  halfsilver::Renderer renderer([](const char* name) { return glfwGetProcAddress(name); });
  const halfsilver::Scene scene = halfsilver::makeBuiltin("sphere").scene;
  renderer.setScene(scene);

  halfsilver::Camera camera = scene.cameras.front();
  camera.nearPlane = 0.1f;  // the scene's alone would do for the scene alone
  const halfsilver::Target target{framebuffer, 0, 0, kWidth, kHeight, halfsilver::DepthUse::standard};
  const halfsilver::CameraMatrices matrices = renderer.matrices(camera, target);

  std::vector<std::string> changed;
  const auto frame = [&](std::initializer_list<Box> before, std::initializer_list<Box> after) {
    clear(framebuffer);
    painter.draw(before, framebuffer, matrices);
    setOtherState();
    const std::vector<GlValue> state = glState();
    renderer.render(camera, halfsilver::Settings{}, target);
    changed = differences(state, glState());
    painter.draw(after, framebuffer, matrices);
    return read(framebuffer);
  };

  clear(framebuffer);
  painter.draw({kNear, kThrough, kBehind}, framebuffer, matrices);
  const Pixels alone = read(framebuffer);
  const Pixels others = frame({kBehind}, {kNear, kThrough});
  const Pixels pixels = frame({kNear, kThrough}, {kBehind});
  for (const std::string& name : changed) std::fprintf(stderr, "changed: %s\n", name.c_str());
  std::set<std::uint32_t> colors;
  for (std::size_t i = 0; i < pixels.size(); i += 4)
    colors.insert(pixels[i] | static_cast<std::uint32_t>(pixels[i + 1]) << 8 |
                  static_cast<std::uint32_t>(pixels[i + 2]) << 16);
  const auto partly = [&](const Box& box) { return seen(box, pixels) > 0 && seen(box, pixels) < seen(box, alone); };

  bool good = expect(changed.empty(), "render() leaves the state as it was");
  good &= expect(colors.size() > 1000, "the scene is in the framebuffer");
  good &= expect(seen(kNear, alone) > 0 && seen(kNear, pixels) == seen(kNear, alone), "the near box hides the scene");
  good &= expect(partly(kBehind), "the scene hides a part of the box behind it");
  good &= expect(partly(kThrough), "the box through the sphere is seen outside it alone");
  good &= expect(pixels == others, "it is the same picture whoever draws first");
  good &= expect(glGetError() == GL_NO_ERROR, "there is no GL error");
  return (!picture || expect(write(picture, pixels), "the picture is written")) && good;
}

}  // namespace

int main(int argc, char** argv) {
  const Window window;
  if (!window) {
    const char* why = "";
    glfwGetError(&why);
    std::fprintf(stderr, "no window with OpenGL 4.5: %s\n", why);
    return kExitNoContext;
  }
  try {
    return run(argc > 1 ? argv[1] : nullptr) ? 0 : kExitFailed;
  } catch (const halfsilver::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.kind());
  }
}
