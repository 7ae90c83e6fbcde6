#include "bench/memory_report.h"

#include <array>
#include <cstdint>

#include "bench/page.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

// Kastrati & Goswami 2017, table 1: A-buffer memory in MB, Hu et al.'s method and theirs, in their program.
struct PaperRow {
  const char* scene;
  double three, single;
};
constexpr std::array<PaperRow, 3> kPaper{
    {{"sphere", 182.37, 65.46}, {"teapot", 210.18, 71.85}, {"Sponza", 1079.55, 380.74}}};

double wasted(const Json& point) { return memory(point, "pool_reserved") - memory(point, "pool_used"); }
double aBuffer(const Json& point) { return memory(point, "heads") + memory(point, "pool_reserved"); }
// Of methods without a grid (Embree's tree) and what no other name fits.
double other(const Json& point) { return memory(point, "structure_total") - memory(point, "voxels") - aBuffer(point); }

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

std::string share(double part, double whole) { return whole > 0 ? percent(part / whole) : ""; }

const Json* find(const PointList& points, const std::string& scene, const std::string& preset) {
  for (const Json& point : points)
    if (sceneOf(point) == scene && presetOf(point) == preset) return &point;
  return nullptr;
}

double structureOf(const PointList& points, const std::string& scene, const std::string& preset) {
  const Json* point = find(points, scene, preset);
  return point ? memory(*point, "structure_total") : 0;
}

std::string wrongHits(const Json& point) {
  return point["error"].is_null() ? "" : percent(point["error"]["hit_error"].get<double>(), 2);
}

std::string cells(const Json& point) {
  const Json& grid = point["memory"]["grid"];
  if (grid[0] == 0) return "";
  std::string text = grid[0].dump() + " x " + grid[1].dump() + " x " + grid[2].dump();
  if (point["settings"]["trace.method"] == "attributes") text += ", " + point["settings"]["abuffer.resolution"].dump();
  return text;
}

Table memoryTable(const PointList& points) {
  Table table{{"Scene", "Method", "Voxels, texels", "Structure", "of hu2014", "of kastrati2017", "Voxel grid",
               "List heads", "Pool used", "Pool wasted", "wasted share", "G-buffer", "Peak", "Wrong hits"},
              {}};
  for (const Json& point : points) {
    const std::string scene = sceneOf(point);
    const double total = memory(point, "structure_total");
    table.rows.push_back({scene, presetOf(point), cells(point), megabytes(total),
                          share(total, structureOf(points, scene, "hu2014 all")),
                          share(total, structureOf(points, scene, "kastrati2017")), megabytes(memory(point, "voxels")),
                          megabytes(memory(point, "heads")), megabytes(memory(point, "pool_used")),
                          megabytes(wasted(point)), share(wasted(point), memory(point, "pool_reserved")),
                          megabytes(memory(point, "gbuffer")), megabytes(memory(point, "peak")), wrongHits(point)});
  }
  return table;
}

Table fragmentTable(const PointList& points) {
  Table table{{"Scene", "Method", "Bytes a fragment", "Made", "Stored", "in x", "in y", "in z", "Stored of made"}, {}};
  for (const Json& point : points) {
    const Json& held = point["memory"];
    if (held["fragments"] == 0) continue;
    const Json& axis = held["fragments_per_axis"];
    table.rows.push_back({sceneOf(point), presetOf(point), number(memory(point, "bytes_per_fragment"), 0),
                          held["fragments"].dump(), held["fragments_stored"].dump(), axis[0].dump(), axis[1].dump(),
                          axis[2].dump(), share(memory(point, "fragments_stored"), memory(point, "fragments"))});
  }
  return table;
}

// The paper's claim and ours beside it: three A-buffers against one.
Table claimTable(const PointList& points) {
  Table table{
      {"What", "Three A-buffers", "One A-buffer", "Saved", "Fragments: one of three", "foretold by the normals"}, {}};
  for (const PaperRow& row : kPaper)
    table.rows.push_back({std::string("the paper, ") + row.scene, number(row.three, 2), number(row.single, 2),
                          percent(1 - row.single / row.three), "", ""});
  for (const Json& point : points) {
    if (presetOf(point) != "kastrati2017") continue;
    const std::string scene = sceneOf(point);
    for (const auto& [preset, what] :
         {std::pair("kastrati2017 three", ", both in pages"), {"hu2014 all", ", lists against pages"}})
      if (const Json* three = find(points, scene, preset))
        table.rows.push_back({"here, " + scene + what, megabytes(aBuffer(*three)), megabytes(aBuffer(point)),
                              percent(1 - ratio(aBuffer(point), aBuffer(*three))),
                              percent(ratio(memory(point, "fragments_stored"), memory(*three, "fragments_stored"))),
                              percent(point["single_over_three"].get<double>())});
  }
  return table;
}

