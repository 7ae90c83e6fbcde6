#include <string>

#include "bench/modes/paper/published.h"

// M. F. Kastrati and P. Goswami, "Selective Rasterized Ray-Traced Reflections on the GPU", 2017.
namespace halfsilver::bench {
namespace {

constexpr int kShares = 8;  // of figures 6 and 7; the mode `coverage` draws 32

struct Published {
  const char* scene;
  double three, single;       // table 1, MB
  double times[3][5];         // table 2: construction, deferred geometry, ray tracing, others, total
  double selective, without;  // table 3
};
constexpr Published kPublished[] = {
    {"sphere",
     182.37,
     65.46,
     {{1.26, 0.56, 0, 0.22, 2.04}, {13.15, 0.58, 100.14, 0.47, 114.35}, {13.17, 0.58, 13.09, 0.42, 27.27}},
     4.19,
     13.37},
    {"teapot",
     210.18,
     71.85,
     {{1.37, 0.55, 0, 0.22, 2.16}, {25.69, 0.6, 108.41, 0.49, 135.18}, {25.71, 0.6, 27.48, 0.44, 54.22}},
     2.49,
     25.1},
    {"Sponza",
     1079.55,
     380.74,
     {{7.02, 1.09, 0, 0.6, 8.7}, {483.4, 1.07, 2129.61, 3.65, 2617.73}, {482.87, 1.07, 383.49, 3.72, 871.14}},
     3.0,
     100},
};

double constructionOf(const PaperPoint& p) { return p.times.gbuffer.median + buildOf(p); }
double traceOf(const PaperPoint& p) { return p.times.trace.median; }
double shadeOf(const PaperPoint& p) { return p.times.shade.median; }
double othersOf(const PaperPoint& p) { return p.times.select.median + p.times.composite.median; }
double totalOf(const PaperPoint& p) { return constructionOf(p) + traceOf(p) + shadeOf(p) + othersOf(p); }
double aBufferOf(const PaperPoint& p) { return static_cast<double>(p.memory.heads + p.memory.poolReserved) / 1e6; }
template <std::size_t axis>
double storedOf(const PaperPoint& p) {
  return static_cast<double>(p.memory.fragmentsPerAxis[axis]) * p.memory.bytesPerFragment / 1e6;
}
double wastedOf(const PaperPoint& p) { return static_cast<double>(p.memory.poolReserved - p.memory.poolUsed) / 1e6; }
double perceptibleOf(const PaperPoint& p) {
  return p.error && p.error->yeeFailFraction ? 100 * *p.error->yeeFailFraction : kUnknown;
}
double coverageOf(const PaperPoint& p) { return 100 * p.pixels.coverage; }

Settings preset(const PaperScenes& scenes, const std::string& scene, bool quick, const std::string& name) {
  return presetSettings(name, quick, scenes.of(scene).model.scene.triangles.size());
}

PublishedTable memoryTable(const PaperScenes& scenes, bool quick) {
  PublishedTable table{"Table 1", "Memory of the A-buffers", {{"A-buffers", "MB", aBufferOf}}, {}};
  for (const Published& row : kPublished) {
    const std::size_t first = table.rows.size();
    const std::string scene = row.scene;
    Settings three = preset(scenes, scene, quick, "kastrati2017");
    const Settings single = three;
    three.attributes.buffers = Buffers::three;
    table.rows.push_back({scene + ", three A-buffers", scene, three, {row.three}});
    table.rows.push_back({scene + ", one A-buffer", scene, single, {row.single}, first});
    table.rows.push_back({scene + ", halfsilver", scene, preset(scenes, scene, quick, kDefaultPreset), {}, first});
  }
  table.notes = {
      "The paper's third is what a surface saves whose normal lies along a diagonal; a floor saves nothing. "
      "The mode `memory` has the whole account.",
      "halfsilver: heads and pool of its voxels' lists."};
  return table;
}

PublishedTable timeTable(const PaperScenes& scenes, bool quick) {
  PublishedTable table{
      "Table 2",
      "Time without reflections, with all pixels traced, and with the selected ones",
      {milliseconds("construction", constructionOf), milliseconds("deferred geometry", shadeOf),
       milliseconds("ray tracing", traceOf), milliseconds("others", othersOf), milliseconds("total", totalOf)},
      {}};
  for (const Published& row : kPublished) {
    const std::size_t full = table.rows.size() + 1;
    const std::string scene = row.scene;
    Settings settings = preset(scenes, scene, quick, "kastrati2017");
    settings.trace.stage = TraceStage::fragment;
    const SelectMode modes[] = {SelectMode::none, SelectMode::all, SelectMode::reflective};
    const char* names[] = {", no reflections", ", full", ", selective"};
    for (std::size_t i = 0; i < 3; ++i) {
      settings.select.mode = modes[i];
      if (modes[i] == SelectMode::none) settings.trace.method = "none";
      const auto& times = row.times[i];
      table.rows.push_back({scene + names[i], scene, settings, {times, times + 5}, full, i == 2});
      settings.trace.method = "attributes";
    }
    for (const SelectMode mode : {SelectMode::all, SelectMode::reflective}) {
      Settings ours = preset(scenes, scene, quick, kDefaultPreset);
      ours.select.mode = mode;
      table.rows.push_back(
          {scene + ", halfsilver" + (mode == SelectMode::all ? ", full" : ", selective"), scene, ours, {}, full});
    }
  }
  table.notes = {
      "Every frame rebuilds its structure, as the paper's do; rays are traced in fragment shaders.",
      "Construction: G-buffer, voxels and A-buffer. Deferred geometry: here the lights of pixels and of hits, with "
      "shadow maps and sky light, which the paper does not have. Others: selection and blending.",
      "Table 3, selective against full: the paper has 4.19, 2.49 and 3.0 for sphere, teapot and Sponza, and 13.37, "
      "25.1 "
      "and 100 for no reflections against selective; here it is 1 / the ratio of the rows' totals.",
      "Full is this structure with all pixels traced, not three A-buffers: the paper's construction times say so."};
  return table;
}

PublishedTable axesTable(const PaperScenes& scenes, bool quick) {
  PublishedTable table{
      "Figure 5",
      "Memory of the A-buffer of each axis",
      {{"x", "MB", storedOf<0>}, {"y", "MB", storedOf<1>}, {"z", "MB", storedOf<2>}, {"wasted", "MB", wastedOf}},
      {}};
  for (const Published& row : kPublished)
    table.rows.push_back({row.scene, row.scene, preset(scenes, row.scene, quick, "kastrati2017")});
  table.notes = {"The figure's numbers are not in the paper's text."};
  return table;
}

PublishedTable coverageTable(const PaperScenes& scenes, bool quick) {
  PublishedTable table{"Figures 6 and 7",
                       "Ray tracing over the share of the screen that is traced",
                       {{"of the screen", "%", coverageOf}, milliseconds("ray tracing", traceOf)},
                       {}};
  for (const Published& row : kPublished) {
    const std::size_t whole = table.rows.size();
    for (int share = kShares; share > 0; --share) {
      Settings settings = preset(scenes, row.scene, quick, "kastrati2017");
      settings.trace.stage = TraceStage::fragment;
      settings.select.mode = SelectMode::all;
      settings.select.pattern = SelectPattern::region;
      settings.select.fraction = static_cast<float>(share) / kShares;
      table.rows.push_back({std::string(row.scene) + ", " + std::to_string(share) + " / " + std::to_string(kShares),
                            row.scene,
                            settings,
                            {},
                            whole});
    }
  }
  table.notes = {
      "The figures' numbers are not in the paper's text. It reports straight lines, and for Sponza a jump "
      "between 34.375 and 37.5 % of the screen. The mode `coverage` fits lines and looks for jumps."};
  return table;
}

PublishedTable qualityTable(const PaperScenes& scenes, bool quick) {
  PublishedTable table{"Figure 8", "Pixels that differ perceptibly", {{"perceptible", "%", perceptibleOf}}, {}};
  table.rows.push_back({"Sponza, selective", "Sponza", preset(scenes, "Sponza", quick, "kastrati2017"), {0.55}});
  table.rows.push_back({"Sponza, halfsilver", "Sponza", preset(scenes, "Sponza", quick, kDefaultPreset)});
  table.notes = {
      "The paper compares with another renderer (Maya), which also differs in shading; here the shading is "
      "the same and the rays are exact."};
  return table;
}

}  // namespace

Paper kastrati2017(const PaperScenes& scenes, bool quick) {
  return {.name = "kastrati2017",
          .citation = "M. F. Kastrati and P. Goswami, Selective Rasterized Ray-Traced Reflections on the GPU, 2017",
          .machine = "Xeon E5-1650, Quadro K4000",
          .size = {1920, 1080},
          .tables = {memoryTable(scenes, quick), timeTable(scenes, quick), axesTable(scenes, quick),
                     coverageTable(scenes, quick), qualityTable(scenes, quick)},
          .missing = {"Lights without shadows and Wolff's shading (section 3.2.2): the shading is that of all methods "
                      "here, so that only rays differ.",
                      "An offline renderer's picture (figure 8 a)."}};
}

}  // namespace halfsilver::bench
