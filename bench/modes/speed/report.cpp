#include "bench/modes/speed/report.h"

#include <array>
#include <tuple>

#include "bench/report/text.h"

namespace halfsilver::bench {
namespace {

double structureTime(const Times& times) { return times.voxelize.min + times.build.min; }

const FrameCost& costOf(const SpeedPoint& point, FrameKind kind) {
  return kind == FrameKind::first ? point.first : point.warm;
}

std::string orNothing(double value, int digits) { return value > 0 ? number(value, digits) : ""; }

Table rayTable(SpeedPoints points) {
  Table table{{"Scene", "Method", "Rays", "Million rays per second", "per core-second", "Steps per ray",
               "Tests per ray", "Most tests", "Lanes at work of 8", "of 32"},
              {}};
  for (const SpeedPoint& point : points) {
    std::vector<std::string> row = {point.scene.file, point.preset, std::to_string(point.pixels.selected),
                                    number(1e-6 * point.raysPerSecond, 3),
                                    point.raysPerCoreSecond ? number(1e-6 * *point.raysPerCoreSecond, 3) : ""};
    if (const auto& search = point.search)
      row.insert(row.end(), {number(search->steps, 1), number(search->tests, 1), std::to_string(search->maxTests),
                             percent(search->lanesOf8, 0), percent(search->lanesOf32, 0)});
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table stageTable(SpeedPoints points, FrameKind kind) {
  Table table{{"Scene", "Method", "Frame"}, {}};
  const auto stages = [](const auto& use) {
    std::apply([&](const auto&... stage) { (use(stage), ...); }, kFields<Times>);
  };
  stages([&](const auto& stage) {
    if (stage.member != &Times::frame) table.columns.emplace_back(stage.key);
  });
  for (const SpeedPoint& point : points) {
    const Times& times = costOf(point, kind).times;
    std::vector<std::string> row = {point.scene.file, point.preset, number(times.frame.median, 1)};
    stages([&](const auto& stage) {
      if (stage.member != &Times::frame) row.push_back(orNothing((times.*stage.member).median, 1));
    });
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table structureTable(SpeedPoints points) {
  Table table{
      {"Scene", "Method", "Triangles", "Bytes per triangle", "Build, first frame, ms", "per million triangles, ms",
       "Build, camera moved, ms", "of the first", "Build, object moved, ms", "of the first"},
      {}};
  for (const SpeedPoint& point : points) {
    const double first = structureTime(point.first.times);
    std::vector<std::string> row = {point.scene.file,
                                    point.preset,
                                    std::to_string(point.scene.triangles),
                                    number(point.bytesPerTriangle, 1),
                                    number(first, 1),
                                    number(point.buildMsPerMillion, 0)};
    for (const FrameCost* cost : {&point.camera, &point.object}) {
      row.push_back(number(structureTime(cost->times), 1));
      row.push_back(ratioPercent(structureTime(cost->times), first));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table motionTable(SpeedPoints points) {
  Table table{{"Scene", "Method", "Nothing moves, ms", "1 % of the triangles", "10 %", "all", "Structure, MB"}, {}};
  for (const SpeedPoint& point : points) {
    std::vector<std::string> row = {point.scene.file, point.preset};
    for (const FrameCost* cost : {&point.warm, &point.object, &point.tenth, &point.everything})
      row.push_back(number(structureTime(cost->times) + cost->times.trace.min, 1));
    row.push_back(number(1e-6 * static_cast<double>(point.memory.structureTotal), 2));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table callTable(SpeedPoints points) {
  Table table{{"Scene", "Method", "Waits, first frame", "warm", "camera moved", "object moved",
               "Dispatches, first frame", "warm", "Draws, first frame", "warm"},
              {}};
  for (const SpeedPoint& point : points) {
    std::vector<std::string> row = {point.scene.file, point.preset};
    for (const FrameCost* cost : {&point.first, &point.warm, &point.camera, &point.object})
      row.push_back(std::to_string(cost->waits));
    for (const auto member : {&FrameCost::dispatches, &FrameCost::draws})
      for (const FrameCost* cost : {&point.first, &point.warm}) row.push_back(std::to_string(cost->*member));
    table.rows.push_back(std::move(row));
  }
  return table;
}

constexpr const char* kIntroduction =
    "This part shows how long frames and their stages take, how many rays a second that is, and what the search does "
    "for a ray. Times belong to this device; counts do not.";

constexpr const char* kRays =
    "Steps: cells of a grid or nodes of a hierarchy that a ray comes through. Tests: of triangles; of texels by "
    "methods that store attributes. Lanes at work: rays that are neighbors in the queue run in groups of 8 or 32, and "
    "a group ends with its slowest ray; the share is the work of all rays over what their groups have time for. A "
    "core-second is a second of one core: the CPU time of the trace on a software rasterizer, the time of all threads "
    "for the reference's rays; it has no meaning on a GPU.";

constexpr const char* kFrames =
    "Medians in milliseconds. A warm frame finds everything as the last one left it. The first frame builds all that "
    "its rays need and draws the shadow maps; its programs are compiled already. CPU rays run beside the other stages, "
    "so stages may add up to more than the frame.";

constexpr const char* kStructure =
    "Build: voxelization and structure, the least of several frames. The camera moves by 5 cm per frame to the side, "
    "an object of 1 % of the triangles by 5 cm upward.";

constexpr const char* kMotion =
    "Voxelization, structure and trace together, the least of several frames, in each of which so many of the "
    "triangles "
    "have moved by 5 cm upward.";

constexpr const char* kCalls =
    "Waits: calls that let the host wait for the GPU; each may be a stall on a real driver. The report that follows a "
    "frame is not counted.";

constexpr std::tuple kSearchColumns{&SearchCounts::steps, &SearchCounts::tests, &SearchCounts::maxTests,
                                    &SearchCounts::lanesOf8, &SearchCounts::lanesOf32};
constexpr std::tuple kRateColumns{&SpeedResult::raysPerSecond, &SpeedResult::raysPerCoreSecond,
                                  &SpeedResult::buildMsPerMillion, &SpeedResult::bytesPerTriangle};

struct Kind {
  const char* name;
  FrameCost SpeedResult::*cost;
};
constexpr std::array<Kind, 6> kKinds{{{"first", &SpeedResult::first},
                                      {"warm", &SpeedResult::warm},
                                      {"camera", &SpeedResult::camera},
                                      {"object", &SpeedResult::object},
                                      {"tenth", &SpeedResult::tenth},
                                      {"everything", &SpeedResult::everything}}};

}  // namespace

Table speedCsv(SpeedPoints points) {
  Table table{{"scene", "triangles", "preset", "width", "height", "rays"}, {}};
  addKeys(table.columns, kRateColumns);
  addKeys(table.columns, kSearchColumns);
  const auto stages = [](const auto& use) {
    std::apply([&](const auto&... stage) { (use(stage), ...); }, kFields<Times>);
  };
  for (const Kind& kind : kKinds) {
    const std::string prefix = std::string(kind.name) + "_";
    for (const char* count : {"waits", "dispatches", "draws"}) table.columns.push_back(prefix + count);
    stages([&](const auto& stage) { table.columns.push_back(prefix + stage.key + "_ms"); });
  }
  for (const SpeedPoint& point : points) {
    std::vector<std::string> row = {point.scene.file,
                                    std::to_string(point.scene.triangles),
                                    point.preset,
                                    std::to_string(point.size.width),
                                    std::to_string(point.size.height),
                                    std::to_string(point.pixels.selected)};
    addValues(row, static_cast<const SpeedResult&>(point), kRateColumns);
    if (point.search)
      addValues(row, *point.search, kSearchColumns);
    else
      row.resize(row.size() + std::tuple_size_v<decltype(kSearchColumns)>);
    for (const Kind& kind : kKinds) {
      const FrameCost& cost = point.*kind.cost;
      for (const std::uint64_t count : {cost.waits, cost.dispatches, cost.draws}) row.push_back(std::to_string(count));
      stages([&](const auto& stage) { row.push_back(exactText((cost.times.*stage.member).median)); });
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table speedSummary(SpeedPoints points) {
  Table table{{"scene", "method", "Mrays/s", "steps", "tests", "trace ms", "frame ms", "first ms", "waits"}, {}};
  for (const SpeedPoint& point : points)
    table.rows.push_back({point.scene.file, point.preset, number(1e-6 * point.raysPerSecond, 3),
                          point.search ? number(point.search->steps, 1) : "",
                          point.search ? number(point.search->tests, 1) : "", number(point.warm.times.trace.median, 1),
                          number(point.warm.times.frame.median, 1), number(point.first.times.frame.median, 1),
                          std::to_string(point.warm.waits)});
  return table;
}

StackedBars speedChart(SpeedPoints points, FrameKind kind) {
  StackedBars chart{kind == FrameKind::first ? "First frame by stage" : "Warm frame by stage",
                    "ms (logarithmic)",
                    {"shadow maps", "deferred and hits", "selection, composite", "structure", "trace"},
                    {}};
  for (const SpeedPoint& point : points) {
    const Times& times = costOf(point, kind).times;
    Bar bar{point.scene.file, point.preset, {}, number(times.frame.median, 0)};
    bar.parts = {times.shadow.median, times.gbuffer.median + times.shade.median,
                 times.select.median + times.composite.median, times.voxelize.median + times.build.median,
                 times.trace.median};
    chart.bars.push_back(std::move(bar));
  }
  return chart;
}

std::string speedBody(SpeedPoints points, const std::vector<Figure>& pictures, const std::optional<std::string>& warm,
                      const std::optional<std::string>& first) {
  const char* logarithmic =
      "The axis is logarithmic: compare the tops of the bars. The height of a part shows what it adds to those below "
      "it "
      "as a factor, not as an amount.";
  std::string body = paragraph(kIntroduction) + gallery(pictures);
  body += heading("Rays") + toHtml(rayTable(points)) + paragraph(kRays);
  body += heading("A warm frame") + chartFigure(warm, logarithmic) + toHtml(stageTable(points, FrameKind::warm)) +
          paragraph(kFrames);
  body += heading("The first frame") + chartFigure(first, logarithmic) + toHtml(stageTable(points, FrameKind::first));
  body += heading("Structures and moves") + toHtml(structureTable(points)) + paragraph(kStructure);
  body += heading("Rays while triangles move") + toHtml(motionTable(points)) + paragraph(kMotion);
  body += heading("Waits, dispatches and draws of a frame") + toHtml(callTable(points)) + paragraph(kCalls);
  return body;
}

}  // namespace halfsilver::bench
