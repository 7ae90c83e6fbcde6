// Frames in two halves: two under way at once give what they give one after the other, and figures arrive without a
// wait.
#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/tracer.h>
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

// What a frame is drawn with.
struct View {
  Camera camera;
  Settings settings;
  int width = 0, height = 0;
};

void expectSameCounts(const FrameReport& a, const FrameReport& b) {
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.reflecting, b.reflecting);
  EXPECT_EQ(a.selected, b.selected);
  EXPECT_EQ(a.contributions, b.contributions);
  EXPECT_EQ(a.overflow, b.overflow);
  EXPECT_EQ(a.lostFragments, b.lostFragments);
  EXPECT_EQ(a.memory.gbuffer, b.memory.gbuffer);
  EXPECT_EQ(a.warnings, b.warnings);
}

void expectSameStages(const FrameReport& a, const FrameReport& b) {
  std::vector<std::string> stages[2];
  for (const StageTime& time : a.times) stages[0].push_back(time.stage);
  for (const StageTime& time : b.times) stages[1].push_back(time.stage);
  EXPECT_EQ(stages[0], stages[1]);
}

class FrameInFlight : public TracingTest {
 protected:
  // Two views of different sizes, selections and bounces, for one tracer.
  std::array<View, 2> views(const char* method) const {
    Settings one = settingsWith({{"trace.method", method}, {"trace.bounces", "2"}, {"shadow.sky_directions", "3"}});
    Settings other = one;
    set(other, "trace.bounces", "3");
    set(other, "select.fraction", "0.6");
    set(other, "image.exposure", "1");
    return {View{kAbove, one, 80, 60}, View{lookAt({1.5f, 1.2f, 2.0f}, {0, 0.1f, 0}), other, 64, 72}};
  }

  void begin(Renderer& renderer, const View& view) const {
    renderer.begin(view.camera, view.settings, view.width, view.height);
  }
  void finish(Renderer& renderer, const View& view) {
    const gl::Texture color(api, {.format = GL_RGBA8, .width = view.width, .height = view.height}, "test picture");
    const gl::Framebuffer framebuffer(api);
    framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
    renderer.finish({framebuffer.name(), 0, 0, view.width, view.height});
    picture_.resize(static_cast<std::size_t>(4 * view.width * view.height));
    color.read(GL_RGBA, GL_UNSIGNED_BYTE, picture_.size(), picture_.data());
  }
  Frame render(Renderer& renderer, const View& view) {
    begin(renderer, view);
    finish(renderer, view);
    return {renderer.readLayers(), renderer.report()};
  }

  static void expectUsageError(const std::function<void()>& call) {
    try {
      call();
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    }
  }

  static Scene reflectingSoup() {
    Scene scene = soup(400);
    scene.materials[1].metallic = 0.6f;
    scene.materials[1].roughness = 0.2f;
    return scene;
  }

  Scene scene_ = reflectingSoup();
  std::vector<std::uint8_t> picture_;  // of the last finish()
};

class OverlappingFrames : public FrameInFlight, public ::testing::WithParamInterface<const char*> {};

TEST_P(OverlappingFrames, AreThoseThatFollowEachOther) {
  const auto [a, b] = views(GetParam());
  Renderer inTurn = makeRenderer(scene_);
  render(inTurn, a);  // pools that grow from frame to frame are large enough from here on
  render(inTurn, b);
  const Frame first = render(inTurn, a);
  const std::vector<std::uint8_t> firstPicture = picture_;
  const Frame second = render(inTurn, b);
  const std::vector<std::uint8_t> secondPicture = picture_;
  EXPECT_NE(first.layers.data, second.layers.data);
  if (GetParam() != std::string("none")) {
    EXPECT_GT(first.report.selected, 500u);
    EXPECT_NE(first.report.selected, second.report.selected);
  }

  Renderer overlapping = makeRenderer(scene_);
  render(overlapping, a);
  render(overlapping, b);
  for (int round = 0; round < 2; ++round) {
    SCOPED_TRACE(round);
    begin(overlapping, a);
    begin(overlapping, b);
    finish(overlapping, a);
    EXPECT_TRUE(picture_ == firstPicture);
    EXPECT_TRUE(overlapping.readLayers().data == first.layers.data);
    FrameReport report = overlapping.report();
    expectSameCounts(report, first.report);
    expectSameStages(report, first.report);
    finish(overlapping, b);
    EXPECT_TRUE(picture_ == secondPicture);
    EXPECT_TRUE(overlapping.readLayers().data == second.layers.data);
    report = overlapping.report();
    expectSameCounts(report, second.report);
    expectSameStages(report, second.report);
  }
}

