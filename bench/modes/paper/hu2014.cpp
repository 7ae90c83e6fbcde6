#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>

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
      "1 (b) and 35.6 / 79.6 / 2.9 / 109.1 ms for figure 8: 4.8 and 4.9 times as much. There is no octree "
      "here.",
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
      if (effect == Effect::reflection) wanted.trace.bounces = 1;
      const char* what = effect == Effect::whitted     ? "Whitted, "
                         : effect == Effect::occlusion ? "occlusion, a pass of 8, "
                                                       : "mirrors, ";
      table.rows.push_back({what + std::string(name), "teapot", wanted, {}, table.rows.size() / 3 * 3});
    }
  table.notes = {"The figure's frames per second are not in the paper's text."};
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
      .tables = {partsTable(rows), searchTable(rows), occlusionTable(rows), samplingTable(rows), pathTable(rows)},
      .missing = {"A sparse voxel octree (table 1) and voxels alone (figure 9): not built. Figure 9's frames per "
                  "second are not in the paper's text.",
                  "Ray casting through layers (figure 1 a): trace.effect=layers draws it; the paper has no time for "
                  "it.",
                  "1280^2 texels, the paper's size for all but figure 6: the preset's 1024^2 are used."}};
}

}  // namespace halfsilver::bench
