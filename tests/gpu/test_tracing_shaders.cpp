// The shaders of the methods, file by file.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gl/program.h"
#include "gl/shader_files.h"
#include "gpu/context_fixture.h"

namespace halfsilver::testing {
namespace {

class TracingShaders : public ContextTest {
 protected:
  bool compiles(GLenum stage, const std::string& text) const {
    const GLuint shader = api.CreateShader(stage);
    const char* source = text.c_str();
    api.ShaderSource(shader, 1, &source, nullptr);
    api.CompileShader(shader);
    GLint compiled = 0;
    api.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    api.DeleteShader(shader);
    return compiled != 0;
  }
};

// A file that includes all that it names compiles with nothing before it, so the order of includes has no say.
TEST_F(TracingShaders, IncludeWhatTheyName) {
  // What the host chooses when it makes a program.
  const std::vector<gl::Define> choices = {{"PAGE_SIZE", "4u"}, {"LINEAR_STEPS", "3"}};
  int count = 0;
  for (const gl::ShaderFile& file : gl::shaderFiles()) {
    const std::string path(file.path);
    if (!path.starts_with("tracing/") || !path.ends_with(".glsl")) continue;
    ++count;
    const std::string text = gl::assembleShader(path, choices).text + "\nvoid unused() {}\n";
    EXPECT_TRUE(compiles(GL_COMPUTE_SHADER, text) || compiles(GL_FRAGMENT_SHADER, text)) << path;
    takeErrors();  // a stage that the file is not for
  }
  EXPECT_GT(count, 20);
}

// What one method needs is in its folder, what several need in common/.
TEST_F(TracingShaders, OfAMethodIncludeNoOtherMethod) {
  int count = 0;
  for (const gl::ShaderFile& file : gl::shaderFiles()) {
    const std::string path(file.path);
    if (!path.starts_with("tracing/")) continue;
    const std::string folder = path.substr(0, path.rfind('/') + 1), include = "#include \"tracing/";
    for (std::size_t at = file.text.find(include); at != std::string::npos; at = file.text.find(include, at + 1)) {
      const std::string target(file.text.substr(at + 10, file.text.find('"', at + 10) - at - 10));
      ++count;
      EXPECT_TRUE(target.starts_with(folder) || target.starts_with("tracing/common/"))
          << path << " includes " << target;
    }
  }
  EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace halfsilver::testing
