#pragma once

#include <span>
#include <string_view>

namespace halfsilver::gl {

struct ShaderFile {
  std::string_view path;  // below shaders/
  std::string_view text;
};

// All files below shaders/, embedded by the build (config/embed_shaders.cmake).
std::span<const ShaderFile> shaderFiles();

}  // namespace halfsilver::gl
