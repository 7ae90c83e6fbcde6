// What trace.method=auto remembers from run to run.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "apps/method_choice.h"
#include "apps/view_request.h"
#include "temporary_folder.h"

namespace halfsilver {
namespace {

const ChoiceKey kKey{.device = "a GPU",
                     .version = "4.6",
                     .methods = "identity,bvh",
                     .scene = "hall.glb",
                     .triangles = 12,
                     .width = 8,
                     .height = 6,
                     .rest = "reflection"};

struct Chooser {
  int asked = 0;
  MethodChoice operator()() {
    ++asked;
    return {"bvh", "measured: bvh 1 ms", {{"bvh", 1.0}}};
  }
};

MethodChoice chosen(const std::filesystem::path& file, const ChoiceKey& key, Chooser& chooser) {
  return rememberedChoice(file, key, [&chooser] { return chooser(); });
}

TEST(MethodChoice, IsRememberedForTheSameDeviceAndScene) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "cache/methods.json";
  Chooser chooser;
  EXPECT_EQ(chosen(file, kKey, chooser).method, "bvh");
  const MethodChoice again = chosen(file, kKey, chooser);
  EXPECT_EQ(again.method, "bvh");
  EXPECT_NE(again.reason.find("remembered"), std::string::npos);
  EXPECT_EQ(chooser.asked, 1);
  ChoiceKey other = kKey;
  other.moves = true;
  chosen(file, other, chooser);
  other.device = "another GPU";
  chosen(file, other, chooser);
  EXPECT_EQ(chooser.asked, 3);
  other = kKey;
  other.methods = "identity,bvh,exact";
  chosen(file, other, chooser);
  EXPECT_EQ(chooser.asked, 4);
}

TEST(MethodChoice, AFileThatCannotBeReadOrWrittenIsNoError) {
  const TemporaryFolder folder;
  Chooser chooser;
  EXPECT_EQ(chosen({}, kKey, chooser).method, "bvh");
  std::ofstream(folder / "file") << "no folder";
  EXPECT_EQ(chosen(folder / "file/methods.json", kKey, chooser).method, "bvh");
  for (const char* text : {"", "{", "[1]", R"({"x": 3})", "\xff\xfe"}) {
    std::ofstream(folder / "methods.json") << text;
    EXPECT_EQ(chosen(folder / "methods.json", kKey, chooser).method, "bvh") << text;
  }
  EXPECT_EQ(chooser.asked, 7);
  // What it says must be a method without errors.
  std::ofstream(folder / "methods.json") << "{\"" << kKey.text() << R"(": {"method": "cubemap", "reason": ""}})";
  chosen(folder / "methods.json", kKey, chooser);
  EXPECT_EQ(chooser.asked, 8);
}

TEST(MethodChoice, OnlyMeasuredOnesAreWritten) {
  const TemporaryFolder folder;
  rememberedChoice(folder / "methods.json", kKey, [] { return MethodChoice{"exact", "software", {}}; });
  EXPECT_FALSE(std::filesystem::exists(folder / "methods.json"));
}

TEST(MethodChoice, TheOldestGoFirst) {
  const TemporaryFolder folder;
  Chooser chooser;
  ChoiceKey key = kKey;
  for (int i = 0; i < 300; ++i) {
    key.width = i;
    chosen(folder / "methods.json", key, chooser);
  }
  key.width = 0;
  chosen(folder / "methods.json", key, chooser);
  EXPECT_EQ(chooser.asked, 301);
  key.width = 299;
  chosen(folder / "methods.json", key, chooser);
  EXPECT_EQ(chooser.asked, 301);
}

TEST(ProgramSettings, TakeAutoUnlessAMethodOrItsStructureIsMeant) {
  const auto methodOf = [](const std::vector<std::string>& set, const std::string& preset = {}) {
    ViewRequest request;
    request.set = set;
    request.preset = preset;
    Settings settings = programSettings(request);
    applyOverrides(settings, request);
    return settings.trace.method;
  };
  EXPECT_EQ(methodOf({}), "auto");
  EXPECT_EQ(methodOf({"shadow.method=rays", "trace.bounces=2"}), "auto");
  EXPECT_EQ(methodOf({"voxels.resolution=64"}), "identity");
  EXPECT_EQ(methodOf({"trace.stage=fragment"}), "identity");
  EXPECT_EQ(methodOf({"trace.method=bvh"}), "bvh");
  EXPECT_EQ(methodOf({}, "halfsilver"), "identity");
  EXPECT_EQ(methodOf({}, "reference"), "exact");
}

}  // namespace
}  // namespace halfsilver
