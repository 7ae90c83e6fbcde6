#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace halfsilver::gl {

struct Define {
  std::string name;
  std::string value = "1";
};

struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  // what the text is made of; a place in it is a source string number in #line

  // The first line of a compiler's message about the text, with the file that it speaks of.
  std::string explain(const std::string& log) const;
};

// The text of a shader file (path below shaders/, for instance "passes/gbuffer.vert") with its #include lines resolved,
// each file once, and the defines after #version. Files are embedded in the library; if the environment names a folder
// in HALFSILVER_SHADERS, all are read from there instead. Throws Error (failed) for a file that is not there.
ShaderSource assembleShader(std::string_view file, std::span<const Define> defines);

}  // namespace halfsilver::gl
