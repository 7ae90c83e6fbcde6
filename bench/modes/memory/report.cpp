#include "bench/modes/memory/report.h"
#include <halfsilver/methods.h>

#include <array>
#include <tuple>

#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

// Kastrati & Goswami 2017, table 1: A-buffer memory in MB, Hu et al.'s method and theirs, in their program.
struct PaperRow {
  const char* scene;
  double three, single;
};
constexpr std::array<PaperRow, 3> kPaper{
    {{"sphere", 182.37, 65.46}, {"teapot", 210.18, 71.85}, {"Sponza", 1079.55, 380.74}}};

double bytes(std::uint64_t count) { return static_cast<double>(count); }

double structure(const MemoryReport& memory) { return bytes(memory.structureTotal); }
double wasted(const MemoryReport& memory) { return bytes(memory.poolReserved) - bytes(memory.poolUsed); }
double aBuffer(const MemoryReport& memory) { return bytes(memory.heads) + bytes(memory.poolReserved); }
// Memory that has no other name, and all of a method without a grid (Embree's tree).
double other(const MemoryReport& memory) { return structure(memory) - bytes(memory.voxels) - aBuffer(memory); }

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

const MemoryPoint* find(MemoryPoints points, const std::string& scene, const std::string& preset) {
  for (const MemoryPoint& point : points)
    if (point.scene.file == scene && point.preset == preset) return &point;
  return nullptr;
}

double structureOf(MemoryPoints points, const std::string& scene, const std::string& preset) {
  const MemoryPoint* point = find(points, scene, preset);
  return point ? structure(point->memory) : 0;
}

std::string wrongHits(const MemoryPoint& point) { return point.error ? percent(point.error->hitError, 2) : ""; }

std::string cells(const MemoryPoint& point) {
  const auto& grid = point.memory.grid;
  if (grid[0] == 0) return "";
  std::string text = std::to_string(grid[0]) + " x " + std::to_string(grid[1]) + " x " + std::to_string(grid[2]);
  if (methodInfo(point.settings.trace.method).fixedResolution)
    text += ", " + std::to_string(point.settings.abuffer.resolution);
  return text;
}

Table memoryTable(MemoryPoints points) {
  Table table{{"Scene", "Method", "Voxels, texels", "Structure", "of hu2014", "of kastrati2017", "Voxel grid",
               "List heads", "Pool used", "Pool wasted", "wasted share", "Wrong hits"},
              {}};
  for (const MemoryPoint& point : points) {
    const MemoryReport& memory = point.memory;
    const std::string& scene = point.scene.file;
    const double total = structure(memory), waste = wasted(memory);
    table.rows.push_back({scene, point.preset, cells(point), megabytes(total),
                          ratioPercent(total, structureOf(points, scene, "hu2014 all")),
                          ratioPercent(total, structureOf(points, scene, "kastrati2017")),
                          megabytes(bytes(memory.voxels)), megabytes(bytes(memory.heads)),
                          megabytes(bytes(memory.poolUsed)), megabytes(waste),
                          ratioPercent(waste, bytes(memory.poolReserved)), wrongHits(point)});
  }
  return table;
}

