#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/gl/buffer.h>
#include "gl/program.h"
#include "gl/shader_files.h"
#include "gpu/context_fixture.h"
#include "temporary_folder.h"

namespace halfsilver {
namespace {

constexpr GLuint kOutput = 3;

// A folder of shaders that HALFSILVER_SHADERS names while the test runs.
class Programs : public testing::ContextTest {
 protected:
  Programs() {
    ::setenv("HALFSILVER_SHADERS", folder_.path().c_str(), 1);
    write("value.glsl", "const uint VALUE = 1u;\n");
    write("fill.comp",
          "#include \"value.glsl\"\n"
          "layout(local_size_x = 1) in;\n"
          "layout(std430, binding = 3) buffer OutputBlock { uint result; };\n"
          "uniform uint added;\n"
          "void main() { result = VALUE + added; }\n");
  }
  ~Programs() override { ::unsetenv("HALFSILVER_SHADERS"); }

  void write(const std::string& file, const std::string& text) const { std::ofstream(folder_ / file) << text; }

  // A compute shader that adds up `count` storage blocks.
  void writeSum(const std::string& file, int count) const {
    std::string blocks, sum;
    for (int i = 0; i < count; ++i) {
      const std::string n = std::to_string(i);
      blocks += "layout(std430, binding = " + n + ") buffer Block" + n + " { uint value" + n + "; };\n";
      sum += " + value" + n;
    }
    write(file, "layout(local_size_x = 1) in;\n" + blocks + "void main() { value0 = 0u" + sum + "; }\n");
  }

  std::uint32_t run(const gl::Program& program) const {
    const gl::Buffer output(api, sizeof(std::uint32_t), "output");
    output.bindStorage(kOutput);
    program.use();
    api.DispatchCompute(1, 1, 1);
    api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // the output (shader) is read by the host
    return output.read<std::uint32_t>(1)[0];
  }

