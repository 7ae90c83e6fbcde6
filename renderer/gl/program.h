#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <halfsilver/gl/api.h>
#include "gl/shader_source.h"

namespace halfsilver::gl {

struct Stage {
  GLenum type;       // GL_COMPUTE_SHADER, GL_VERTEX_SHADER, ...
  std::string file;  // see assembleShader()
};

using UniformValue = std::variant<int, unsigned, float, glm::vec2, glm::vec3, glm::vec4, glm::ivec3, glm::mat4>;

// A linked program made of shader files. Move-only; owns its GL name.
class Program {
 public:
  Program() = default;
  // Throws Error (failed) with the first line of the compiler's message and the file it speaks of, and Error
  // (noContext) if the device offers a stage fewer storage blocks than the program uses there: OpenGL 4.5 guarantees 8
  // to compute and fragment shaders and none to vertex shaders.
  Program(const Api& api, std::span<const Stage> stages, std::span<const Define> defines = {});
  static Program compute(const Api& api, std::string_view file, std::span<const Define> defines = {});
  static Program raster(const Api& api, std::string_view vertex, std::string_view fragment,
                        std::span<const Define> defines = {});
  Program(Program&&) noexcept = default;
  Program& operator=(Program&&) noexcept = default;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  explicit operator bool() const { return linked_ != nullptr; }
  void use() const;
  // Unknown names are ignored: a compiler may have removed an unused uniform.
  void set(std::string_view uniform, const UniformValue& value) const;

 private:
  std::shared_ptr<LinkedProgram> linked_;  // Api::programs refers to it, too, but does not keep it
};

// Compiles all living programs again from the shader files as they are now (see HALFSILVER_SHADERS), with the uniform
// values that they have. A program whose new source has errors stays as it was. Returns the errors, a line each. Not in
// the middle of a frame: a program in use must be used again.
std::vector<std::string> reloadPrograms(const Api& api);

}  // namespace halfsilver::gl
