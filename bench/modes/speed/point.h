#pragma once

#include <cstdint>
#include <optional>
#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

// What the searches of a frame's rays did; counts do not depend on the machine.
struct SearchCounts {
  double steps = 0, tests = 0;         // per ray
  std::uint64_t maxTests = 0;          // of a ray
  double lanesOf8 = 0, lanesOf32 = 0;  // see lanesAtWork()
};
template <>
inline constexpr auto kFields<SearchCounts> =
    std::tuple{field("steps_per_ray", &SearchCounts::steps), field("tests_per_ray", &SearchCounts::tests),
               field("max_tests", &SearchCounts::maxTests), field("lanes_of_8", &SearchCounts::lanesOf8),
               field("lanes_of_32", &SearchCounts::lanesOf32)};

// One kind of frame.
struct FrameCost {
  Times times;
  std::uint64_t dispatches = 0, draws = 0, waits = 0;  // see GlWork; the most of one frame
};
template <>
inline constexpr auto kFields<FrameCost> =
    std::tuple{field("time_ms", &FrameCost::times), field("dispatches", &FrameCost::dispatches),
               field("draws", &FrameCost::draws), field("waits", &FrameCost::waits)};

struct SpeedResult : FrameRecord {
  FrameCost first;   // builds all that its rays need and draws the shadow maps; programs are compiled
  FrameCost warm;    // nothing has changed since the last one
  FrameCost camera;  // has moved by 5 cm
  FrameCost object;  // 1 % of the triangles have moved by 5 cm
  FrameCost tenth;   // 10 %
  FrameCost everything;
  double raysPerSecond = 0;
  // The same of a core: by the CPU time of the trace on software rasterizers, by the threads of CPU rays; nothing on a
  // GPU.
  std::optional<double> raysPerCoreSecond;
  double buildMsPerMillion = 0;  // voxelize and build of a first frame, per million triangles
  double bytesPerTriangle = 0;   // of the structure
  std::optional<SearchCounts> search;
};
template <>
inline constexpr auto kFields<SpeedResult> = std::tuple_cat(
    kFields<FrameRecord>,
    std::tuple{field("first", &SpeedResult::first), field("warm", &SpeedResult::warm),
               field("camera", &SpeedResult::camera), field("object", &SpeedResult::object),
               field("tenth", &SpeedResult::tenth), field("everything", &SpeedResult::everything),
               field("rays_per_second", &SpeedResult::raysPerSecond),
               field("rays_per_core_second", &SpeedResult::raysPerCoreSecond),
               field("build_ms_per_million_triangles", &SpeedResult::buildMsPerMillion),
               field("bytes_per_triangle", &SpeedResult::bytesPerTriangle), field("search", &SpeedResult::search)});

using SpeedPoint = Point<PointKey<>, SpeedResult>;

}  // namespace halfsilver::bench
