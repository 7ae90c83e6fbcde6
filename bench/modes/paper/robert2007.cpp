#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "bench/modes/paper/published.h"

// P. C. D. Robert, S. Schoepke and H. Bieri, "Hybrid ray tracing: ray tracing using GPU-accelerated image-space
// methods", 2007.
namespace halfsilver::bench {
namespace {

double bufferOf(const PaperPoint& p) { return p.times.gbuffer.median; }
double castsOf(const PaperPoint& p) { return 1000 / std::max(p.times.frame.median - p.times.shadow.median, 1e-6); }
double ofPixels(const PaperPoint& p, std::uint64_t count) {
  return p.pixels.total ? 100 * static_cast<double>(count) / static_cast<double>(p.pixels.total) : kUnknown;
}
double resampledOf(const PaperPoint& p) { return ofPixels(p, p.resampled); }
double interpolatedOf(const PaperPoint& p) { return ofPixels(p, p.interpolated); }
double directOf(const PaperPoint& p) { return ofPixels(p, p.pixels.total - p.resampled - p.interpolated); }
double wrongOf(const PaperPoint& p) { return p.error ? 100 * p.error->hitError : kUnknown; }

struct Published {
  const char* name;   // the paper's
  const char* scene;  // of paperScenes()
  double gpu[4];      // table 2: with tests, and with shadows; direct, and with shadows
  double buffer[6];   // table 3: plain, interleaved, lazy 3 x 3 and 5 x 5, full 3 x 3 and 5 x 5
  double hybrid[4];   // table 4: with tests, interleaved; direct, interleaved
};
constexpr std::array<Published, 3> kPublished = {{
    {"torus", "sphere", {112, 105, 165, 129}, {8.0, 10.2, 7.6, 7.5, 4.8, 3.3}, {1.6, 2.7, 1.6, 2.8}},
    {"bunny", "bunny", {36, 35, 47, 46}, {8.5, 10.0, 5.5, 4.3, 3.7, 2.2}, {1.0, 1.6, 1.0, 1.7}},
    {"robots", "robots", {18, 2.4, 18, 2.4}, {3.0, 4.3, 2.9, 2.8, 2.3, 1.9}, {0.1, 0.2, 0.1, 0.2}},
}};

Settings preset() {
  Settings settings;
  applyPreset(settings, "robert2007");
  return settings;
}

// Ray casting: camera rays alone.
Settings casting(PrimaryHits hits) {
  Settings settings = preset();
  settings.primary.hits = hits;
  settings.primary.multisampling = Multisampling::none;
  settings.select.mode = SelectMode::none;
  return settings;
}

// With the triangles of rasterization, all of them, and exact rays.
Settings truthOf(Settings settings) {
  settings.primary = {};
  return settings;
}

PublishedTable castingTable() {
  PublishedTable table{"Table 2",
                       "Ray casting on the GPU",
                       {{"frames without the shadow map", "1/s", castsOf},
                        {"frames with it", "1/s", framesOf},
                        milliseconds("buffer", bufferOf)},
                       {}};
  for (const Published& scene : kPublished) {
    const std::size_t first = table.rows.size();
    for (const PrimaryHits hits : {PrimaryHits::tested, PrimaryHits::raster}) {
      const bool direct = hits == PrimaryHits::raster;
      const double* values = scene.gpu + (direct ? 2 : 0);
      table.rows.push_back({std::string(scene.name) + (direct ? ", direct" : ", tested"),
                            scene.scene,
                            casting(hits),
                            {values[0], values[1]},
                            direct ? std::optional(first) : std::nullopt,
                            false,
                            truthOf(casting(hits))});
    }
  }
  table.notes = {
      "The paper's casters on the CPU, frames per second of torus, bunny and robots: with a kd-tree 1.7, 1.3 "
      "and 0.2, with the buffer 8.0, 8.5 and 3.0, and with shadows 6.9, 7.5 and 1.4. Here all pixels are "
      "shaded on the GPU.",
      "Buffer: the paper has 3 to 15 ms; here rasterization, tests and materials."};
  return table;
}

PublishedTable samplingTable() {
  PublishedTable table{"Table 3",
                       "Multisampling of the buffer",
                       {{"frames", "1/s", castsOf},
                        milliseconds("buffer", bufferOf),
                        {"own triangle", "%", directOf},
                        {"a neighbor's", "%", resampledOf},
                        {"interpolated", "%", interpolatedOf}},
                       {}};
  struct Way {
    const char* name;
    Multisampling multisampling;
    int neighborhood, every;
  };
  constexpr std::array<Way, 6> kWays = {{{"plain", Multisampling::none, 3, 1},
                                         {"interleaved", Multisampling::none, 3, 2},
                                         {"lazy 3 x 3", Multisampling::lazy, 3, 1},
                                         {"lazy 5 x 5", Multisampling::lazy, 5, 1},
                                         {"full 3 x 3", Multisampling::full, 3, 1},
                                         {"full 5 x 5", Multisampling::full, 5, 1}}};
  for (const Published& scene : kPublished) {
    const std::size_t first = table.rows.size();
    for (std::size_t i = 0; i < kWays.size(); ++i) {
      Settings settings = casting(PrimaryHits::tested);
      settings.primary.multisampling = kWays[i].multisampling;
      settings.primary.neighborhood = kWays[i].neighborhood;
      settings.primary.every = kWays[i].every;
      table.rows.push_back({std::string(scene.name) + ", " + kWays[i].name,
                            scene.scene,
                            settings,
                            {scene.buffer[i]},
                            i > 0 ? std::optional(first) : std::nullopt,
                            i == 1 || i == 2,
                            truthOf(settings)});
    }
  }
  table.notes = {
      "The paper's frames are those of its caster on the CPU, without shadows; those here are of the GPU, "
      "without the time of the shadow map.",
      "The paper does not say which pixels interleaving leaves out; here it is every second one."};
  return table;
}

PublishedTable tracingTable() {
  PublishedTable table{"Table 4",
                       "Ray tracing of depth 3, secondary rays on the CPU",
                       {{"frames", "1/s", framesOf}, {"wrong rays", "%", wrongOf}},
                       {}};
  for (const Published& scene : kPublished) {
    const std::size_t first = table.rows.size();
    std::size_t column = 0;
    for (const PrimaryHits hits : {PrimaryHits::tested, PrimaryHits::raster})
      for (const int every : {1, 2}) {
        Settings settings = preset();
        settings.primary.hits = hits;
        settings.primary.every = every;
        const std::string name = hits == PrimaryHits::raster ? ", hybrid, direct" : ", hybrid";
        table.rows.push_back({scene.name + name + (every > 1 ? ", interleaved" : ""),
                              scene.scene,
                              settings,
                              {scene.hybrid[column]},
                              column > 0 ? std::optional(first) : std::nullopt,
                              column == 0,
                              truthOf(settings)});
        ++column;
      }
    Settings clear = preset();
    clear.trace.effect = Effect::whitted;
    clear.select.mode = SelectMode::all;
    table.rows.push_back(
        {scene.name + std::string(", hybrid, with refraction"), scene.scene, clear, {}, first, false, truthOf(clear)});
  }
  table.notes = {
      "The paper's ray tracer without the buffer: 0.9, 0.6 and 0.1 frames per second of torus, bunny and "
      "robots, interleaved 1.6, 1.1 and 0.1. There is none here: camera rays are never traced.",
      "Wrong rays: pixels that interleaving leaves out have none, and count.",
      "Frames follow each other here; one frame ahead the CPU traces beside the GPU (tests hold both to the "
      "same pictures)."};
  return table;
}

}  // namespace

Paper robert2007(const PaperScenes&, bool) {
  return {
      .name = "robert2007",
      .citation =
          "P. C. D. Robert, S. Schoepke and H. Bieri, Hybrid Ray Tracing: Ray Tracing Using "
          "GPU-Accelerated Image-Space Methods, 2007",
      .machine = "Athlon64 3500+, GeForce 7800 GT",
      .size = {800, 600},
      .tables = {castingTable(), samplingTable(), tracingTable()},
      .missing = {"Shading on the CPU (section 3.1), with its asynchronous read-back of the buffer: pixels are "
                  "shaded on the GPU.",
                  "40 frames of the moving robots (figure 6), between 0.5 and 3 frames per second: frames here stand "
                  "still. The numbers are not in the paper's text.",
                  "The 2 to 2.5 s that the kd-tree of the moving robots takes.",
                  "Torus, bunny and robots themselves (1,024, 69,451 and 71,708 triangles)."}};
}

}  // namespace halfsilver::bench