// All that the renderer holds, and what of it belongs to rays.
Table peakTable(MemoryPoints points) {
  Table table{{"Scene", "Method", "Peak", "Structure", "Build and waiting rays", "Queues of rays", "G-buffer",
               "Geometry", "Textures", "Shadow maps"},
              {}};
  for (const MemoryPoint& point : points) {
    const MemoryReport& memory = point.memory;
    std::vector<std::string> row = {point.scene.file, point.preset};
    for (const std::uint64_t part : {memory.peak, memory.structureTotal, memory.transient, memory.queues,
                                     memory.gbuffer, memory.geometry, memory.textures, memory.shadowMaps})
      row.push_back(megabytes(bytes(part)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table fragmentTable(MemoryPoints points) {
  Table table{{"Scene", "Method", "Bytes per fragment", "Made", "Stored", "in x", "in y", "in z", "Stored of made"},
              {}};
  for (const MemoryPoint& point : points) {
    const MemoryReport& memory = point.memory;
    if (memory.fragments == 0) continue;
    std::vector<std::string> row = {point.scene.file, point.preset, number(memory.bytesPerFragment, 0),
                                    std::to_string(memory.fragments), std::to_string(memory.fragmentsStored)};
    for (const std::uint64_t stored : memory.fragmentsPerAxis) row.push_back(std::to_string(stored));
    row.push_back(ratioPercent(bytes(memory.fragmentsStored), bytes(memory.fragments)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

// The paper's claim beside our figures: three A-buffers against one.
Table claimTable(MemoryPoints points) {
  Table table{
      {"What", "Three A-buffers", "One A-buffer", "Saved", "Fragments: one of three", "predicted by the normals"}, {}};
  for (const PaperRow& row : kPaper)
    table.rows.push_back({std::string("the paper, ") + row.scene, number(row.three, 2), number(row.single, 2),
                          percent(1 - row.single / row.three), "", ""});
  for (const MemoryPoint& point : points) {
    if (point.preset != "kastrati2017") continue;
    const std::string scene = point.scene.file;
    for (const auto& [preset, what] :
         {std::pair("kastrati2017 three", ", both in pages"), {"hu2014 all", ", lists against pages"}})
      if (const MemoryPoint* three = find(points, scene, preset))
        table.rows.push_back({"here, " + scene + what, megabytes(aBuffer(three->memory)),
                              megabytes(aBuffer(point.memory)),
                              percent(1 - ratio(aBuffer(point.memory), aBuffer(three->memory))),
                              percent(ratio(bytes(point.memory.fragmentsStored), bytes(three->memory.fragmentsStored))),
                              percent(point.singleOverThree)});
  }
  return table;
}

constexpr const char* kIntroduction =
    "This part shows how much GPU memory each method's structure takes, and for what share of the rays the hit differs "
    "from that of an exact ray tracer on the CPU.";

constexpr const char* kMethods =
    "<ul>\n"
    "<li><b>kastrati2017 three</b>: Kastrati &amp; Goswami's pages, but every fragment is stored along all three axes: "
    "the fair baseline for what one A-buffer saves.</li>\n"
    "<li><b>hu2014</b>: rays for reflective pixels, or for all as in the paper. The structure is the same for "
    "both. Texels as for kastrati2017, where the paper has 1280 x 1280. Its entries hold positions, too, which follow "
    "from texel and depth and are left out: 32 bytes instead of 44, or 48 in whole RGBA32F texels.</li>\n"
    "<li><b>reference</b>: the bytes of Embree's tree are not GPU memory.</li>\n"
    "</ul>\n";

constexpr const char* kDifferences =
    "<p>The paper reports 64 to 66 % less A-buffer memory, a third of three A-buffers, &ldquo;the expected "
    "result&rdquo;. The share measured here differs, for these reasons:</p>\n<ul>\n"
    "<li><b>A third is the best case, not the rule.</b> A surface with the unit normal n makes fragments in proportion "
    "to |n<sub>x</sub>|, |n<sub>y</sub>| and |n<sub>z</sub>| in the three A-buffers. The single A-buffer holds "
    "max|n| / (|n<sub>x</sub>| + |n<sub>y</sub>| + |n<sub>z</sub>|) of them: 1/3 for a diagonal surface, all of them "
    "for a floor or a wall. The column &ldquo;predicted&rdquo; is that sum over the scene's triangles, counted in "
    "texels.</li>\n"
    "<li><b>Normals predict, voxels decide.</b> The axis is that of the normals summed over a voxel, not the "
    "triangle's own, and a fragment is stored nowhere if the coarse rasterization missed its voxel: the measured share "
    "differs from the predicted one.</li>\n"
    "<li><b>Pages waste memory.</b> A page has room for four fragments; most texels hold one or two, so 25 to 68 % of "
    "a pool is empty. Hu's linked lists have no such waste, only 4 bytes of link per fragment: if the normals save "
    "little, one A-buffer in pages takes more than three in lists, and the saving above is negative. The paper does "
    "not say whether both of its sides had pages. The waste shown here includes links and, up to a quarter, the spare "
    "room of a pool, which saves reallocating it for every small change.</li>\n"
    "<li><b>Heads are not free.</b> 3 x 1024 x 1024 list heads take 12.6 MB whatever the scene holds, in one "
    "A-buffer as in three.</li>\n"
    "<li><b>Other scenes.</b> The paper's sphere and teapot are not published; ours have other triangles and other "
    "surroundings. Compare shares, not megabytes. The paper does not say how it counts a megabyte; here it is "
    "10<sup>6</sup> bytes.</li>\n"
    "<li><b>Identities are small.</b> The default stores 4 bytes instead of 32, in voxels of a size that fits the "
    "scene, and only in those that a ray asks for.</li>\n</ul>\n";

constexpr std::tuple kMemoryColumns{&MemoryReport::voxels,
                                    &MemoryReport::heads,
                                    &MemoryReport::poolReserved,
                                    &MemoryReport::poolUsed,
                                    &MemoryReport::bytesPerFragment,
                                    &MemoryReport::fragments,
                                    &MemoryReport::fragmentsStored,
                                    &MemoryReport::structureTotal,
                                    &MemoryReport::gbuffer,
                                    &MemoryReport::geometry,
                                    &MemoryReport::textures,
                                    &MemoryReport::shadowMaps,
                                    &MemoryReport::queues,
                                    &MemoryReport::transient,
                                    &MemoryReport::peak};
constexpr std::tuple kErrorColumns{&ComparisonRecord::hitError, &ComparisonRecord::falseMiss,
                                   &ComparisonRecord::falseHit, &ComparisonRecord::wrongId};
constexpr std::tuple kFrameColumns{&FrameRecord::lostFragments};

}  // namespace

Table memoryCsv(MemoryPoints points) {
  Table table{{"scene", "triangles", "preset", "width", "height", "voxel_resolution", "abuffer_resolution"}, {}};
  addKeys(table.columns, kMemoryColumns);
  for (const char* name : {"fragments_x", "fragments_y", "fragments_z", "pool_wasted", "stored_over_made",
                           "structure_over_hu2014", "structure_over_kastrati2017", "single_over_three_foretold"})
    table.columns.emplace_back(name);
  addKeys(table.columns, kErrorColumns);
  addKeys(table.columns, kFrameColumns);
  for (const MemoryPoint& point : points) {
    const MemoryReport& memory = point.memory;
    const std::string& scene = point.scene.file;
    std::vector<std::string> row = {scene,
                                    std::to_string(point.scene.triangles),
                                    point.preset,
                                    std::to_string(point.size.width),
                                    std::to_string(point.size.height),
                                    std::to_string(point.settings.voxels.resolution),
                                    std::to_string(point.settings.abuffer.resolution)};
    addValues(row, memory, kMemoryColumns);
    for (const std::uint64_t stored : memory.fragmentsPerAxis) row.push_back(std::to_string(stored));
    row.push_back(number(wasted(memory), 0));
    for (const double value :
         {ratio(bytes(memory.fragmentsStored), bytes(memory.fragments)),
          ratio(structure(memory), structureOf(points, scene, "hu2014 all")),
          ratio(structure(memory), structureOf(points, scene, "kastrati2017")), point.singleOverThree})
      row.push_back(number(value, 4));
    if (point.error)
      addValues(row, *point.error, kErrorColumns);
    else
      row.resize(row.size() + std::tuple_size_v<decltype(kErrorColumns)>);
    addValues(row, point, kFrameColumns);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table memorySummary(MemoryPoints points) {
  Table table{{"scene", "method", "structure MB", "pool wasted", "stored of made", "wrong hits"}, {}};
  for (const MemoryPoint& point : points)
    table.rows.push_back({point.scene.file, point.preset, megabytes(structure(point.memory)),
                          ratioPercent(wasted(point.memory), bytes(point.memory.poolReserved)),
                          ratioPercent(bytes(point.memory.fragmentsStored), bytes(point.memory.fragments)),
                          wrongHits(point)});
  return table;
}

StackedBars memoryChart(MemoryPoints points) {
  StackedBars chart{"Memory of the ray-tracing structure, by scene and method",
                    "MB (logarithmic)",
                    {"voxel grid", "list heads", "pool, used", "pool, wasted", "other"},
                    {}};
  for (const MemoryPoint& point : points) {
    const MemoryReport& memory = point.memory;
    Bar bar{point.scene.file, point.preset, {}, megabytes(structure(memory))};
    for (const double part :
         {bytes(memory.voxels), bytes(memory.heads), bytes(memory.poolUsed), wasted(memory), other(memory)})
      bar.parts.push_back(part / 1e6);
    chart.bars.push_back(std::move(bar));
  }
  return chart;
}

std::string memoryBody(MemoryPoints points, const std::vector<Figure>& pictures,
                       const std::optional<std::string>& svg) {
  std::string body = paragraph(kIntroduction) + gallery(pictures);
  body += heading("Structures side by side") +
          chartFigure(svg,
                      "The axis is logarithmic: compare the tops of the bars. The height of a part shows what it adds "
                      "to those below it as a factor, not as an amount. Other: what a build needs besides, and the "
                      "reference's tree on the CPU.");
  body += kMethods + heading("Memory") + toHtml(memoryTable(points)) +
          paragraph(
              "Wrong hits: the share of the rays that hit although the reference misses, miss although it hits, or hit "
              "more than 0.1 % of the scene's diagonal away from it.") +
          heading("Everything else") + toHtml(peakTable(points)) +
          paragraph(
              "Peak: all GPU memory that the renderer holds at once, which is the sum of the columns behind it. Queues "
              "of rays: the rays, what is known of them, their hits and their light. A textured or well-lit scene "
              "takes more than its structure many times over, whatever the method.") +
          heading("Fragments") + toHtml(fragmentTable(points)) +
          paragraph(
              "Made: the fragments of the build's rasterization. Papers' methods: along all three axes. Halfsilver: "
              "along each triangle's own axis, stored if a ray asked for the voxel.") +
          heading("One A-buffer instead of three") + toHtml(claimTable(points)) +
          paragraph(
              "A-buffer memory is heads and pool, in MB. The paper: M. F. Kastrati, P. Goswami, Selective rasterized "
              "ray-traced reflections on the GPU, 2017, table 1 (Hu et al. against theirs; 1024 x 1024 texels).") +
          kDifferences;
  return body;
}

}  // namespace halfsilver::bench