  std::string failure(const gl::Api& table, const std::string& file, ErrorKind kind) const {
    try {
      gl::Program::compute(table, file);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind);
      return error.what();
    }
    return "did not fail";
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Programs, ComeFromTheFolderInTheEnvironment) {
  const gl::Program program = gl::Program::compute(api, "fill.comp");
  EXPECT_EQ(run(program), 1u);
}

TEST_F(Programs, NameTheFileThatTheFolderLacks) {
  const std::string message = failure(api, "passes/absent.comp", ErrorKind::failed);
  EXPECT_NE(message.find("passes/absent.comp (HALFSILVER_SHADERS)"), std::string::npos) << message;
  write("lonely.comp", "#include \"gone.glsl\"\n");
  const std::string included = failure(api, "lonely.comp", ErrorKind::failed);
  EXPECT_NE(included.find("gone.glsl"), std::string::npos) << included;
}

TEST_F(Programs, TheEmbeddedFilesAreThoseOfTheFolder) {
  ::setenv("HALFSILVER_SHADERS", HALFSILVER_SOURCE_DIR "/shaders", 1);
  std::vector<std::string> fromFolder;
  for (const gl::ShaderFile& file : gl::shaderFiles()) fromFolder.push_back(gl::assembleShader(file.path, {}).text);
  ::unsetenv("HALFSILVER_SHADERS");
  ASSERT_GT(fromFolder.size(), 20u);
  for (std::size_t i = 0; i < fromFolder.size(); ++i)
    EXPECT_EQ(gl::assembleShader(gl::shaderFiles()[i].path, {}).text, fromFolder[i]) << gl::shaderFiles()[i].path;
}

TEST_F(Programs, ReloadingTakesTheNewSource) {
  const gl::Program program = gl::Program::compute(api, "fill.comp");
  program.set("added", 40u);
  EXPECT_EQ(run(program), 41u);
  write("value.glsl", "const uint VALUE = 2u;\n");
  EXPECT_EQ(run(program), 41u) << "only a reload reads files again";
  EXPECT_TRUE(gl::reloadPrograms(api).empty());
  EXPECT_EQ(run(program), 42u) << "uniforms keep their values";
  program.set("added", 0u);
  EXPECT_EQ(run(program), 2u);
}

TEST_F(Programs, ReloadingKeepsProgramsWhoseSourceHasErrors) {
  const gl::Program program = gl::Program::compute(api, "fill.comp"), twin = gl::Program::compute(api, "fill.comp");
  write("other.comp",
        "layout(local_size_x = 1) in;\nlayout(std430, binding = 3) buffer B { uint b; };\n"
        "void main() { b = 7u; }\n");
  const gl::Program other = gl::Program::compute(api, "other.comp");
  program.set("added", 9u);
  write("value.glsl", "const uint VALUE = ;\n");
  write("other.comp",
        "layout(local_size_x = 1) in;\nlayout(std430, binding = 3) buffer B { uint b; };\n"
        "void main() { b = 8u; }\n");
  const std::vector<std::string> errors = gl::reloadPrograms(api);
  ASSERT_EQ(errors.size(), 1u) << "the twins share one error";
  EXPECT_EQ(errors[0].rfind("shader fill.comp does not compile: in value.glsl: ", 0), 0u) << errors[0];
  EXPECT_EQ(run(program), 10u);
  EXPECT_EQ(run(twin), 1u);
  EXPECT_EQ(run(other), 8u) << "one program's errors are not another's";
  takeErrors();
  write("value.glsl", "const uint VALUE = 3u;\n");
  EXPECT_TRUE(gl::reloadPrograms(api).empty());
  EXPECT_EQ(run(program), 12u);
}

TEST_F(Programs, ReloadingFollowsMovesAndForgetsTheDead) {
  std::optional<gl::Program> gone(gl::Program::compute(api, "fill.comp"));
  gl::Program first = gl::Program::compute(api, "fill.comp");
  const gl::Program second = std::move(first);
  EXPECT_FALSE(first);
  gone.reset();
  write("value.glsl", "const uint VALUE = 5u;\n");
  EXPECT_TRUE(gl::reloadPrograms(api).empty());
  EXPECT_EQ(run(second), 5u);
}

TEST_F(Programs, MoreStorageBlocksThanTheDeviceOffersIsNamed) {
  writeSum("sum.comp", 5);
  gl::Api poor = api;
  poor.limits.computeStorageBlocks = 5;
  EXPECT_TRUE(gl::Program::compute(poor, "sum.comp"));
  poor.limits.computeStorageBlocks = 4;
  EXPECT_EQ(failure(poor, "sum.comp", ErrorKind::noContext),
            "the GL device offers 4 storage blocks in compute shaders, program sum.comp needs 5");
}

TEST_F(Programs, StorageBlocksAreCountedPerStage) {
  write("pull.vert",
        "layout(std430, binding = 0) readonly buffer A { vec4 a[]; };\n"
        "layout(std430, binding = 1) buffer B { vec4 b[]; };\n"
        "void main() { gl_Position = a[gl_VertexID] + b[gl_VertexID]; }\n");
  write("mark.frag",
        "layout(std430, binding = 1) buffer B { vec4 b[]; };\n"
        "void main() { b[0] = vec4(1); }\n");
  gl::Api poor = api;
  poor.limits.vertexStorageBlocks = 2;
  poor.limits.fragmentStorageBlocks = 1;
  EXPECT_TRUE(gl::Program::raster(poor, "pull.vert", "mark.frag"));
  const auto failureWith = [&](GLint vertexBlocks, GLint fragmentBlocks) -> std::string {
    poor.limits.vertexStorageBlocks = vertexBlocks;
    poor.limits.fragmentStorageBlocks = fragmentBlocks;
    try {
      gl::Program::raster(poor, "pull.vert", "mark.frag");
    } catch (const Error& error) {
      return error.what();
    }
    return "did not fail";
  };
  EXPECT_EQ(failureWith(0, 8), "the GL device offers 0 storage blocks in vertex shaders, program mark.frag needs 2");
  EXPECT_EQ(failureWith(2, 0), "the GL device offers 0 storage blocks in fragment shaders, program mark.frag needs 1");
}

TEST_F(Programs, ALimitThatTheDriverEnforcesIsNamed) {
  const GLint offered = api.limits.computeStorageBlocks;
  writeSum("sum.comp", offered + 1);
  const std::string message = failure(api, "sum.comp", ErrorKind::noContext);
  EXPECT_EQ(message.rfind("the GL device offers " + std::to_string(offered) +
                              " storage blocks in compute shaders, program sum.comp needs more: ",
                          0),
            0u)
      << message;
  takeErrors();
}

}  // namespace
}  // namespace halfsilver
