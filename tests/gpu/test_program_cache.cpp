// Programs that an earlier start has made, and programs made ahead. Where the driver gives out no programs, tests skip.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/error.h>
#include "gl/program.h"
#include "gpu/tracing_scenes.h"
#include "temporary_folder.h"

namespace halfsilver::testing {
namespace {

namespace fs = std::filesystem;

// The cache is in a folder of the test's own.
class ProgramCache : public TracingTest {
 protected:
  ProgramCache() { use(folder_.path()); }
  ~ProgramCache() override { ::unsetenv("HALFSILVER_CACHE"); }
  void SetUp() override {
    if (api.programFormats.empty()) GTEST_SKIP() << "this driver gives out no programs";
  }

  static void use(const fs::path& folder) { ::setenv("HALFSILVER_CACHE", folder.c_str(), 1); }
  fs::path folder() const { return folder_.path(); }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder())) found.push_back(entry.path());
    return found;
  }

  // The files as a start with other damage would find them.
  template <class Damage>
  void damageAll(const Damage& damage) const {
    for (const fs::path& file : files()) damage(file);
  }

  struct Start {
    DeviceInfo device;
    Frame frame;
  };
  // A renderer from its beginning to its first picture.
  Start start() {
    Renderer renderer = makeRenderer(scene_);
    const Frame frame = drawWith(renderer, kAbove, settings_, 80, 60);
    return {renderer.device(), frame};
  }

 private:
  TemporaryFolder folder_;
  const Scene scene_ = soup(600);
  const Settings settings_ = settingsWith({{"trace.method", "identity"}});
};

TEST_F(ProgramCache, ASecondStartCompilesNothingAndShowsTheSame) {
  const Start first = start();
  EXPECT_GT(first.frame.report.selected, 100u);
  EXPECT_GT(first.device.programsCompiled, 20u);
  EXPECT_EQ(files().size(), first.device.programsCompiled);
  const Start second = start();
  EXPECT_EQ(second.device.programsCompiled, 0u);
  EXPECT_EQ(second.device.programsCached, first.device.programsCompiled + first.device.programsCached);
  EXPECT_EQ(second.frame.layers.data, first.frame.layers.data);
}

TEST_F(ProgramCache, OnlyProgramsAreRemovedIfThereIsTooMuch) {
  std::ofstream(folder() / "mine");
  std::ofstream(folder() / "old.program");
  for (const char* name : {"mine", "old.program"}) fs::resize_file(folder() / name, std::uintmax_t{300} << 20);
  start();
  EXPECT_TRUE(fs::exists(folder() / "mine"));
  EXPECT_FALSE(fs::exists(folder() / "old.program"));
  EXPECT_GT(files().size(), 20u);
}

TEST_F(ProgramCache, DamagedFilesAreCompiledAgainAndReplaced) {
  const Start whole = start();
  const auto expectSound = [&](const char* damage) {
    const Start again = start();
    EXPECT_EQ(again.device.programsCached, whole.device.programsCached) << damage;
    EXPECT_EQ(again.device.programsCompiled, whole.device.programsCompiled) << damage;
    EXPECT_EQ(again.frame.layers.data, whole.frame.layers.data) << damage;
    EXPECT_EQ(start().device.programsCompiled, 0u) << damage;
  };
  damageAll([](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); });
  expectSound("cut off");
  damageAll([](const fs::path& file) { std::ofstream(file) << "not a program"; });
  expectSound("other text");
  damageAll([](const fs::path& file) { std::ofstream(file, std::ios::trunc); });
  expectSound("empty");
  damageAll([](const fs::path& file) {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(fs::file_size(file) - 9));
    bytes.put('\x5a').put('\xa5').put('\x5a');
  });
  expectSound("changed bytes");
}

// As after an update of the driver that kept its name.
TEST_F(ProgramCache, WhatTheDriverRefusesIsCompiledAgain) {
  const Start whole = start();
  gl::GetProcAddress getProcAddress = [this](const char* name) -> gl::Proc {
    if (std::string_view(name) != "glProgramBinary") return context.getProcAddress()(name);
    return reinterpret_cast<gl::Proc>(+[](GLuint, GLenum, const void*, GLsizei) {});  // links nothing
  };
  Renderer renderer(getProcAddress);
  renderer.setScene(soup(600));
  drawWith(renderer, kAbove, settingsWith({{"trace.method", "identity"}}), 80, 60);
  EXPECT_EQ(renderer.device().programsCached, 0u);
  EXPECT_EQ(renderer.device().programsCompiled, whole.device.programsCompiled + whole.device.programsCached);
}

