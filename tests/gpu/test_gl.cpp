#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/gl/buffer.h>
#include <halfsilver/gl/profiler.h>
#include <halfsilver/gl/texture.h>
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/shader_files.h"
#include "gpu/context_fixture.h"

namespace halfsilver {
namespace {

class Gl : public testing::ContextTest {};

template <class Action>
std::string failure(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::failed);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    return error.what();
  }
  return "did not fail";
}

TEST_F(Gl, DebugLogCollectsErrors) {
  api.Enable(GL_TEXTURE_2D_ARRAY);  // no capability
  const std::vector<std::string> errors = takeErrors();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_FALSE(errors[0].empty());
  EXPECT_TRUE(takeErrors().empty());
}

TEST_F(Gl, BufferKeepsWhatIsWritten) {
  gl::Buffer buffer(api, 16, "test");
  buffer.fill(7);
  const std::array<std::uint32_t, 2> values{1, 2};
  buffer.write(std::span<const std::uint32_t>(values), 1);
  EXPECT_EQ(buffer.read<std::uint32_t>(4), (std::vector<std::uint32_t>{7, 1, 2, 7}));
  buffer.fill(9, 12, 4);
  EXPECT_EQ(buffer.read<std::uint32_t>(2, 2), (std::vector<std::uint32_t>{2, 9}));
}

TEST_F(Gl, BufferMoves) {
  gl::Buffer first(api, 4, "test");
  first.fill(5);
  const GLuint name = first.name();
  gl::Buffer second = std::move(first);
  EXPECT_FALSE(first);
  EXPECT_EQ(second.name(), name);
  EXPECT_EQ(second.read<std::uint32_t>(1)[0], 5u);
}

TEST_F(Gl, EmptyBufferOwnsNothing) {
  const gl::Buffer buffer(api, 0, "test");
  EXPECT_FALSE(buffer);
  EXPECT_TRUE(buffer.read<float>(0).empty());
}

TEST_F(Gl, TooLargeBufferIsAnError) {
  const std::size_t tooMuch = static_cast<std::size_t>(api.limits.storageBlockBytes) + 1;
  const std::string message = failure([&] { gl::Buffer(api, tooMuch, "voxels"); });
  EXPECT_EQ(message.rfind("the voxels buffer needs " + std::to_string(tooMuch >> 20) + " MiB", 0), 0u) << message;
}

TEST_F(Gl, TooLargeTextureIsAnError) {
  const int side = api.limits.textureSize + 1;
  const std::string message =
      failure([&] { gl::Texture(api, {.format = GL_RGBA8, .width = side, .height = 1}, "normals"); });
  EXPECT_EQ(message.rfind("the normals texture of " + std::to_string(side) + " x 1", 0), 0u) << message;
  EXPECT_FALSE(takeErrors().empty());
}

TEST_F(Gl, TextureCountsItsBytes) {
  EXPECT_EQ(gl::Texture(api, {.format = GL_RGBA32F, .width = 5, .height = 3}, "test").bytes(), 5u * 3 * 16);
  const gl::Texture levels(api, {.format = GL_RGBA8, .width = 4, .height = 2, .levels = 3}, "test");
  EXPECT_EQ(levels.bytes(), (8u + 2 + 1) * 4);
  const gl::Texture layers(
      api, {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32UI, .width = 2, .height = 2, .depth = 3}, "test");
  EXPECT_EQ(layers.bytes(), 4u * 3 * 4);
}

TEST_F(Gl, TextureKeepsWhatIsCleared) {
  const gl::Texture texture(api, {.format = GL_RGBA32F, .width = 3, .height = 2}, "test");
  const std::array<float, 4> color{0.1f, -2, 3e9f, 1};
  api.ClearTexImage(texture.name(), 0, GL_RGBA, GL_FLOAT, color.data());
  std::array<float, 24> texels{};
  texture.read(GL_RGBA, GL_FLOAT, sizeof(texels), texels.data());
  for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_EQ(texels[i], color[i % 4]);
}

TEST_F(Gl, UnknownShaderFileIsNamed) {
  EXPECT_EQ(failure([&] { gl::Program::compute(api, "passes/absent.comp"); }),
            "no embedded shader file passes/absent.comp");
}

