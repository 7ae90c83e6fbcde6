#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/gl/api.h>
#include <halfsilver/gl/buffer.h>
#include <halfsilver/products.h>
#include <halfsilver/scene.h>
#include "gl/shader_source.h"

namespace halfsilver::testing {

// A file of shaders/lib with a test's main() behind it, as a compute program. The main() finds `items`, the item's
// number `item`, its input `inputs[item]` and its output `outputs[item]` (each `stride` vec4).
class ShaderFunction {
 public:
  // `body` are the statements for one item; throws std::runtime_error with the compiler's message.
  ShaderFunction(const gl::Api& api, std::string_view file, std::string_view body, int inputStride, int outputStride,
                 std::span<const gl::Define> defines = {});
  ~ShaderFunction();
  ShaderFunction(const ShaderFunction&) = delete;
  ShaderFunction& operator=(const ShaderFunction&) = delete;

  // inputStride vec4 an item in, outputStride vec4 an item out.
  std::vector<glm::vec4> run(const std::vector<glm::vec4>& inputs) const;

 private:
  const gl::Api* api_;
  GLuint program_ = 0;
  std::size_t inputStride_, outputStride_;
};

// Appends two triangles a-b-c, a-c-d (counter-clockwise from the front) with uv (0,0), (1,0), (1,1), (0,1).
void addQuad(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
             std::uint32_t material);

// A texture of one color.
std::shared_ptr<Texture> plainTexture(int width, int height, const glm::u8vec4& color, bool srgb);

// All values of level 0, `channels` a texel, row 0 at the bottom.
std::vector<float> readFloats(const gl::Texture& texture, GLenum format, std::size_t channels);
std::vector<std::uint32_t> readNumbers(const gl::Texture& texture);

}  // namespace halfsilver::testing
