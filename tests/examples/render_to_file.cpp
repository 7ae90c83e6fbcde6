// Renders a glTF file or a built-in scene to a PNG file. Needs no window, no display and no GPU.
//
//   render_to_file scene.glb picture.png
//   render_to_file builtin:sphere picture.png
#include <halfsilver/builtin.h>
#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/gl/texture.h>
#include <halfsilver/io.h>
#include <halfsilver/renderer.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string_view>

constexpr int kWidth = 192, kHeight = 108;
constexpr std::size_t kRow = 4 * kWidth;  // bytes, RGBA

halfsilver::Model loadScene(std::string_view name) {
  constexpr std::string_view prefix = "builtin:";
  return name.starts_with(prefix) ? halfsilver::makeBuiltin(name.substr(prefix.size())) : halfsilver::loadGltf(name);
}

std::vector<std::byte> render(const halfsilver::Scene& scene) {
  const halfsilver::Context context = halfsilver::makeContext(halfsilver::ContextKind::automatic);
  // Without a window there is no framebuffer, so the frame goes to a texture.
  const halfsilver::gl::Api gl = halfsilver::gl::Api::load(context.getProcAddress());
  const halfsilver::gl::Texture texture(gl, {.width = kWidth, .height = kHeight}, "picture");
  GLuint framebuffer = 0;
  gl.CreateFramebuffers(1, &framebuffer);
  gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture.name(), 0);

  halfsilver::Renderer renderer(context.getProcAddress());
  renderer.setScene(scene);
  const halfsilver::Camera camera =
      scene.cameras.empty() ? halfsilver::frameAll(scene.bounds()) : scene.cameras.front();
  renderer.render(camera, halfsilver::Settings{}, {framebuffer, 0, 0, kWidth, kHeight});

  std::vector<std::uint8_t> pixels(kRow * kHeight);
  texture.read(GL_RGBA, GL_UNSIGNED_BYTE, pixels.size(), pixels.data());
  for (std::size_t y = 0; y < kHeight / 2; ++y)  // GL's rows run upward, those of a file downward
    std::swap_ranges(&pixels[y * kRow], &pixels[(y + 1) * kRow], &pixels[(kHeight - 1 - y) * kRow]);
  return halfsilver::encodePng(kWidth, kHeight, pixels);
}

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: render_to_file SCENE PICTURE.png\n", stderr);
    return 2;
  }
  try {
    const std::vector<std::byte> png = render(loadScene(argv[1]).scene);
    std::ofstream file(argv[2], std::ios::binary);
    file.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    return file.flush() ? 0 : 1;
  } catch (const halfsilver::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.kind());
  }
}