// The number of the first line of an embedded file that starts with `text`.
std::string lineOf(std::string_view file, std::string_view text) {
  for (const gl::ShaderFile& candidate : gl::shaderFiles()) {
    if (candidate.path != file) continue;
    const auto line = candidate.text.begin() + static_cast<std::ptrdiff_t>(candidate.text.find(text));
    return std::to_string(1 + std::count(candidate.text.begin(), line, '\n'));
  }
  return "no such file";
}

TEST_F(Gl, CompileErrorNamesTheFileAndTheLine) {
  // The definition breaks the first line that uses the type.
  const gl::Define broken[] = {{"uint", "broken"}};
  const std::string line = lineOf("shared/structs.h", "  uint ");
  const std::string message = failure([&] { gl::Program::compute(api, "shared/structs.h", broken); });
  EXPECT_EQ(message.rfind("shader shared/structs.h does not compile: ", 0), 0u) << message;
  EXPECT_NE(message.find(line), std::string::npos) << "line " << line << ": " << message;
  takeErrors();
}

TEST_F(Gl, CompileErrorNamesTheIncludedFile) {
  const gl::Define broken[] = {{"uint", "broken"}};
  const std::string line = lineOf("shared/structs.h", "  uint ");
  const std::string message = failure([&] { gl::Program::compute(api, "lib/frame.glsl", broken); });
  EXPECT_EQ(message.rfind("shader lib/frame.glsl does not compile: in shared/structs.h: ", 0), 0u) << message;
  EXPECT_NE(message.find(line), std::string::npos) << "line " << line << ": " << message;
  takeErrors();
}

TEST_F(Gl, ProgramWithoutMainDoesNotLink) {
  const std::string message = failure([&] { gl::Program::compute(api, "shared/structs.h"); });
  EXPECT_EQ(message.rfind("program shared/structs.h does not link: ", 0), 0u) << message;
  takeErrors();
}

TEST_F(Gl, ProfilerTimesNamedSections) {
  gl::Profiler profiler(api);
  const gl::Buffer buffer(api, 1 << 20, "test");
  for (int i = 0; i < 2; ++i) {
    const auto outer = profiler.section("outer");
    const auto inner = profiler.section("inner");
    gl::Buffer(api, 1 << 16, "scratch").fill(1);
  }
  const std::vector<gl::SectionTime> times = profiler.collect();
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].name, "outer");
  EXPECT_EQ(times[1].name, "inner");
  EXPECT_GT(times[1].milliseconds, 0);
  EXPECT_GE(times[0].milliseconds, times[1].milliseconds);
  EXPECT_TRUE(profiler.collect().empty());
}

TEST_F(Gl, ProfilerAddsWhatOtherThreadsTook) {
  gl::Profiler profiler(api);
  profiler.add("rays", 3);
  { const auto section = profiler.section("draw"); }
  profiler.add("rays", 4);
  EXPECT_TRUE((api.Finish(), profiler.ready()));
  const std::vector<gl::SectionTime> times = profiler.collect();
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].name, "rays");
  EXPECT_EQ(times[0].milliseconds, 7);
}

TEST_F(Gl, ProfilersTimeOneFrameEach) {
  std::vector<gl::Profiler> frames;
  for (int i = 0; i < 3; ++i) frames.emplace_back(api);
  const auto draw = [this](gl::Profiler& profiler, const std::string& name) {
    const auto section = profiler.section(name);
    gl::Buffer(api, 1 << 16, "scratch").fill(1);
    EXPECT_FALSE(profiler.ready()) << "the section is open";
  };
  for (int frame = 0; frame < 9; ++frame) {
    gl::Profiler& profiler = frames[static_cast<std::size_t>(frame % 3)];
    if (frame >= 3) {
      // The rasterizer's threads may wait for this core.
      for (int i = 0; i < 10'000 && !profiler.ready(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ASSERT_TRUE(profiler.ready()) << "times must arrive without a wait";
      const std::vector<gl::SectionTime> times = profiler.collect();
      ASSERT_EQ(times.size(), 1u);
      EXPECT_EQ(times[0].name, "frame " + std::to_string(frame - 3));
      EXPECT_GT(times[0].milliseconds, 0);
    }
    draw(profiler, "frame " + std::to_string(frame));
  }
}

TEST_F(Gl, HostSectionsAreReadyAtOnce) {
  gl::Profiler profiler(api);
  EXPECT_TRUE(profiler.ready());
  { const auto section = profiler.hostSection("host"); }
  EXPECT_TRUE(profiler.ready());
  EXPECT_EQ(profiler.collect().size(), 1u);
}

}  // namespace
}  // namespace halfsilver
