#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

struct Define {
  std::string name;
  std::string value = "1";
};

struct Stage {
  GLenum type;            // GL_COMPUTE_SHADER, GL_VERTEX_SHADER, ...
  std::string_view file;  // path below shaders/, for instance "passes/gbuffer.vert"
};

// A linked program made of embedded shader files. Move-only; owns its GL name.
class Program {
 public:
  Program() = default;
  // Throws Error (failed) with the first line of the compiler's message and the file it speaks of.
  Program(const Api& api, std::span<const Stage> stages, std::span<const Define> defines = {});
  static Program compute(const Api& api, std::string_view file, std::span<const Define> defines = {});
  static Program raster(const Api& api, std::string_view vertex, std::string_view fragment,
                        std::span<const Define> defines = {});
  ~Program();
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  explicit operator bool() const { return name_ != 0; }
  void use() const;
  // Unknown names are ignored: a compiler may have removed an unused uniform.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, unsigned value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const glm::vec2& value) const;
  void set(const char* uniform, const glm::vec3& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, const glm::ivec3& value) const;
  void set(const char* uniform, const glm::mat4& value) const;

 private:
  const Api* api_ = nullptr;
  GLuint name_ = 0;
};

// The text of a shader file with its #include lines resolved (each file once) and the defines after #version.
// Files are embedded in the library. Throws Error (failed) for an unknown file.
std::string assembleShader(std::string_view file, std::span<const Define> defines);

}  // namespace halfsilver::gl
