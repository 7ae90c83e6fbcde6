#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/modes/paper/published.h"

// W. Hu, Y. Huang, F. Zhang, G. Yuan and W. Li, "Ray tracing via GPU rasterization", 2014.
namespace halfsilver::bench {
namespace {

double tracingOf(const PaperPoint& p) { return p.times.trace.median + p.times.shade.median; }
double othersOf(const PaperPoint& p) {
  return p.times.gbuffer.median + p.times.select.median + p.times.composite.median;
}
double totalOf(const PaperPoint& p) { return buildOf(p) + tracingOf(p) + othersOf(p); }
double framesOf(const PaperPoint& p) { return 1000 / std::max(totalOf(p), 1e-6); }
double rmseOf(const PaperPoint& p) { return p.error ? p.error->rmse : kUnknown; }
double wrongOf(const PaperPoint& p) { return p.error ? 100 * p.error->hitError : kUnknown; }
double missedOf(const PaperPoint& p) { return p.error ? 100 * p.error->falseMiss : kUnknown; }
double traceOf(const PaperPoint& p) { return p.times.trace.median; }
double perSampleOf(const PaperPoint& p) {
  return tracingOf(p) / (p.settings.effect.samples * p.settings.effect.passes);
}
// Of a picture of `samples` per pixel: the passes that were drawn, as often as it has them.
template <int samples>
double pictureOf(const PaperPoint& p) {
  return buildOf(p) + othersOf(p) + samples * perSampleOf(p);
}

class Rows {
 public:
  Rows(const PaperScenes& scenes, bool quick) : scenes_(&scenes), quick_(quick) {}

  Settings settings(const std::string& scene, const std::string& preset, Effect effect) const {
    Settings settings;
    if (preset == kReference)
      applyPreset(settings, preset);
    else
      settings = presetSettings(preset, quick_, scenes_->of(scene).model.scene.triangles.size());
    settings.select.mode = SelectMode::all;
    settings.trace.effect = effect;
    settings.trace.bounces = 3;
    return settings;
  }

  // A row of the paper's method, then the default and exact rays beside it.
  void add(PublishedTable& table, const std::string& label, const std::string& scene, Effect effect,
           std::vector<std::optional<double>> values, const std::function<void(Settings&)>& change = {}) const {
    const std::size_t first = table.rows.size();
    for (const char* preset : {"hu2014", kDefaultPreset, kReference}) {
      Settings wanted = settings(scene, preset, effect);
      if (change) change(wanted);
      const bool theirs = preset == std::string("hu2014");
      table.rows.push_back({theirs ? label : label + ", " + preset, scene, wanted, theirs ? values : decltype(values)(),
                            theirs ? std::nullopt : std::optional(first), preset == std::string(kDefaultPreset)});
    }
  }

  bool quick() const { return quick_; }