constexpr const char* kIntroduction =
    "This part shows how much GPU memory the structure takes for each method, and what share of the rays then hits "
    "something else than an exact ray tracer on the CPU.";

constexpr const char* kMethods =
    "<ul>\n"
    "<li><b>kastrati2017 three</b>: Kastrati &amp; Goswami's pages, but every fragment is kept in all three axes: the "
    "fair baseline for what one A-buffer saves.</li>\n"
    "<li><b>hu2014</b>: rays for reflective pixels, or for all as in the paper. The structure is the same for "
    "both.</li>\n"
    "<li><b>reference</b>: the bytes of Embree's tree are not GPU memory.</li>\n"
    "</ul>\n";

constexpr const char* kDifferences =
    "<p>The paper reports 64 to 66 % less A-buffer memory, a third of three A-buffers, &ldquo;the expected "
    "result&rdquo;. "
    "What is counted here is another share, for these reasons:</p>\n<ul>\n"
    "<li><b>A third is the best case, not the rule.</b> A surface with the unit normal n makes fragments in proportion "
    "to "
    "|n<sub>x</sub>|, |n<sub>y</sub>| and |n<sub>z</sub>| in the three A-buffers. The one that is kept holds "
    "max|n| / (|n<sub>x</sub>| + |n<sub>y</sub>| + |n<sub>z</sub>|) of them: 1/3 for a diagonal surface, all of them "
    "for a "
    "floor or a wall. The column &ldquo;foretold&rdquo; is that sum over the scene's triangles, counted in "
    "texels.</li>\n"
    "<li><b>The normals foretell, voxels choose.</b> The axis is that of the normals summed over a voxel, not the "
    "triangle's own, and a fragment whose voxel was left empty by its coarse rasterization is kept nowhere: the "
    "counted "
    "share differs from the foretold one.</li>\n"
    "<li><b>Pages waste.</b> A page has room for four fragments; most texels hold one or two, so 25 to 68 % of a pool "
    "is "
    "empty. Hu's linked lists have no such waste, only 4 bytes of link for each fragment: where the normals save "
    "little, one "
    "A-buffer in pages takes more than three in lists, and the saving above is negative. The paper does not say "
    "whether "
    "both of its sides had pages. What is wasted here counts links and, up to a quarter, the room that a pool keeps so "
    "that it need not be made anew for every small change.</li>\n"
    "<li><b>Heads are not free.</b> 3 x 1024 x 1024 list heads take 12.6 MB whatever the scene holds, in one "
    "A-buffer as in three.</li>\n"
    "<li><b>Other scenes.</b> The paper's sphere and teapot are not published; ours have other triangles and other "
    "surroundings. Compare shares, not megabytes. The paper does not say how it counts a megabyte; here it is "
    "10<sup>6</sup> "
    "bytes.</li>\n"
    "<li><b>Identities are small.</b> The default stores 4 bytes in place of 32, in voxels of a size that fits the "
    "scene, "
    "and only in those that a ray asks for.</li>\n</ul>\n";

}  // namespace

