// A method as an addition: what tracing/README.md says is enough. The toy lies in toy_method/ as it would in renderer/
// and shaders/, and its row of the table is brought to the renderer instead of written there.
#include <algorithm>
#include <filesystem>
#include <string>

#include "gpu/method_contract.h"
#include "gpu/toy_method/tracing/brute_force/brute_force_tracer.h"

namespace halfsilver::testing {
namespace {

const MethodCase kToy = {"brute_force", "halfsilver", {}, 0, BruteForceTracer::method, "gpu/toy_method/shaders"};

INSTANTIATE_TEST_SUITE_P(Toy, MethodTest, ::testing::Values(kToy),
                         [](const auto& method) { return std::string(method.param.name); });

TEST(ToyMethod, TouchesAFolderOfTracingAndOneOfShaders) {
  namespace fs = std::filesystem;
  const fs::path toy = fs::path(HALFSILVER_SOURCE_DIR) / "tests/gpu/toy_method";
  int tracers = 0, shaders = 0;
  for (const auto& entry : fs::recursive_directory_iterator(toy)) {
    if (!entry.is_regular_file()) continue;
    const std::string folder = entry.path().lexically_relative(toy).parent_path().generic_string();
    tracers += folder == "tracing/brute_force" ? 1 : 0;
    shaders += folder == "shaders/tracing/brute_force" ? 1 : 0;
    EXPECT_TRUE(folder == "tracing/brute_force" || folder == "shaders/tracing/brute_force") << entry.path();
  }
  EXPECT_EQ(tracers, 2);
  EXPECT_EQ(shaders, 3);
}

}  // namespace
}  // namespace halfsilver::testing
