#include <array>
#include <optional>
#include <string>

#include "bench/modes/paper/published.h"

// K. Buerger, S. Hertel, J. Krueger and R. Westermann, "GPU ray tracing of secondary effects with layered depth cubes",
// 2007.
namespace halfsilver::bench {
namespace {

double traceOf(const PaperPoint& p) {
  return p.times.gbuffer.median + p.times.select.median + p.times.trace.median + p.times.shade.median +
         p.times.composite.median;
}

// Table 1, milliseconds: construction and tracing with the final image, at 512^2 and at 1024^2 texels.
struct Published {
  const char* scene;
  std::array<std::optional<double>, 2> construction, tracing;
};
constexpr std::array<Published, 2> kPublished = {{
    {"bunny", {std::nullopt, 19}, {61, 115}},
    {"dragon", {12, 31}, {205, 441}},
}};

PublishedTable timeTable(const PaperScenes& scenes, bool quick) {
  PublishedTable table{
      "Table 1",
      "Construction, and tracing with the final image",
      {milliseconds("construction", buildOf), milliseconds("tracing", traceOf), {"cube", "MB", structureOf}},
      {}};
  for (const Published& row : kPublished) {
    const std::size_t triangles = scenes.of(row.scene).model.scene.triangles.size(), first = table.rows.size();
    for (std::size_t i = 0; i < 2; ++i) {
      Settings settings = presetSettings("burger2007", quick, triangles);
      settings.abuffer.resolution = (i == 0 ? 512 : 1024) / (quick ? 4 : 1);
      PublishedRow published;
      published.label = std::string(row.scene) + (i == 0 ? ", 512 x 512" : ", 1024 x 1024");
      published.scene = row.scene;
      published.settings = settings;
      published.values = {row.construction[i], row.tracing[i]};
      published.base = first;
      published.picture = i == 1;
      table.rows.push_back(std::move(published));
    }
    PublishedRow ours;
    ours.label = std::string(row.scene) + ", halfsilver";
    ours.scene = row.scene;
    ours.settings = presetSettings(kDefaultPreset, quick, triangles);
    ours.base = first;
    table.rows.push_back(std::move(ours));
  }
  table.notes = {"The bunny's construction at 512 x 512 cannot be read in the paper's text.",
                 "Tracing: G-buffer, selection, rays, what they hit, and the blend.",
                 "Not measured for want of the models: car (20,264 triangles; 9 and 25 ms, 82 and 250), Max Planck "
                 "(300 K; 19 and 53, 160 and 346), the animated tiny (1,628; 5 and 16, 44 and 95)."};
  return table;
}

}  // namespace

Paper burger2007(const PaperScenes& scenes, bool quick) {
  return {.name = "burger2007",
          .citation =
              "K. Buerger, S. Hertel, J. Krueger and R. Westermann, GPU ray tracing of secondary effects with layered "
              "depth cubes, 2007",
          .machine = "Pentium 4, GeForce 8800 GTX",
          .size = {1280, 1024},
          .tables = {timeTable(scenes, quick)},
          .missing = {"The number of layers that each model needs (8, 12, 7, 6, 6): not reported here.",
                      "Figures 1, 2 and 10, with cube maps beside the method and a ray tracer: there is no cube-map "
                      "method here. Their frame rates: 3, 5 and 3 per second.",
                      "Rigid objects with cubes of their own (section 1.2): a move builds all of it again."}};
}

}  // namespace halfsilver::bench
