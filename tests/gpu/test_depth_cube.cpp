// The layered depth cube: how it is peeled, what it keeps, and why its hits are wrong.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <halfsilver/builtin.h>
#include <halfsilver/io.h>
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

class DepthCubeTest : public TracingTest {
 protected:
  static Settings cube(std::initializer_list<std::pair<const char*, const char*>> more) {
    Settings settings = settingsWith({});
    applyPreset(settings, "burger2007");
    for (const auto& [name, value] : more) set(settings, name, value);
    return settings;
  }

  static double buildTime(const Frame& frame) {
    for (const StageTime& time : frame.report.times)
      if (time.stage == "build") return time.milliseconds;
    return 0;
  }
};

// Layers, of the bytes that one takes: depth, normal, triangle and color of three images.
std::uint64_t layersOf(const Frame& frame, std::uint64_t texels) {
  const auto sample = static_cast<std::uint64_t>(frame.report.memory.bytesPerFragment);
  return frame.report.memory.poolReserved / (3 * texels * texels * sample);
}

TEST_F(DepthCubeTest, HasAsManyLayersAsSurfacesLieBehindEachOther) {
  for (const int sheets : {3, 17}) {
    const Frame frame = drawOnce(manySheets(sheets), kBelowSheets, cube({{"abuffer.resolution", "64"}}), 40, 30);
    EXPECT_EQ(layersOf(frame, 64), static_cast<std::uint64_t>(sheets + 1));
    EXPECT_EQ(frame.report.memory.fragmentsStored, frame.report.memory.fragments);
    EXPECT_EQ(frame.report.memory.fragmentsStored, frame.report.memory.fragmentsPerAxis[1]) << "all lie flat";
    EXPECT_GT(frame.report.memory.fragmentsStored, static_cast<std::uint64_t>(60 * 60 * (sheets + 1)));
    EXPECT_EQ(frame.report.overflow, 0u);
  }
}

TEST_F(DepthCubeTest, StoresEachTriangleAlongOneAxisOrAllThree) {
  const Scene scene = soup(300);
  const Frame own = drawOnce(scene, kAbove, cube({{"abuffer.resolution", "128"}}), 40, 30);
  const Frame all = drawOnce(scene, kAbove, cube({{"abuffer.resolution", "128"}, {"cube.axes", "all"}}), 40, 30);
  EXPECT_LT(own.report.memory.fragmentsStored, all.report.memory.fragmentsStored);
  EXPECT_LT(all.report.memory.fragmentsStored, 3 * own.report.memory.fragmentsStored);
}

// What lies behind the last layer may be hit or not: such a ray is an overflow, and every other is as with all layers.
TEST_F(DepthCubeTest, LayersBeyondTheLimitAreOverflowNotMisses) {
  const Scene scene = soup(600);
  const Frame whole = drawOnce(scene, kAbove, cube({{"abuffer.resolution", "128"}}), 80, 60);
  const Frame cut = drawOnce(scene, kAbove, cube({{"abuffer.resolution", "128"}, {"cube.layers", "2"}}), 80, 60);
  ASSERT_GT(layersOf(whole, 128), 3u);
  EXPECT_EQ(layersOf(cut, 128), 2u);
  EXPECT_EQ(cut.report.memory.fragmentsStored + cut.report.lostFragments, cut.report.memory.fragments);
  const std::vector<float> t = cut.plane("hit.T"), truth = whole.plane("hit.T");
  std::uint64_t overflow = 0, hits = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] == -3.0f) {
      ++overflow;
      continue;
    }
    EXPECT_EQ(t[i], truth[i]) << i;
    hits += t[i] >= 0 ? 1 : 0;
  }
  EXPECT_EQ(overflow, cut.report.overflow);
  EXPECT_GT(overflow, 20u);
  EXPECT_GT(hits, 200u);
}

