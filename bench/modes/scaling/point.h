#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>

#include "bench/harness/point.h"

namespace halfsilver::bench {

// A scene that is made for a point.
struct ScaledScene {
  std::string file;  // its name
  std::size_t trianglesWanted = 0, lights = 0;
};
template <>
inline constexpr auto kFields<ScaledScene> =
    std::tuple{field("file", &ScaledScene::file), field("triangles_wanted", &ScaledScene::trianglesWanted),
               field("lights", &ScaledScene::lights)};

struct ScalingKey : PointKey<ScaledScene> {
  std::string axis;  // what grows
  double value = 0;  // on the axis
};
template <>
inline constexpr auto kFields<ScalingKey> = std::tuple_cat(kFields<PointKey<ScaledScene>>,
                                                           std::tuple{field("axis", &ScalingKey::axis),
                                                                      field("value", &ScalingKey::value)});

// Of a point that failed: as much as was known by then.
struct ScalingResult {
  std::optional<std::size_t> triangles;  // that the scene really has
  std::optional<double> seconds;         // of the first frames; making and loading the scene does not count
  std::optional<TimedFrame> frame;
  std::optional<std::string> failed;  // the error that ended it
};
template <>
inline constexpr auto kFields<ScalingResult> =
    std::tuple{field("triangles", &ScalingResult::triangles, Empty::omitted),
               field("seconds", &ScalingResult::seconds, Empty::omitted), group(&ScalingResult::frame),
               field("failed", &ScalingResult::failed, Empty::omitted)};

using ScalingPoint = Point<ScalingKey, ScalingResult>;

}  // namespace halfsilver::bench
