// The bytes of a .gltf or .glb, whose other files are absent: a model whose indices are valid, or one line.
#include <cmath>
#include <span>

#include <halfsilver/pose.h>
#include "expect.h"
#include "io/gltf_load.h"

namespace halfsilver::fuzz {
namespace {

void expectConsistent(const Model& model) {
  const Scene& scene = model.scene;
  expect(!scene.triangles.empty() && !scene.cameras.empty(), "nothing to draw");
  for (const Triangle& triangle : scene.triangles) {
    expect(triangle.material < scene.materials.size(), "a material that is not there");
    for (const std::uint32_t index : triangle.vertices) expect(index < scene.vertices.size(), "a vertex out of range");
  }
  for (const Vertex& vertex : scene.vertices)
    for (int c = 0; c < 3; ++c) expect(std::isfinite(vertex.position[c]), "a position that is not finite");
  for (const auto& texture : scene.textures)
    expect(texture->texels.size() ==
               std::size_t{4} * static_cast<std::size_t>(texture->width) * static_cast<std::size_t>(texture->height),
           "a texture of another size than it says");
}

// Poses the first animations; one of valid numbers may still leave the range of floats.
void play(Model& model) {
  constexpr int kMost = 4;
  for (int a = 0; a < std::min(kMost, static_cast<int>(model.rig.animations.size())); ++a) try {
      const Playing playing{a, 0.4};
      pose(model, std::span(&playing, 1));
    } catch (const Error& error) {
      expect(error.kind() == ErrorKind::badInput, error.what());
    }
}

}  // namespace
}  // namespace halfsilver::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfsilver;
  const std::string file = "/nonexistent/scene.glb";
  try {
    Model model = gltf::loadBytes({data, size}, file, {});
    fuzz::expectConsistent(model);
    fuzz::play(model);
  } catch (const Error& error) {
    fuzz::expectRefusal(error, file);
  }
  return 0;
}
