#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "bench/modes/effects/report.h"
#include "contract/program.h"

namespace halfsilver::bench {
namespace {

#if HALFSILVER_EXACT
TEST(BenchEffects, EachEffectComesWithItsErrorAndWhatItsRaysCost) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgramIn(folder, "effects builtin:cornell -o DIR --quick --size 64x48");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::map<std::string, std::vector<EffectPoint>> byEffect;
  const nlohmann::json record = readJson(folder / "DIR/effects.json");
  for (const auto& json : record["points"]) {
    const auto point = fromJson<EffectPoint>(json);
    byEffect[point.effect + " " + point.method].push_back(point);
    EXPECT_EQ(point.overflow, 0u);
    EXPECT_GT(point.times.frame.median, 0);
  }
  ASSERT_EQ(byEffect.size(), 14u);
  for (const char* effect : {"occlusion", "path", "shadow rays"}) {
    SCOPED_TRACE(effect);
    const std::vector<EffectPoint>& own = byEffect[std::string(effect) + " identity"];
    ASSERT_EQ(own.size(), 2u);
    EXPECT_GT(own[0].rays, 500u);
    EXPECT_GT(own[1].rays, 2 * own[0].rays);
    EXPECT_GT(own[0].microsecondsPerRay, 0);
    EXPECT_GT(own[0].rmse, 0.001);
    EXPECT_LT(own[1].rmse, 0.75 * own[0].rmse) << "four times the samples";
    const std::vector<EffectPoint>& exact = byEffect[std::string(effect) + " exact"];
    EXPECT_NEAR(own[0].rmse, exact[0].rmse, 1e-4) << "the noise is the same over all methods without errors";
  }
  EXPECT_LT(byEffect["whitted identity"][0].rmse, 1e-4);
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/effects.csv", "DIR/effects.svg", "DIR/index.html", "DIR/builtin-cornell-path.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;
}
#endif

}  // namespace
}  // namespace halfsilver::bench
