#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/methods.h>
#include <halfsilver/settings.h>

namespace halfsilver {
namespace {

const SettingInfo& find(const std::vector<SettingInfo>& infos, const std::string& name) {
  const auto info = std::find_if(infos.begin(), infos.end(), [&](const SettingInfo& i) { return i.name == name; });
  if (info == infos.end()) throw std::runtime_error("no setting " + name);
  return *info;
}

std::string valueOf(const Settings& settings, const std::string& name) { return find(describe(settings), name).value; }

std::string rejection(const std::string& name, const std::string& value) {
  Settings settings;
  try {
    set(settings, name, value);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    return error.what();
  }
  return "accepted";
}

TEST(Settings, NamesOfTheContractExist) {
  const std::vector<SettingInfo> infos = describe({});
  for (const char* name :
       {"scene.cull_back_faces", "select.mode", "select.fraction", "select.max_roughness", "voxels.resolution",
        "abuffer.resolution", "abuffer.page_size", "search.steps", "trace.bounces"})
    EXPECT_NO_THROW(find(infos, name)) << name;
  EXPECT_EQ(find(infos, "select.mode").choices, (std::vector<std::string>{"none", "reflective", "all"}));
}

TEST(Settings, EveryNameIsUniqueAndExplained) {
  std::vector<std::string> names;
  for (const SettingInfo& info : describe({})) {
    names.push_back(info.name);
    EXPECT_EQ(std::count(info.name.begin(), info.name.end(), '.'), 1) << info.name;
    EXPECT_FALSE(info.help.empty()) << info.name;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

// Settings learn of methods from the table, and the table speaks of settings that exist.
TEST(Settings, MethodsAreThoseOfTheTable) {
  std::vector<std::string> names;
  const std::vector<SettingInfo> infos = describe({});
  for (const MethodInfo& method : methods()) {
    names.push_back(method.name);
    EXPECT_EQ(methodInfo(method.name).help, method.help);
    EXPECT_FALSE(method.help.empty()) << method.name;
    for (const std::string& name : method.settings) EXPECT_NO_THROW(find(infos, name)) << method.name;
    for (const Knob& knob : method.knobs) {
      EXPECT_EQ(std::count(method.settings.begin(), method.settings.end(), knob.setting), 1) << knob.setting;
      for (const std::string& value : knob.values) {
        Settings settings;
        EXPECT_NO_THROW(set(settings, knob.setting, value)) << knob.setting;
      }
    }
    EXPECT_EQ(method.preset.empty(), method.knobs.empty()) << method.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"none", "attributes", "depth-cube", "voxels", "identity", "bvh",
                                             "screen-space", "screen-first", "planar", "cubemap", "exact", "auto"}));
  EXPECT_EQ(find(infos, "trace.method").choices, names);
  EXPECT_THROW(methodInfo("identities"), Error);
}

// The order of the command line, of files and of statistics.
TEST(Settings, AreInTheirFixedOrder) {
  std::vector<std::string> names;
  for (const SettingInfo& info : describe({}))
    if (info.name.starts_with("voxels.") || info.name.starts_with("abuffer.") || info.name.starts_with("search."))
      names.push_back(info.name);
  EXPECT_EQ(names, (std::vector<std::string>{"voxels.resolution", "voxels.per_triangle", "voxels.raster", "voxels.axis",
                                             "abuffer.resolution", "abuffer.keep", "abuffer.page_size",
                                             "abuffer.buffers", "abuffer.lists", "abuffer.sorted", "search.steps",
                                             "search.refinements", "search.any_hit_refinements", "search.test"}));
}

// Takes the default of every setting back in, and both ends of its range, and every choice.
TEST(Settings, EveryValueReadsBackAsItWasWritten) {
  for (const SettingInfo& info : describe({})) {
    std::vector<std::string> values = info.choices;
    values.push_back(info.value);
    if (info.kind == SettingInfo::Kind::boolean) values = {"true", "false"};
    if (info.kind == SettingInfo::Kind::integer || info.kind == SettingInfo::Kind::real)
      for (const double end : {info.low, info.high}) values.push_back(std::to_string(static_cast<int>(end)));
    for (const std::string& value : values) {
      Settings settings;
      ASSERT_NO_THROW(set(settings, info.name, value)) << info.name << " = " << value;
      EXPECT_EQ(valueOf(settings, info.name), value) << info.name;
      for (const SettingInfo& other : describe(settings))
        if (other.name != info.name) {
          EXPECT_EQ(other.value, valueOf({}, other.name)) << info.name << " changed " << other.name;
        }
    }
  }
}

TEST(Settings, ValuesOutOfRangeAreRejected) {
  for (const SettingInfo& info : describe({})) {
    if (info.kind != SettingInfo::Kind::integer && info.kind != SettingInfo::Kind::real) continue;
    for (const double value : {info.low - 1, info.high + 1}) {
      const std::string message = rejection(info.name, std::to_string(value));
      EXPECT_EQ(message.rfind("setting " + info.name + ": ", 0), 0u) << message;
      EXPECT_NE(message.find(" to "), std::string::npos) << message;
    }
  }
}

// Hu et al. 2014, section 5: sqrt(3 n) voxels along each side for n x n texels.
TEST(Settings, AutoIsAsManyVoxelsAsTheTexelsNeed) {
  Settings settings;
  set(settings, "voxels.resolution", "auto");
  EXPECT_EQ(valueOf(settings, "voxels.resolution"), "auto");
  EXPECT_TRUE(isWord(find(describe(settings), "voxels.resolution")));
  EXPECT_FALSE(isWord(find(describe({}), "voxels.resolution")));
  for (const auto& [texels, voxels] : {std::pair(1280, 62), {1024, 55}, {512, 39}, {1, 2}, {4096, 111}}) {
    settings.abuffer.resolution = texels;
    EXPECT_EQ(resolutionOf(settings.voxels, settings.abuffer), voxels) << texels;
  }
  set(settings, "voxels.resolution", "100");
  EXPECT_EQ(resolutionOf(settings.voxels, settings.abuffer), 100);
}

TEST(Settings, WrongValuesAreNamed) {
  EXPECT_EQ(rejection("select.mode", "some"), "setting select.mode: 'some' is not one of none, reflective, all");
  EXPECT_EQ(rejection("voxels.resolution", "12.5"),
            "setting voxels.resolution: '12.5' is not a whole number from 1 to 512 or auto");
  EXPECT_EQ(rejection("select.fraction", "1.01"), "setting select.fraction: '1.01' is not a number from 0 to 1");
  EXPECT_EQ(rejection("scene.cull_back_faces", "yes"), "setting scene.cull_back_faces: 'yes' is not true or false");
  EXPECT_EQ(rejection("select.modes", "none"), "unknown setting 'select.modes'");
  EXPECT_EQ(rejection("", "none"), "unknown setting ''");
}

TEST(Settings, TextsThatAreNotNumbersAreRejected) {
  for (const char* value : {"", " 1", "1 ", "1x", "nan", "inf", "-inf", "0x10", "1,5", "--1"})
    EXPECT_NE(rejection("select.fraction", value), "accepted") << "'" << value << "'";
  for (const char* value : {"99999999999999999999", "1e400", "nan", ""})
    EXPECT_NE(rejection("voxels.resolution", value), "accepted") << "'" << value << "'";
}

}  // namespace
}  // namespace halfsilver