Table memoryCsv(const PointList& points) {
  constexpr const char* counts[] = {
      "voxels",           "heads",           "pool_reserved", "pool_used", "bytes_per_fragment", "fragments",
      "fragments_stored", "structure_total", "gbuffer",       "peak"};
  constexpr const char* errors[] = {"hit_error", "false_miss", "false_hit", "wrong_id"};
  Table table{{"scene", "triangles", "preset", "width", "height", "voxel_resolution", "abuffer_resolution"}, {}};
  table.columns.insert(table.columns.end(), std::begin(counts), std::end(counts));
  for (const char* name : {"fragments_x", "fragments_y", "fragments_z", "pool_wasted", "stored_over_made",
                           "structure_over_hu2014", "structure_over_kastrati2017", "single_over_three_foretold"})
    table.columns.emplace_back(name);
  table.columns.insert(table.columns.end(), std::begin(errors), std::end(errors));
  table.columns.emplace_back("lost_fragments");
  for (const Json& point : points) {
    const std::string scene = sceneOf(point);
    const Json& held = point["memory"];
    const double total = memory(point, "structure_total");
    std::vector<std::string> row = {scene,
                                    point["scene"]["triangles"].dump(),
                                    presetOf(point),
                                    point["size"][0].dump(),
                                    point["size"][1].dump(),
                                    point["settings"]["voxels.resolution"].dump(),
                                    point["settings"]["abuffer.resolution"].dump()};
    for (const char* name : counts) row.push_back(held[name].dump());
    for (const Json& stored : held["fragments_per_axis"]) row.push_back(stored.dump());
    row.push_back(number(wasted(point), 0));
    for (const double value :
         {ratio(memory(point, "fragments_stored"), memory(point, "fragments")),
          ratio(total, structureOf(points, scene, "hu2014 all")),
          ratio(total, structureOf(points, scene, "kastrati2017")), point["single_over_three"].get<double>()})
      row.push_back(number(value, 4));
    for (const char* name : errors) row.push_back(point["error"].is_null() ? "" : point["error"][name].dump());
    row.push_back(point["lost_fragments"].dump());
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table memorySummary(const PointList& points) {
  Table table{{"scene", "method", "structure MB", "pool wasted", "stored of made", "wrong hits"}, {}};
  for (const Json& point : points)
    table.rows.push_back({sceneOf(point), presetOf(point), megabytes(memory(point, "structure_total")),
                          share(wasted(point), memory(point, "pool_reserved")),
                          share(memory(point, "fragments_stored"), memory(point, "fragments")), wrongHits(point)});
  return table;
}

StackedBars memoryChart(const PointList& points) {
  StackedBars chart{"Memory of the ray-tracing structure, by scene and method",
                    "MB (logarithmic)",
                    {"voxel grid", "list heads", "pool, used", "pool, wasted", "other"},
                    {}};
  for (const Json& point : points) {
    Bar bar{sceneOf(point), presetOf(point), {}, megabytes(memory(point, "structure_total"))};
    for (const double bytes :
         {memory(point, "voxels"), memory(point, "heads"), memory(point, "pool_used"), wasted(point), other(point)})
      bar.parts.push_back(bytes / 1e6);
    chart.bars.push_back(std::move(bar));
  }
  return chart;
}

std::string memoryBody(const PointList& points, const std::vector<ScenePicture>& scenes,
                       const std::optional<std::string>& svg) {
  const auto coverage = [](const Json& point) {
    return std::string(", ") + percent(point["pixels"]["coverage"].get<double>()) + " of the pixels reflect";
  };
  std::string body = paragraph(kIntroduction) + gallery(scenes, points, coverage);
  body += heading("Structures side by side") +
          chartFigure(svg,
                      "The axis is logarithmic: compare the tops of the bars. A part's height shows what it adds to "
                      "those below it as a factor, not as an amount. Other: what a build needs besides, and the "
                      "reference's tree on the CPU.");
  body += kMethods + heading("Memory") + toHtml(memoryTable(points)) +
          paragraph(
              "Wrong hits: the share of the rays that hit where the reference misses, miss where it hits, or hit "
              "further than 0.1 % of the scene's diagonal from it. Peak: all GPU memory that the renderer holds.") +
          heading("Fragments") + toHtml(fragmentTable(points)) +
          paragraph(
              "Made are the fragments of the build's rasterization. Papers' methods: in all three axes. Halfsilver: in "
              "each triangle's own axis, stored where a ray asked for the voxel.") +
          heading("One A-buffer in place of three") + toHtml(claimTable(points)) +
          paragraph(
              "A-buffer memory is heads and pool, in MB. The paper: M. F. Kastrati, P. Goswami, Selective rasterized "
              "ray-traced reflections on the GPU, 2017, table 1 (Hu et al. against theirs; 1024 x 1024 texels).") +
          kDifferences;
  return body;
}

}  // namespace halfsilver::bench
