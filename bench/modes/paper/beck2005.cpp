#include <cstdint>
#include <optional>
#include <string>

#include "bench/modes/paper/published.h"

// S. Beck, A.-C. Bernstein, D. Danch and B. Froehlich, "CPU-GPU hybrid real time ray tracing framework", 2005.
namespace halfsilver::bench {
namespace {

constexpr int kShares = 4;  // of figure 6

double mapOf(const PaperPoint& p) { return p.times.shadow.median; }
double idsOf(const PaperPoint& p) { return p.times.gbuffer.median; }
double raysOf(const PaperPoint& p) { return p.times.select.median + p.times.build.median + p.times.trace.median; }
double shadingOf(const PaperPoint& p) { return p.times.shade.median + p.times.composite.median; }
double coverageOf(const PaperPoint& p) { return 100 * p.pixels.coverage; }
double shadowRaysOf(const PaperPoint& p) { return static_cast<double>(p.shadowRays) / 1000; }

double shareOf(const PaperPoint& p, std::uint64_t ShadowDoubts::*count) {
  if (!p.shadows || p.shadows->pixels == 0) return kUnknown;
  return 100 * static_cast<double>((*p.shadows).*count) / static_cast<double>(p.shadows->pixels);
}
double markedOf(const PaperPoint& p) { return shareOf(p, &ShadowDoubts::marked); }
double wrongMarkedOf(const PaperPoint& p) { return shareOf(p, &ShadowDoubts::wrongMarked); }
double wrongUnmarkedOf(const PaperPoint& p) { return shareOf(p, &ShadowDoubts::wrongUnmarked); }

Settings preset() {
  Settings settings;
  applyPreset(settings, "beck2005");
  return settings;
}

Settings byRays(Settings settings) {
  settings.shadow.method = ShadowMethod::rays;
  return settings;
}

PublishedTable sceneTable() {
  PublishedTable table{
      "Figure 5", "The test scene", {{"frames", "1/s", framesOf}, {"reflecting", "%", coverageOf}}, {}};
  table.rows.push_back({"Sponza, one sun", "Sponza, one sun", preset(), {8, 10}, {}, true, byRays(preset())});
  Settings clear = preset();
  clear.trace.effect = Effect::whitted;
  clear.select.mode = SelectMode::all;
  table.rows.push_back({"glass, refraction too", "glass", clear, {}, {}, true, byRays(clear)});
  table.notes = {"The paper's scene has about 500,000 triangles.",
                 "Refraction comes with the effect whitted, whose rays start at all pixels."};
  return table;
}

PublishedTable passTable() {
  PublishedTable table{"Figure 6",
                       "Times of the passes over the share of the screen that reflects",
                       {{"reflecting", "%", coverageOf},
                        milliseconds("1, shadow map", mapOf),
                        milliseconds("2, triangles", idsOf),
                        milliseconds("4, rays on the CPU", raysOf),
                        milliseconds("3 and 5, marks and shading", shadingOf)},
                       {}};
  for (int share = 0; share <= kShares; ++share) {
    Settings settings = preset();
    settings.select.mode = SelectMode::all;
    settings.select.pattern = SelectPattern::region;
    settings.select.fraction = static_cast<float>(share) / kShares;
    table.rows.push_back({"Sponza, one sun, " + std::to_string(share) + " / " + std::to_string(kShares),
                          "Sponza, one sun",
                          settings,
                          {},
                          1,
                          false,
                          byRays(settings)});
  }
  table.notes = {
      "The figure's numbers are not in the paper's text. It reports that the CPU's pass grows faster than "
      "linearly and that the GPU's stay small.",
      "The time of the rays includes the read-back, which has no bar of its own here."};
  return table;
}

PublishedTable shadowTable() {
  PublishedTable table{"Figures 8 and 9",
                       "Edges of shadows, refined by rays, per kernel",
                       {{"frames", "1/s", framesOf},
                        {"marked pixels", "%", markedOf},
                        {"wrong, marked", "%", wrongMarkedOf},
                        {"wrong, unmarked", "%", wrongUnmarkedOf},
                        {"shadow rays", "thousands", shadowRaysOf}},
                       {}};
  for (const char* name : {"sphere", "teapot", "Sponza"}) {
    const std::string scene = std::string(name) + ", one sun";
    const std::size_t everywhere = table.rows.size();
    const bool papers = name == std::string("Sponza");
    Settings settings = preset();
    settings.select.mode = SelectMode::none;  // shadows alone
    table.rows.push_back({scene + ", rays everywhere", scene, byRays(settings)});
    Settings maps = settings;
    maps.shadow.method = ShadowMethod::maps;
    table.rows.push_back({scene + ", maps alone",
                          scene,
                          maps,
                          {papers ? std::optional(7.0) : std::nullopt},
                          everywhere,
                          papers,
                          byRays(settings)});
    maps.shadow.projection = ShadowProjection::uniform;
    table.rows.push_back({scene + ", uniform maps alone", scene, maps, {}, everywhere, false, byRays(settings)});
    Settings uniform = settings;
    uniform.shadow.projection = ShadowProjection::uniform;
    table.rows.push_back({scene + ", uniform, 5 x 5", scene, uniform, {}, everywhere, false, byRays(settings)});
    for (const int kernel : {3, 5, 7, 9}) {
      settings.shadow.kernel = kernel;
      const bool figure9 = papers && kernel == 5;
      table.rows.push_back({scene + ", " + std::to_string(kernel) + " x " + std::to_string(kernel),
                            scene,
                            settings,
                            {figure9 ? std::optional(6.0) : std::nullopt},
                            everywhere,
                            figure9,
                            byRays(settings)});
    }
  }
  table.notes = {
      "Shares of the pixels that show a surface. Wrong: the light differs by more than a thousandth from "
      "that of rays everywhere.",
      "Maps are in light-space perspective, as in the paper, but for the rows that say uniform.",
      "The paper: 7 frames per second without and 6 with a kernel of 5 x 5, on 500,000 triangles."};
  return table;
}

}  // namespace

Paper beck2005(const PaperScenes&, bool) {
  return {
      .name = "beck2005",
      .citation =
          "S. Beck, A.-C. Bernstein, D. Danch and B. Froehlich, CPU-GPU Hybrid Real Time Ray Tracing "
          "Framework, 2005",
      .machine = "dual Xeon 3.2 GHz, Quadro FX 3400",
      .size = {1024, 768},
      .tables = {sceneTable(), passTable(), shadowTable()},
      .missing = {"Frame times over threads (figure 7): the numbers are not in the paper's text; render --threads N "
                  "and --repeat measure them. It reports that two threads halve the time of one on the dual "
                  "Xeon and that four are best.",
                  "The read-back of figure 6 as a time of its own: it is part of the rays'.",
                  "At least 10 % less time by SIMD (section 5.4): Embree's SIMD cannot be turned off.",
                  "The other machine of section 4 (Athlon XP 2800+, GeForce 6600 GT): only figure 7 has it."}};
}

}  // namespace halfsilver::bench