TEST_F(DepthCubeTest, IsKeptWhileNothingMovesAndPeeledAgainAfterAMove) {
  Scene scene = soup(300);
  Renderer renderer = makeRenderer(scene);
  const Settings settings = cube({{"abuffer.resolution", "128"}});
  const Frame first = drawWith(renderer, kAbove, settings, 80, 60);
  EXPECT_GT(buildTime(first), 0);
  const Camera other = lookAt({0.3f, 1.7f, 3.0f}, {0, 0.1f, 0});
  EXPECT_EQ(buildTime(drawWith(renderer, other, settings, 80, 60)), 0);
  const Frame still = drawWith(renderer, kAbove, settings, 80, 60);
  EXPECT_EQ(first.layers.data, still.layers.data);

  const VertexRange moved{static_cast<std::uint32_t>(scene.vertices.size()) - 90, 90};
  for (std::uint32_t v = moved.first; v < moved.first + moved.count; ++v) scene.vertices[v].position.y += 0.2f;
  std::uint64_t bytes = 0;
  for (int i = 0; i < 20; ++i) {
    renderer.updateVertices(scene, std::span(&moved, 1));
    const Frame frame = drawWith(renderer, kAbove, settings, 80, 60);
    if (i == 0) {
      EXPECT_GT(buildTime(frame), 0);
      EXPECT_NE(frame.layers.data, first.layers.data);
      EXPECT_EQ(frame.layers.data, draw(scene, kAbove, settings, 80, 60).layers.data);
      bytes = frame.report.memory.structureTotal;
    }
    EXPECT_EQ(frame.report.memory.structureTotal, bytes) << "grows with the frames";
  }
}

// A block is only a shortcut: its size changes no hit.
TEST_F(DepthCubeTest, BlocksOfAnySizeGiveTheSameHits) {
  const Scene scene = soup(600);
  const Frame small = drawOnce(scene, kAbove, cube({{"abuffer.resolution", "100"}, {"cube.block", "2"}}), 80, 60);
  for (const char* block : {"7", "32"}) {
    const Frame other = drawOnce(scene, kAbove, cube({{"abuffer.resolution", "100"}, {"cube.block", block}}), 80, 60);
    EXPECT_EQ(small.plane("hit.T"), other.plane("hit.T")) << block;
  }
}

// Why rays are wrong: each wrong ray belongs to the first of the changes below that makes it right, the rest to the
// tolerance and the texels.
TEST_F(DepthCubeTest, ErrorsByCauseAddUpToHitError) {
  const Scene scene = makeBuiltin("teapot").scene;
  const Camera camera = scene.cameras.front();
  constexpr int kWidth = 160, kHeight = 90;
  const float limit = 1e-3f * scene.bounds().diagonal();
  const Frame exact = draw(scene, camera, settingsWith({{"trace.method", "exact"}}), kWidth, kHeight);
  const std::vector<float> truth = exact.plane("hit.T");
  Settings settings = cube({{"abuffer.resolution", "256"}, {"cube.layers", "3"}});
  const Frame preset = drawOnce(scene, camera, settings, kWidth, kHeight);
  const auto wrongRays = [&](const Frame& frame) {
    const std::vector<float> t = frame.plane("hit.T");
    std::vector<bool> wrong(t.size());
    for (std::size_t i = 0; i < t.size(); ++i)
      wrong[i] = (t[i] >= 0) != (truth[i] >= 0) || (t[i] >= 0 && std::abs(t[i] - truth[i]) > limit);
    return wrong;
  };
  std::vector<bool> wrong = wrongRays(preset);
  const auto rays = static_cast<double>(preset.report.selected);
  const HitErrors errors = compareHits(preset, exact, scene.bounds().diagonal());
  const auto count = [](const std::vector<bool>& all) { return std::count(all.begin(), all.end(), true); };
  std::vector<std::pair<const char*, std::ptrdiff_t>> causes;
  for (const auto& [cause, name, value] :
       {std::tuple("layers", "cube.layers", "64"), std::tuple("depth", "cube.depth", "single"),
        std::tuple("axis", "cube.axes", "all")}) {
    set(settings, name, value);
    const std::vector<bool> still = wrongRays(drawOnce(scene, camera, settings, kWidth, kHeight));
    std::ptrdiff_t righted = 0;
    for (std::size_t i = 0; i < wrong.size(); ++i)
      if (wrong[i] && !still[i]) {
        wrong[i] = false;
        ++righted;
      }
    causes.emplace_back(cause, righted);
  }
  causes.emplace_back("tolerance", count(wrong));
  std::ptrdiff_t sum = 0;
  for (const auto& [cause, number] : causes) {
    RecordProperty(cause, std::to_string(number));
    EXPECT_GT(number, 0) << cause;
    sum += number;
  }
  EXPECT_NEAR(static_cast<double>(sum) / rays, errors.hitError, 1e-9);
  EXPECT_GT(rays, 1000);
}

}  // namespace
}  // namespace halfsilver::testing