// A frame that begins like the one under way knows nothing yet of that one's later rays, nor may it speak for them.
TEST_F(FrameInFlight, ThatBeginsLikeTheOneBeforeFindsAllHits) {
  const auto [a, b] = views("identity");
  Renderer alone = makeRenderer(scene_);
  const Frame expected = render(alone, b);
  Renderer renderer = makeRenderer(scene_);
  begin(renderer, a);
  begin(renderer, b);
  finish(renderer, a);
  begin(renderer, b);
  for (int i = 0; i < 2; ++i) {
    finish(renderer, b);
    EXPECT_TRUE(renderer.readLayers().data == expected.layers.data) << i;
    EXPECT_EQ(renderer.report().overflow, 0u) << i;
  }
}

// Always one frame ahead, as a window does it.
TEST_P(OverlappingFrames, CanBeKeptUnderWay) {
  const auto [a, b] = views(GetParam());
  Renderer inTurn = makeRenderer(scene_), ahead = makeRenderer(scene_);
  render(inTurn, b);
  render(inTurn, b);
  const Frame first = render(inTurn, a);
  begin(ahead, a);
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    begin(ahead, b);
    finish(ahead, a);
    begin(ahead, a);
    EXPECT_EQ(ahead.report().pixels, first.report.pixels) << "of the frame that ended, although another began";
    expectUsageError([&] { ahead.readLayers(); });
    finish(ahead, b);
  }
  finish(ahead, a);
  EXPECT_TRUE(ahead.readLayers().data == first.layers.data);
  expectSameCounts(ahead.report(), first.report);
}

