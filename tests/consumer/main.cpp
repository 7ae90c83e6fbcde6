// Draws one triangle with the installed library and checks that it is there. Exits with 77 if there is no context.
#include <GL/glcorearb.h>
#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/renderer.h>

#include <cstdio>
#include <glm/glm.hpp>

namespace {

constexpr int kWidth = 64, kHeight = 48;

// A red triangle without light in front of a blue sky.
halfsilver::Scene makeScene() {
  halfsilver::Scene scene;
  for (const glm::vec3& position : {glm::vec3(-1, -1, 0), glm::vec3(1, -1, 0), glm::vec3(0, 1, 0)}) {
    halfsilver::Vertex vertex;
    vertex.position = position;
    vertex.normal = {0, 0, 1};
    scene.vertices.push_back(vertex);
  }
  scene.triangles.push_back({{0, 1, 2}, 0});
  halfsilver::Material red;
  red.baseColor = {1, 0, 0, 1};
  red.unlit = true;
  scene.materials.push_back(red);
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = {0, 0, 1};
  return scene;
}

// Any framebuffer object will do; without a window the caller makes one, with GL functions of its own.
GLuint makeFramebuffer(const halfsilver::Context& context) {
  const auto getProcAddress = context.getProcAddress();
  const auto createTextures = reinterpret_cast<PFNGLCREATETEXTURESPROC>(getProcAddress("glCreateTextures"));
  const auto textureStorage = reinterpret_cast<PFNGLTEXTURESTORAGE2DPROC>(getProcAddress("glTextureStorage2D"));
  const auto createFramebuffers = reinterpret_cast<PFNGLCREATEFRAMEBUFFERSPROC>(getProcAddress("glCreateFramebuffers"));
  const auto attach = reinterpret_cast<PFNGLNAMEDFRAMEBUFFERTEXTUREPROC>(getProcAddress("glNamedFramebufferTexture"));
  GLuint color = 0, framebuffer = 0;
  createTextures(GL_TEXTURE_2D, 1, &color);
  textureStorage(color, 1, GL_RGBA8, kWidth, kHeight);
  createFramebuffers(1, &framebuffer);
  attach(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
  return framebuffer;
}

glm::vec3 pixel(const halfsilver::Image& image, int x, int y) {
  const auto value = [&](const char* name) {
    const int index = (y * image.width + x) * image.channelCount() + image.channel(name);
    return image.data[static_cast<std::size_t>(index)];
  };
  return {value("R"), value("G"), value("B")};
}

bool near(const glm::vec3& color, const glm::vec3& expected) { return glm::length(color - expected) < 0.02f; }

int run() {
  const halfsilver::Context context = halfsilver::makeContext(halfsilver::ContextKind::automatic);
  halfsilver::Renderer renderer(context.getProcAddress());
  const halfsilver::Scene scene = makeScene();
  renderer.setScene(scene);

  halfsilver::Camera camera;
  camera.eye = {0, 0, 4};
  halfsilver::Settings settings;
  halfsilver::set(settings, "trace.method", "identity");

  renderer.render(camera, settings, {makeFramebuffer(context), 0, 0, kWidth, kHeight});

  const halfsilver::FrameReport report = renderer.report();
  const halfsilver::Image layers = renderer.readLayers();
  const glm::vec3 center = pixel(layers, kWidth / 2, kHeight / 2), corner = pixel(layers, 1, 1);
  std::printf("%s: %d pixels, triangle %.2f %.2f %.2f, sky %.2f %.2f %.2f\n", renderer.device().renderer.c_str(),
              static_cast<int>(report.pixels), center.x, center.y, center.z, corner.x, corner.y, corner.z);
  return near(center, {1, 0, 0}) && near(corner, {0, 0, 1}) ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const halfsilver::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.kind() == halfsilver::ErrorKind::noContext ? 77 : 1;
  }
}
