#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <tuple>
#include <vector>

#include <halfsilver/renderer.h>
#include <halfsilver/settings.h>
#include "apps/arguments.h"
#include "apps/statistics.h"
#include "bench/harness/bench_scene.h"
#include "bench/harness/fields.h"
#include "bench/harness/json_values.h"

// What the points of all modes share: what identifies one, and what a drawn frame tells.
namespace halfsilver::bench {

struct Device {
  std::string vendor, renderer, version, context;
  bool software = false;
};
template <>
inline constexpr auto kFields<Device> = std::tuple{
    field("vendor", &Device::vendor), field("renderer", &Device::renderer), field("version", &Device::version),
    field("context", &Device::context), field("software", &Device::software)};

struct View {
  glm::vec3 eye{0}, target{0};
  float fov = 0;  // vertical, degrees
};
template <>
inline constexpr auto kFields<View> =
    std::tuple{field("eye", &View::eye), field("target", &View::target), field("fov", &View::fov)};

struct SceneRecord {
  std::string file;
  std::size_t triangles = 0, vertices = 0, materials = 0, textures = 0, lights = 0;
  double diagonal = 0;  // meters
  std::vector<std::string> mirrors;
  View camera;
};
template <>
inline constexpr auto kFields<SceneRecord> =
    std::tuple{field("file", &SceneRecord::file),         field("triangles", &SceneRecord::triangles),
               field("vertices", &SceneRecord::vertices), field("materials", &SceneRecord::materials),
               field("textures", &SceneRecord::textures), field("lights", &SceneRecord::lights),
               field("diagonal", &SceneRecord::diagonal), field("mirrors", &SceneRecord::mirrors),
               field("camera", &SceneRecord::camera)};

// What identifies a point. A mode derives its own key from it.
template <class Scene = SceneRecord>
struct PointKey {
  std::string version;  // of Halfsilver
  Device device;
  Scene scene;
  Settings settings;
  Size size;
  std::string preset;  // or the mode's variant of one
};
template <class Scene>
inline constexpr auto kFields<PointKey<Scene>> =
    std::tuple{field("version", &PointKey<Scene>::version), field("device", &PointKey<Scene>::device),
               field("scene", &PointKey<Scene>::scene),     field("settings", &PointKey<Scene>::settings),
               field("size", &PointKey<Scene>::size),       field("preset", &PointKey<Scene>::preset)};

// A point of a mode: its key and what was measured.
template <class KeyType, class ResultType>
struct Point : KeyType, ResultType {
  using Key = KeyType;
  using Result = ResultType;
};
template <class Key, class Result>
inline constexpr auto kFields<Point<Key, Result>> = std::tuple_cat(kFields<Key>, kFields<Result>);

struct PixelCounts {
  int width = 0, height = 0;
  std::uint64_t total = 0;
  std::uint64_t reflecting = 0, selected = 0;  // see FrameReport
  double coverage = 0;                         // selected of total
};
template <>
inline constexpr auto kFields<PixelCounts> =
    std::tuple{field("width", &PixelCounts::width),       field("height", &PixelCounts::height),
               field("total", &PixelCounts::total),       field("reflecting", &PixelCounts::reflecting),
               field("selected", &PixelCounts::selected), field("coverage", &PixelCounts::coverage)};

template <>
inline constexpr auto kFields<MemoryReport> = std::tuple{field("voxels", &MemoryReport::voxels),
                                                         field("heads", &MemoryReport::heads),
                                                         field("pool_reserved", &MemoryReport::poolReserved),
                                                         field("pool_used", &MemoryReport::poolUsed),
                                                         field("fragments", &MemoryReport::fragments),
                                                         field("fragments_stored", &MemoryReport::fragmentsStored),
                                                         field("fragments_per_axis", &MemoryReport::fragmentsPerAxis),
                                                         field("bytes_per_fragment", &MemoryReport::bytesPerFragment),
                                                         field("grid", &MemoryReport::grid),
                                                         field("structure_total", &MemoryReport::structureTotal),
                                                         field("gbuffer", &MemoryReport::gbuffer),
                                                         field("geometry", &MemoryReport::geometry),
                                                         field("textures", &MemoryReport::textures),
                                                         field("shadow_maps", &MemoryReport::shadowMaps),
                                                         field("queues", &MemoryReport::queues),
                                                         field("pictures", &MemoryReport::pictures),
                                                         field("transient", &MemoryReport::transient),
                                                         field("largest_buffer", &MemoryReport::largestBuffer),
                                                         field("largest_buffer_name", &MemoryReport::largestBufferName),
                                                         field("peak", &MemoryReport::peak)};

// What the last frame of a point reported.
struct FrameRecord {
  PixelCounts pixels;
  MemoryReport memory;
  std::uint64_t overflow = 0;  // rays given up
  std::uint64_t lostFragments = 0;
  std::vector<std::string> warnings;
};
template <>
inline constexpr auto kFields<FrameRecord> =
    std::tuple{field("pixels", &FrameRecord::pixels), field("memory", &FrameRecord::memory),
               field("overflow", &FrameRecord::overflow), field("lost_fragments", &FrameRecord::lostFragments),
               field("warnings", &FrameRecord::warnings)};

// Milliseconds of a stage over the frames of a point.
struct Timing {
  double median = 0, min = 0, max = 0;
  std::size_t runs = 0, rejected = 0;  // see StageSummary
};
template <>
inline constexpr auto kFields<Timing> =
    std::tuple{field("median", &Timing::median), field("min", &Timing::min), field("max", &Timing::max),
               field("runs", &Timing::runs), field("rejected", &Timing::rejected)};

struct Times {
  Timing shadow, gbuffer, select, voxelize, build, trace, shade, composite, frame;
};
template <>
inline constexpr auto kFields<Times> = std::tuple{
    field("shadow", &Times::shadow),     field("gbuffer", &Times::gbuffer),     field("select", &Times::select),
    field("voxelize", &Times::voxelize), field("build", &Times::build),         field("trace", &Times::trace),
    field("shade", &Times::shade),       field("composite", &Times::composite), field("frame", &Times::frame)};

struct TimedFrame : FrameRecord {
  Times times;
};
template <>
inline constexpr auto kFields<TimedFrame> = std::tuple_cat(kFields<FrameRecord>,
                                                           std::tuple{field("time_ms", &TimedFrame::times)});

// Of a run that Workbench::describe() made; nothing needs to be drawn.
PointKey<> pointKey(const RunStatistics& run, const BenchScene& scene, std::string preset);

// Of a run that Workbench::draw() filled in.
FrameRecord frameRecord(const RunStatistics& run);
TimedFrame timedFrame(const RunStatistics& run);

Device deviceOf(const RunStatistics& run);

}  // namespace halfsilver::bench