TEST_F(ProgramCache, AFolderThatCannotBeWrittenIsNoError) {
  const Start kept = start();
  for (const fs::path& place : {fs::path("/proc/halfsilver"), files().front(), fs::path()}) {
    use(place);
    const Start other = start();
    EXPECT_EQ(other.device.programsCached, 0u) << place;
    EXPECT_EQ(other.device.programsCompiled, kept.device.programsCompiled + kept.device.programsCached) << place;
    EXPECT_EQ(other.frame.layers.data, kept.frame.layers.data) << place;
  }
}

// An environment variable that is as it was after the test.
class Variable {
 public:
  explicit Variable(const char* name) : name_(name) {
    const char* value = std::getenv(name);
    if (value) before_ = value;
  }
  ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  void set(const std::string& value) const { ::setenv(name_, value.c_str(), 1); }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_F(ProgramCache, LiesInTheUsersCacheFolderAndNoRelativeOne) {
  ::unsetenv("HALFSILVER_CACHE");
  const Variable cache("XDG_CACHE_HOME"), home("HOME");
  cache.set(folder());
  gl::Program::compute(api, "tracing/common/resume.comp");
  EXPECT_TRUE(fs::is_directory(folder() / "halfsilver"));
  EXPECT_EQ(files().size(), 1u);
  cache.set("not/absolute");
  home.set(folder());
  gl::Program::compute(api, "tracing/common/resume.comp");
  EXPECT_TRUE(fs::is_directory(folder() / ".cache" / "halfsilver"));
  EXPECT_FALSE(fs::exists("not"));
}

// ---- Programs made ahead

class Prepared : public TracingTest, public ::testing::WithParamInterface<const char*> {
 protected:
  static std::uint64_t programs(const Renderer& renderer) {
    return renderer.device().programsCompiled + renderer.device().programsCached;
  }
};

// Of a preset, or "name=value" over the defaults.
Settings settingsOf(const std::string& text) {
  Settings settings = settingsWith({{"trace.method", "identity"}});
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string pair = text.substr(begin, end - begin);
    const std::size_t equals = pair.find('=');
    set(settings, pair.substr(0, equals), pair.substr(equals + 1));
    begin = end + 1;
  }
  return settings;
}

TEST_P(Prepared, FramesCompileNothing) {
  Scene scene = soup(600);
  scene.materials[1].transmission = 0.5f;
  const Settings settings = settingsOf(GetParam());
  Renderer renderer = makeRenderer(scene);
  const std::uint64_t before = programs(renderer);
  renderer.prepare(settings);
  const std::uint64_t made = programs(renderer);
  EXPECT_GT(made, before);
  const gl::Texture color(api, {.format = GL_RGBA8, .width = 80, .height = 60}, "test picture");
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
  const Target target{framebuffer.name(), 0, 0, 80, 60};
  renderer.render(kAbove, settings, target);
  EXPECT_GT(renderer.report().selected, 100u);
  EXPECT_EQ(programs(renderer), made) << "the first frame";
  const VertexRange moved{60, 30};
  for (std::uint32_t v = moved.first; v < moved.first + moved.count; ++v) scene.vertices[v].position.y += 0.05f;
  renderer.updateVertices(scene, std::span(&moved, 1));
  renderer.render(kAbove, settings, target);
  EXPECT_EQ(programs(renderer), made) << "something moves";
  renderer.refine(kAbove, settings, target, 0);
  EXPECT_EQ(programs(renderer), made) << "a sample";
}

INSTANTIATE_TEST_SUITE_P(Settings, Prepared,
                         ::testing::Values("select.mode=reflective", "trace.bounces=3", "select.min_contribution=0.01",
                                           "trace.effect=whitted", "trace.effect=path", "trace.effect=occlusion",
                                           "trace.effect=layers", "effect.glossy=true", "shadow.method=rays",
                                           "image.antialiasing=temporal", "image.antialiasing=fxaa",
                                           "image.motion=true", "trace.method=attributes", "trace.method=bvh",
                                           "trace.method=depth-cube", "trace.method=screen-space"),
                         [](const auto& preset) {
                           std::string name = preset.param;
                           for (char& letter : name)
                             if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
                           return name;
                         });

using Preparing = TracingTest;

TEST_F(Preparing, ChangesNoPicture) {
  const Scene scene = soup(600);
  const Settings settings = settingsWith({{"trace.method", "identity"}});
  Renderer renderer = makeRenderer(scene);
  renderer.prepare(settings);
  EXPECT_THROW(renderer.report(), Error) << "no frame has been drawn";
  EXPECT_THROW(renderer.readLayers(), Error);
  EXPECT_FALSE(renderer.arrivedReport());
  EXPECT_EQ(drawWith(renderer, kAbove, settings, 80, 60).layers.data,
            drawOnce(scene, kAbove, settings, 80, 60).layers.data);
}

TEST_F(Preparing, NeedsAScene) {
  Renderer renderer(context.getProcAddress());
  EXPECT_THROW(renderer.prepare({}), Error);
}

}  // namespace
}  // namespace halfsilver::testing
