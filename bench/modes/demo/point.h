#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "bench/harness/point.h"

namespace halfsilver::bench {

// A recording of the game's input.
struct ReplayRecord {
  std::string file;    // without its folder
  std::uint64_t hash;  // of what it holds (FNV-1a)
};
template <>
inline constexpr auto kFields<ReplayRecord> =
    std::tuple{field("file", &ReplayRecord::file), field("hash", &ReplayRecord::hash)};

struct DemoKey : PointKey<ReplayRecord> {
  int framesWanted = 0;
  double frameTime = 0;  // milliseconds to hold; 0: full quality
};
template <>
inline constexpr auto kFields<DemoKey> = std::tuple_cat(kFields<PointKey<ReplayRecord>>,
                                                        std::tuple{field("frames_wanted", &DemoKey::framesWanted),
                                                                   field("frame_time_ms", &DemoKey::frameTime)});

// A line that `demo --stats` writes.
struct DemoFrame {
  int frame = 0;
  double wallMilliseconds = 0, scale = 1, tracedShare = 1, coverage = 0;  // shares 0..1
  std::uint64_t rays = 0, overflow = 0, structureBytes = 0, totalBytes = 0;
  std::map<std::string, double> times;  // milliseconds by stage
};
template <>
inline constexpr auto kFields<DemoFrame> = std::tuple{field("frame", &DemoFrame::frame),
                                                      field("wall_ms", &DemoFrame::wallMilliseconds),
                                                      field("scale", &DemoFrame::scale),
                                                      field("traced_share", &DemoFrame::tracedShare),
                                                      field("coverage", &DemoFrame::coverage),
                                                      field("rays", &DemoFrame::rays),
                                                      field("overflow", &DemoFrame::overflow),
                                                      field("structure_bytes", &DemoFrame::structureBytes),
                                                      field("total_bytes", &DemoFrame::totalBytes),
                                                      field("time_ms", &DemoFrame::times)};

struct DemoResult {
  std::vector<DemoFrame> frames;
};
template <>
inline constexpr auto kFields<DemoResult> = std::tuple{field("frames", &DemoResult::frames)};

using DemoPoint = Point<DemoKey, DemoResult>;

}  // namespace halfsilver::bench