 private:
  const PaperScenes* scenes_;
  bool quick_;
};

const std::vector<Quantity>& parts() {
  static const std::vector<Quantity> all = {milliseconds("construction", buildOf),
                                            milliseconds("tracing", tracingOf),
                                            milliseconds("others", othersOf),
                                            milliseconds("total", totalOf),
                                            {"RMSE", "", rmseOf}};
  return all;
}

PublishedTable partsTable(const Rows& rows) {
  PublishedTable table{"Table 1", "Whitted rays of depth 3", parts(), {}};
  rows.add(table, "Figure 1 (b)", "glass", Effect::whitted, {13.2, 11.6, 2.7, 27.5});
  rows.add(table, "Figure 8, top", "teapot", Effect::whitted, {10.8, 8.7, 2.6, 22.1});
  rows.add(table, "Figure 8, two point lights", "teapot, two lamps", Effect::whitted, {});
  table.notes = {
      "Tracing: rays with what they find, as in the paper's one shader.",
      "The paper's other row, a sparse voxel octree of ten levels, took 42.8 / 84.6 / 3.8 / 131.2 ms for figure "
      "1 (b) and 35.6 / 79.6 / 2.9 / 109.1 ms for figure 8: 4.8 and 4.9 times as much, 7.3 and 9.1 times in tracing.",
      "RMSE: of linear radiance against the same rays traced exactly."};
  return table;
}

PublishedTable searchTable(const Rows& rows) {
  PublishedTable table{"Figure 6",
                       "Three ways to search a voxel",
                       {{"frames", "1/s", framesOf}, {"RMSE", "", rmseOf}, {"wrong mirror rays", "%", wrongOf}},
                       {}};
  for (const Effect effect : {Effect::whitted, Effect::occlusion, Effect::reflection})
    for (const auto& [steps, name] :
         std::array{std::pair(1, "1 step"), std::pair(3, "3 steps"), std::pair(0, "2D-DDA")}) {
      Settings wanted = rows.settings("teapot", "hu2014", effect);
      wanted.attributes.steps = steps;
      wanted.abuffer.resolution = std::min(wanted.abuffer.resolution, 1024);
      if (effect == Effect::reflection) wanted.trace.bounces = 1;
      const char* what = effect == Effect::whitted     ? "Whitted, "
                         : effect == Effect::occlusion ? "occlusion, a pass of 8, "
                                                       : "mirrors, ";
      table.rows.push_back({what + std::string(name), "teapot", wanted, {}, table.rows.size() / 3 * 3});
    }
  table.notes = {
      "The figure's frames per second are not in the paper's text. It has 1024^2 texels, all others 1280^2."};
  return table;
}

// Mirror rays of the scene, whose hits are compared one by one.
Settings mirrors(const Rows& rows, const std::string& scene) {
  Settings settings = rows.settings(scene, "hu2014", Effect::reflection);
  settings.select.mode = SelectMode::reflective;
  settings.trace.bounces = 1;
  return settings;
}

const std::vector<Quantity>& hits() {
  static const std::vector<Quantity> all = {{"wrong mirror rays", "%", wrongOf},
                                            {"missed", "%", missedOf},
                                            {"structure", "MB", structureOf},
                                            milliseconds("construction", buildOf),
                                            milliseconds("trace", traceOf)};
  return all;
}

PublishedTable insideTable(const Rows& rows) {
  PublishedTable table{"Section 3.2", "What is inside: depths alone, or the nearest fragment's plane", hits(), {}};
  for (const char* scene : {"sphere", "teapot", "Sponza"})
    for (const InsideTest test : {InsideTest::depth, InsideTest::plane}) {
      Settings wanted = mirrors(rows, scene);
      wanted.attributes.test = test;
      table.rows.push_back({scene + std::string(test == InsideTest::depth ? ", depths" : ", planes"),
                            scene,
                            wanted,
                            {},
                            table.rows.size() / 2 * 2});
    }
  table.notes = {
      "The paper decides by depths and names watertight objects as its limit: sheets and open objects are where depths "
      "are wrong. Planes are what this program has for Kastrati & Goswami 2017.",
      "The paper searches the way out of glass for the first point outside. Here a change in either direction is a "
      "surface, which is the same without a flag, and finds open floors, too."};
  return table;
}

PublishedTable gridTable(const Rows& rows) {
  PublishedTable table{"Section 5", "How many voxels for how many texels: sqrt(3 n)", hits(), {}};
  for (const int texels : rows.quick() ? std::vector{128, 256} : std::vector{512, 1024, 1280}) {
    Settings wanted = mirrors(rows, "teapot");
    wanted.abuffer.resolution = texels;
    const int rule = resolutionOf({.resolution = 0}, wanted.abuffer);
    const std::size_t first = table.rows.size();
    for (const int voxels : {rule, rule / 2, 2 * rule, 4 * rule}) {
      wanted.voxels.resolution = voxels == rule ? 0 : voxels;
      const std::string name = std::to_string(texels) + "^2 texels, " + std::to_string(voxels) + "^3 voxels";
      table.rows.push_back({name + (voxels == rule ? " (the rule)" : ""), "teapot", wanted, {}, first});
    }
  }
  table.notes = {"The rule is voxels.resolution=auto; the preset has the paper's 64^3 for 1280^2 texels."};
  return table;
}

PublishedTable anyHitTable(const Rows& rows) {
  PublishedTable table{"Section 3.2, rays that need no exact hit",
                       "Occlusion without the binary search",
                       {milliseconds("trace", traceOf), {"RMSE", "", rmseOf}},
                       {}};
  for (const int refinements : {0, 6, 0, 6}) {
    Settings wanted = rows.settings("teapot", "hu2014", Effect::occlusion);
    wanted.attributes.anyHitRefinements = refinements;
    const std::string label =
        std::string(refinements == 0 ? "no binary search" : "with it") + (table.rows.size() > 1 ? ", again" : "");
    table.rows.push_back({label, "teapot", wanted, {}, 1});
  }
  table.notes = {
      "Rays to lights do without it, too, where they have a queue of their own (shadow.method=rays). Those of "
      "Whitted's rays and of paths travel with the others and are searched like these."};
  return table;
}

PublishedTable voxelsTable(const Rows& rows) {
  PublishedTable table{"Figure 9",
                       "Ambient occlusion by this structure and by voxels alone",
                       {{"frames", "1/s", framesOf}, {"RMSE", "", rmseOf}, {"structure", "MB", structureOf}},
                       {}};
  table.rows.push_back({"this structure", "teapot", rows.settings("teapot", "hu2014", Effect::occlusion), {}, 0, true});
  for (const int voxels : rows.quick() ? std::vector{32, 64} : std::vector{64, 128, 256}) {
    Settings wanted = rows.settings("teapot", "voxels", Effect::occlusion);
    wanted.voxels.resolution = voxels;
    table.rows.push_back({"voxels, " + std::to_string(voxels) + "^3", "teapot", wanted, {}, 0, voxels == 64});
  }
  table.notes = {
      "One pass of 8 rays per pixel each. Sizes and frames per second of the figure are not in the paper's text; it "
      "says "
      "that voxels would need 1280^3 of them, and 64 rays, for the same result. At 12 bytes that is 25 GB."};
  return table;
}

PublishedTable occlusionTable(const Rows& rows) {
  PublishedTable table{"Figures 1 (c) and 7",
                       "Ambient occlusion, 8 rays per pixel and pass",
                       {milliseconds("per sampling ray", perSampleOf), {"RMSE", "", rmseOf}},
                       {}};
  for (const int passes : {1, 4})
    rows.add(table, std::to_string(passes) + (passes == 1 ? " pass" : " passes"), "teapot", Effect::occlusion,
             {passes == 1 ? std::optional(0.75) : std::nullopt},
             [passes](Settings& settings) { settings.effect.passes = passes; });
  table.notes = {
      "A sampling ray: one for each pixel. The paper's pictures have 128 of them, 16 passes; structure not "
      "counted."};
  return table;
}

PublishedTable samplingTable(const Rows& rows) {
  PublishedTable table{"Figure 10",
                       "1,024 rays per pixel: environment and area light",
                       {milliseconds("1,024 rays", pictureOf<1024>), {"RMSE of a pass", "", rmseOf}},
                       {}};
  const auto once = [](Settings& settings) {
    settings.trace.bounces = 1;
    settings.effect.samples = 8;
  };
  rows.add(table, "Environment", "teapot, environment", Effect::path, {1389.0}, once);
  rows.add(table, "Area light", "teapot, area light", Effect::path, {820.0}, once);
  table.notes = {"One pass of 8 is drawn; the time is that of the structure and 128 such passes.",
                 "The paper samples Ward's BRDF; here it is GGX."};
  return table;
}

PublishedTable pathTable(const Rows& rows) {
  PublishedTable table{"Figures 1 (d) and 11",
                       "Two-bounce path tracing, 384 rays per pixel",
                       {milliseconds("384 rays", pictureOf<384>), {"RMSE of a pass", "", rmseOf}},
                       {}};
  const auto twice = [](Settings& settings) {
    settings.trace.bounces = 2;
    settings.effect.samples = 3;
  };
  rows.add(table, "Sponza, area light", "Sponza, area light", Effect::path, {5110.0}, twice);
  table.notes = {
      "One pass of 3 is drawn; the time is that of the structure and 128 such passes. The paper has two "
      "views, 5110 and 4030 ms, and 256^3 voxels."};
  return table;
}

}  // namespace

Paper hu2014(const PaperScenes& scenes, bool quick) {
  const Rows rows(scenes, quick);
  return {
      .name = "hu2014",
      .citation = "W. Hu, Y. Huang, F. Zhang, G. Yuan and W. Li, Ray Tracing via GPU Rasterization, 2014",
      .machine = "Xeon E5-1620, GeForce GTX 780",
      .size = {800, 600},
      .tables = {partsTable(rows), insideTable(rows), anyHitTable(rows), searchTable(rows), gridTable(rows),
                 occlusionTable(rows), voxelsTable(rows), samplingTable(rows), pathTable(rows)},
      .missing = {
          "A sparse voxel octree (table 1): not built. Its leaves, ten levels down, are the occupied cells of a "
          "1024^3 grid, so rays would hit them as they hit voxels (figure 9), early by up to a leaf; the octree "
          "leaves out the empty cells. How much longer it takes, the paper measures on its own GPU: sorting "
          "fragments into nodes in every frame, and a descent of ten levels per step.",
          "Entries of the paper's size: position, depth, normal and material would take 44 bytes; here the position "
          "follows from texel and depth, and an entry takes 32.",
          "Ray casting through layers (figure 1 a): trace.effect=layers draws it; the paper has no time for "
          "it."}};
}

}  // namespace halfsilver::bench