INSTANTIATE_TEST_SUITE_P(AllMethods, OverlappingFrames,
                         ::testing::Values("exact", "identity", "bvh", "screen-space", "screen-first", "planar",
                                           "cubemap", "attributes", "none"),
                         [](const auto& method) {
                           std::string name(method.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The exact tracer's threads may still trace the first frame when the second one builds.
TEST_F(FrameInFlight, ABuildLeavesTheFrameUnderWayItsStructure) {
  auto [a, b] = views("exact");
  for (View* view : {&a, &b}) set(view->settings, "select.min_contribution", "0.00001");
  Renderer inTurn = makeRenderer(scene_), overlapping = makeRenderer(scene_);
  const Frame first = render(inTurn, a), second = render(inTurn, b);
  EXPECT_GT(first.report.selected, 500u);
  for (int round = 0; round < 4; ++round) {
    SCOPED_TRACE(round);
    begin(overlapping, a);
    overlapping.forgetStructures();
    begin(overlapping, b);
    finish(overlapping, a);
    EXPECT_TRUE(overlapping.readLayers().data == first.layers.data);
    finish(overlapping, b);
    EXPECT_TRUE(overlapping.readLayers().data == second.layers.data);
  }
}

TEST_F(FrameInFlight, AThirdFrameIsRefusedAndTheTwoGoOn) {
  const auto [a, b] = views("identity");
  Renderer renderer = makeRenderer(scene_);
  const Frame first = render(renderer, a);
  begin(renderer, a);
  begin(renderer, b);
  expectUsageError([&, v = a] { begin(renderer, v); });
  expectUsageError([&, v = a] { renderer.render(v.camera, v.settings, {0, 0, 0, v.width, v.height}); });
  expectUsageError([&, v = b] { finish(renderer, v); });  // the oldest has another size
  finish(renderer, a);
  EXPECT_TRUE(renderer.readLayers().data == first.layers.data);
  finish(renderer, b);
  EXPECT_EQ(renderer.report().pixels, static_cast<std::uint64_t>(b.width * b.height));
  expectUsageError([&, v = b] { finish(renderer, v); });
}

TEST_F(FrameInFlight, ArrivedReportsDoNotGoBackBehindAReport) {
  const auto [a, b] = views("identity");
  Renderer renderer = makeRenderer(scene_);
  begin(renderer, a);
  finish(renderer, a);
  begin(renderer, b);
  finish(renderer, b);
  EXPECT_EQ(renderer.report().pixels, static_cast<std::uint64_t>(b.width * b.height));
  api.Finish();
  EXPECT_FALSE(renderer.arrivedReport());
  begin(renderer, a);
  finish(renderer, a);
  api.Finish();
  const auto arrived = renderer.arrivedReport();
  ASSERT_TRUE(arrived);
  EXPECT_EQ(arrived->pixels, static_cast<std::uint64_t>(a.width * a.height));
}

// A tracer whose hits never come.
class FailingTracer final : public Tracer {
 public:
  void update(const FrameView&, const SceneChange&) override {}
  void trace(const FrameView&, const RayQueue&, Hits&) override {}
  void collect(const FrameView&, const RayQueue&, Hits&) override { throw Error(ErrorKind::failed, "no hits"); }
  TracerMemory memory() const override { return {}; }
};

TEST_F(FrameInFlight, FramesThatFailLeaveTheReportOfTheLastGoodOne) {
  const Method failing{methodInfo("exact"),
                       [](const gl::Api&, const Settings&) { return std::make_unique<FailingTracer>(); }};
  Renderer renderer([this](const char* name) { return context.getProcAddress()(name); }, std::vector{failing});
  renderer.setScene(scene_);
  const View good = views("identity")[0], bad = views("exact")[0];
  const Frame before = render(renderer, good);
  for (int i = 0; i < 7; ++i) {
    SCOPED_TRACE(i);
    begin(renderer, bad);
    EXPECT_THROW(finish(renderer, bad), Error);
    expectSameCounts(renderer.report(), before.report);
  }
  const Frame after = render(renderer, good);
  EXPECT_TRUE(after.layers.data == before.layers.data);
  expectSameCounts(after.report, before.report);
}

// Another tracer or other shadow maps would take from the frame under way what it still reads.
TEST_F(FrameInFlight, SettingsOfWhatFramesShareWait) {
  const auto [a, b] = views("identity");
  Renderer renderer = makeRenderer(scene_);
  const Frame first = render(renderer, a);
  for (const auto& [name, value] : {std::pair("trace.method", "exact"), std::pair("voxels.resolution", "16"),
                                    std::pair("shadow.sky_directions", "7"), std::pair("shadow.resolution", "32")}) {
    SCOPED_TRACE(name);
    begin(renderer, a);
    View other = b;
    set(other.settings, name, value);
    expectUsageError([&] { begin(renderer, other); });
    finish(renderer, a);
    EXPECT_TRUE(renderer.readLayers().data == first.layers.data);
    EXPECT_GT(render(renderer, other).report.selected, 0u);
  }
}

TEST_F(FrameInFlight, ARefusedBeginLeavesTheFinishedFrame) {
  const View view = views("identity")[0];
  Renderer renderer = makeRenderer(scene_);
  const Frame first = render(renderer, view);
  View blind = view;
  blind.camera.target = blind.camera.eye;
  expectUsageError([&] { begin(renderer, blind); });
  EXPECT_TRUE(renderer.readLayers().data == first.layers.data);
  expectSameCounts(renderer.report(), first.report);
}

// Passes a context's functions on and counts calls that wait for the GPU.
std::uint64_t waits = 0;
PFNGLCLIENTWAITSYNCPROC clientWaitSync = nullptr;
PFNGLFINISHPROC finishAll = nullptr;
PFNGLGETNAMEDBUFFERSUBDATAPROC getNamedBufferSubData = nullptr;
PFNGLGETQUERYOBJECTUI64VPROC getQueryObject = nullptr;

GLenum APIENTRY countingClientWaitSync(GLsync sync, GLbitfield flags, GLuint64 timeout) {
  waits += timeout > 0;
  return clientWaitSync(sync, flags, timeout);
}
void APIENTRY countingFinish() {
  ++waits;
  finishAll();
}
void APIENTRY countingGetNamedBufferSubData(GLuint buffer, GLintptr offset, GLsizeiptr size, void* data) {
  ++waits;
  getNamedBufferSubData(buffer, offset, size, data);
}
void APIENTRY countingGetQueryObject(GLuint query, GLenum name, GLuint64* value) {
  GLuint64 available = 0;
  getQueryObject(query, GL_QUERY_RESULT_AVAILABLE, &available);
  waits += name == GL_QUERY_RESULT && available == 0;
  getQueryObject(query, name, value);
}

class ArrivedReports : public FrameInFlight {
 protected:
  Renderer countingRenderer() {
    const auto proc = context.getProcAddress();
    Renderer renderer([proc](const char* name) -> Renderer::Proc {
      const Renderer::Proc original = proc(name);
      const auto replaced = [&](const char* function, auto& kept, auto* counting) {
        if (std::strcmp(name, function) != 0) return Renderer::Proc();
        kept = reinterpret_cast<std::remove_reference_t<decltype(kept)>>(original);
        return reinterpret_cast<Renderer::Proc>(counting);
      };
      if (const auto f = replaced("glClientWaitSync", clientWaitSync, countingClientWaitSync)) return f;
      if (const auto f = replaced("glFinish", finishAll, countingFinish)) return f;
      if (const auto f = replaced("glGetNamedBufferSubData", getNamedBufferSubData, countingGetNamedBufferSubData))
        return f;
      if (const auto f = replaced("glGetQueryObjectui64v", getQueryObject, countingGetQueryObject)) return f;
      return original;
    });
    renderer.setScene(scene_);
    return renderer;
  }

  // The next report within a bounded number of questions, none of which waits.
  std::optional<FrameReport> poll(Renderer& renderer, int questions) {
    for (int i = 0; i < questions; ++i) {
      const std::uint64_t before = waits;
      std::optional<FrameReport> report = renderer.arrivedReport();
      EXPECT_EQ(waits, before);
      if (report) return report;
    }
    return std::nullopt;
  }
  static constexpr int kForever = 1'000'000;
};

TEST_F(ArrivedReports, ComeInOrderOnceAndWithoutAWait) {
  Renderer renderer = countingRenderer();
  EXPECT_FALSE(renderer.arrivedReport());
  View view = views("identity")[0];
  std::vector<std::uint64_t> seen;  // widths
  for (int i = 0; i < 12; ++i) {
    view.width = 40 + i;
    begin(renderer, view);
    finish(renderer, view);
    if (const std::optional<FrameReport> report = poll(renderer, i % 3 == 0 ? kForever : 1))
      seen.push_back(report->pixels / static_cast<std::uint64_t>(view.height));
  }
  if (const std::optional<FrameReport> report = poll(renderer, 1)) seen.push_back(report->pixels / 60);
  ASSERT_GE(seen.size(), 4u);
  EXPECT_TRUE(std::adjacent_find(seen.begin(), seen.end(), std::greater_equal<>()) == seen.end());
  EXPECT_GE(seen.front(), 40u);
  EXPECT_LE(seen.back(), 51u);
  EXPECT_GT(waits, 0u) << "what waits elsewhere must have been counted";
}

TEST_F(ArrivedReports, AreTheReportsThatWaitingGives) {
  const auto [a, b] = views("identity");
  Renderer waiting = makeRenderer(scene_), polling = countingRenderer();
  const Frame first = render(waiting, a), second = render(waiting, b);
  begin(polling, a);
  begin(polling, b);
  finish(polling, a);
  std::optional<FrameReport> report = poll(polling, kForever);
  ASSERT_TRUE(report);
  expectSameCounts(*report, first.report);
  EXPECT_FALSE(polling.arrivedReport()) << "given once";
  expectSameCounts(polling.report(), first.report);
  finish(polling, b);
  report = poll(polling, kForever);
  ASSERT_TRUE(report);
  expectSameCounts(*report, second.report);
  EXPECT_FALSE(polling.arrivedReport());
}

TEST_F(ArrivedReports, DoNotRepeatWhatReportHasSaid) {
  Renderer renderer = countingRenderer();
  const View view = views("identity")[0];
  begin(renderer, view);
  finish(renderer, view);
  EXPECT_GT(renderer.report().selected, 0u);
  EXPECT_FALSE(renderer.arrivedReport());
}

}  // namespace
}  // namespace halfsilver::testing
