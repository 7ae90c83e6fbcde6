#include "apps/statistics.h"

#include <gtest/gtest.h>

#include <halfsilver/error.h>
#include "apps/arguments.h"
#include "apps/drawing.h"
#include "apps/scene_input.h"

namespace halfsilver {
namespace {

StageSummary stageOf(const std::vector<StageSummary>& all, const std::string& name) {
  for (const StageSummary& stage : all)
    if (stage.stage == name) return stage;
  ADD_FAILURE() << "no stage " << name;
  return {};
}

std::vector<StageSummary> summarize(const std::vector<double>& samples) {
  StageTimes times;
  for (const double sample : samples) times.add(std::vector<StageTime>{{"trace", sample}});
  return times.summarize();
}

TEST(SampleReports, AreOneReportOfAllSamples) {
  const auto sample = [](double trace, std::vector<std::string> warnings) {
    FrameReport report;
    report.times = {{"trace", trace}, {"shade", 1}};
    report.overflow = 2;
    report.lostFragments = 3;
    report.selected = static_cast<std::uint64_t>(trace);
    report.warnings = std::move(warnings);
    return report;
  };
  SampleReports reports;
  reports.add(sample(4, {"a", "b"}));
  reports.add(sample(-1, {"c", "b"}));
  reports.add(sample(8, {}));
  const FrameReport joined = reports.joined();
  EXPECT_EQ(joined.warnings, (std::vector<std::string>{"a", "b", "c"})) << "each once, in their order";
  EXPECT_EQ(joined.overflow, 6u);
  EXPECT_EQ(joined.lostFragments, 9u);
  EXPECT_EQ(joined.selected, 8u) << "the last one's";
  ASSERT_EQ(joined.times.size(), 2u);
  EXPECT_EQ(joined.times[0].stage, "trace");
  EXPECT_DOUBLE_EQ(joined.times[0].milliseconds, 18) << "the rejected one counts as the mean";
  EXPECT_DOUBLE_EQ(joined.times[1].milliseconds, 3);
}

TEST(StageTimes, MedianMinMax) {
  const StageSummary odd = stageOf(summarize({3, 1, 2}), "trace");
  EXPECT_EQ(odd.median, 2);
  EXPECT_EQ(odd.min, 1);
  EXPECT_EQ(odd.max, 3);
  EXPECT_EQ(odd.runs, 3u);
  EXPECT_EQ(odd.rejected, 0u);
  EXPECT_EQ(stageOf(summarize({1, 2, 3, 5}), "trace").median, 2.5);
}

TEST(StageTimes, RejectsAbsurdAnswersAndCountsThem) {
  const StageSummary stage = stageOf(summarize({2, -1, 2.5, 3, 500, 2.2}), "trace");
  EXPECT_EQ(stage.rejected, 2u);
  EXPECT_EQ(stage.runs, 4u);
  EXPECT_EQ(stage.max, 3);
  const StageSummary none = stageOf(summarize({-1, -1}), "trace");
  EXPECT_EQ(none.runs, 0u);
  EXPECT_EQ(none.rejected, 2u);
  EXPECT_EQ(none.median, 0);
  // With two runs nobody can tell which is wrong; runs of 0 ms reject nothing.
  EXPECT_EQ(stageOf(summarize({1, 100}), "trace").rejected, 0u);
  EXPECT_EQ(stageOf(summarize({0, 0, 0.1}), "trace").rejected, 0u);
}

TEST(StageTimes, AllStagesAreAlwaysPresentAndOthersFollow) {
  StageTimes times;
  times.add(std::vector<StageTime>{{"extra", 4}, {"gbuffer", 1}});
  const auto all = times.summarize();
  const std::vector<std::string> contract = {"shadow", "gbuffer", "select",    "voxelize", "build",
                                             "trace",  "shade",   "composite", "frame",    "extra"};
  ASSERT_EQ(all.size(), contract.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].stage, contract[i]);
  EXPECT_EQ(stageOf(all, "trace").runs, 0u);
  times.add(std::vector<StageTime>{{"pose", 1}});
  EXPECT_EQ(times.summarize().front().stage, "pose") << "in the order of a frame";
}

TEST(Statistics, JsonHasTheContractsNames) {
  RunStatistics s;
  s.stages = StageTimes{}.summarize();
  s.report.pixels = 200;
  s.report.selected = 50;
  s.report.minDistance = 0.25f;
  s.sceneFile = "caf\xff.glb";  // not UTF-8
  s.warnings = {"one"};
  const auto json = nlohmann::json::parse(dump(toJson(s)));
  for (const char* key : {"vendor", "renderer", "version", "context"}) EXPECT_TRUE(json["device"].contains(key)) << key;
  for (const char* key : {"file", "triangles", "materials"}) EXPECT_TRUE(json["scene"].contains(key)) << key;
  for (const char* key : {"voxels", "heads", "pool_reserved", "pool_used", "fragments", "fragments_stored",
                          "bytes_per_fragment", "structure_total", "gbuffer", "geometry", "textures", "shadow_maps",
                          "queues", "transient", "peak", "largest_buffer", "largest_buffer_name"})
    EXPECT_TRUE(json["memory"].contains(key)) << key;
  for (const std::string& stage : stageNames())
    for (const char* key : {"median", "min", "max", "runs"})
      EXPECT_TRUE(json["time_ms"][stage].contains(key)) << stage << ' ' << key;
  EXPECT_EQ(json["pixels"]["coverage"], 0.25);
  EXPECT_EQ(json["pixels"]["total"], 200);
  EXPECT_EQ(json["rays"]["min_distance"], 0.25);
  EXPECT_EQ(json["settings"]["voxels.resolution"], Settings{}.voxels.resolution);
  EXPECT_EQ(json["settings"]["select.mode"], "reflective");
  EXPECT_EQ(json["settings"]["abuffer.sorted"], false);
  EXPECT_EQ(json["settings"].size(), describe(Settings{}).size());
  EXPECT_EQ(json["overflow"], 0);
  EXPECT_EQ(json["warnings"], nlohmann::json::array({"one"}));
}

TEST(Arguments, Sizes) {
  EXPECT_EQ(parseSize("960x540").width, 960);
  EXPECT_EQ(parseSize("1x16384").height, 16384);
  for (const char* text : {"", "x", "960", "960x", "x540", "0x0", "-1x5", "99999x1", "1x16385", "9.5x3", "3x3x3",
                           " 3x3", "99999999999999999999x1"})
    EXPECT_THROW(parseSize(text), Error) << text;
}

TEST(Arguments, Vectors) {
  EXPECT_EQ(parseVector("--eye", "-1,2.5,3e2"), glm::dvec3(-1, 2.5, 300));
  for (const char* text : {"", "1", "1,2", "1,2,3,4", "1,,3", "a,b,c", "nan,0,0", "inf,0,0", "1,2,3 "})
    EXPECT_THROW(parseVector("--eye", text), Error) << text;
}

TEST(Arguments, Views) {
  const ViewArgument view = parseView("a=b.glb=-1,2.5,3e2,0,0,1");
  EXPECT_EQ(view.scene, "a=b.glb");
  EXPECT_EQ(view.eye, glm::dvec3(-1, 2.5, 300));
  EXPECT_EQ(view.target, glm::dvec3(0, 0, 1));
  EXPECT_FALSE(view.fov);
  EXPECT_EQ(parseView("s=0,0,0,0,0,1,60").fov, 60);
  for (const char* text : {"", "s", "s=", "=0,0,0,0,0,1", "0,0,0,0,0,1", "s=0,0,0,0,0", "s=0,0,0,0,0,1,60,1",
                           "s=0,0,0,0,0,x", "s=0,0,0,0,0,1,", "s=0,0,0,0,0,inf"})
    EXPECT_THROW(parseView(text), Error) << text;
}

TEST(Arguments, Lights) {
  const LightArgument directional = parseLight("directional:0,-2,0:3,2,1");
  EXPECT_EQ(directional.light.type, LightType::directional);
  EXPECT_EQ(directional.light.direction, glm::vec3(0, -1, 0));
  EXPECT_EQ(directional.light.color, glm::vec3(3, 2, 1));
  EXPECT_EQ(directional.light.intensity, 1);
  const LightArgument point = parseLight("point:1,2,-3e6:40,0,0");
  EXPECT_EQ(point.light.type, LightType::point);
  EXPECT_EQ(point.position, glm::dvec3(1, 2, -3e6));
  const LightArgument sphere = parseLight("sphere:1,2,3:0.25:1,1,1");
  EXPECT_EQ(sphere.light.type, LightType::sphere);
  EXPECT_EQ(sphere.light.radius, 0.25f);
  const LightArgument rectangle = parseLight("rectangle:1,2,3:0.5,0,0:0,0,2:5,6,7");
  EXPECT_EQ(rectangle.light.type, LightType::rectangle);
  EXPECT_EQ(rectangle.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(rectangle.light.direction, glm::vec3(0, -1, 0)) << "x cross z";
  EXPECT_EQ(rectangle.light.up, glm::vec3(0, 0, 1));
  EXPECT_EQ(rectangle.light.width, 1);
  EXPECT_EQ(rectangle.light.height, 4);
  EXPECT_EQ(rectangle.light.color, glm::vec3(5, 6, 7));
}

TEST(Arguments, LightsThatAreNoneSayWhatTheyTake) {
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {"", "known are directional, point, sphere, rectangle"},
           {"sun:0,0,0:1,1,1", "known are directional"},
           {"point", "point:X,Y,Z:R,G,B"},
           {"point:", "point:X,Y,Z:R,G,B"},
           {"point:0,0,0", "point:X,Y,Z:R,G,B"},
           {"point:0,0,0:1,1", "point:X,Y,Z:R,G,B"},
           {"point:0,0,0:1,1,1:1", "point:X,Y,Z:R,G,B"},
           {"point:0,0,0:1,1,x", "finite numbers"},
           {"point:0,0,nan:1,1,1", "finite numbers"},
           {"point:0,0,1e300:1,1,1", "finite numbers"},
           {"point:0,0,0:1,1,-1", "negative"},
           {"directional:0,0,0:1,1,1", "no direction"},
           {"sphere:0,0,0:0:1,1,1", "radius"},
           {"rectangle:0,0,0:1,0,0:1,1,1", "rectangle:X,Y,Z:UX,UY,UZ:VX,VY,VZ:R,G,B"},
           {"rectangle:0,0,0:1,0,0:1,1,0:1,1,1", "perpendicular"},
           {"rectangle:0,0,0:1,0,0:0,0,0:1,1,1", "longer than 0"}}) {
    try {
      parseLight(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

TEST(Arguments, LightsArePlacedInTheWorld) {
  Model model;
  model.scene.origin = {1e6, 0, 0};
  addLights(model, std::vector{parseLight("point:1000001,2,3:1,1,1")});
  ASSERT_EQ(model.scene.lights.size(), 1u);
  EXPECT_EQ(model.scene.lights[0].position, glm::vec3(1, 2, 3));
  EXPECT_EQ(model.rig.lightNodes, std::vector<int>{-1}) << "it follows no node";
}

TEST(Arguments, MirrorsAndSettings) {
  EXPECT_EQ(parseMirror("a=b=0.5").material, "a=b");
  EXPECT_FLOAT_EQ(parseMirror("*=1").reflectivity, 1.0f);
  for (const char* text : {"", "floor", "=1", "floor=", "floor=2", "floor=-0.1", "floor=nan", "floor=x"})
    EXPECT_THROW(parseMirror(text), Error) << text;
  EXPECT_EQ(parseSetting("a.b=c=d").value, "c=d");
  EXPECT_THROW(parseSetting("a.b"), Error);
  EXPECT_THROW(parseSetting("=1"), Error);
}

}  // namespace
}  // namespace halfsilver
