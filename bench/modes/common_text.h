#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/harness/bench_scene.h"
#include "bench/harness/output_folder.h"
#include "bench/harness/point.h"
#include "bench/report/page.h"

// What the reports of all modes have in common.
namespace halfsilver::bench {

// What Halfsilver and its presets are, for first-time readers; HTML.
std::string introduction();

// "Measured with Halfsilver 0.1 on ...": holds for all points of a report.
std::string measuredWith(const std::string& version, const Device& device, const Size& size);

// "builtin:sphere, 1000 triangles<remark>, mirror floor=0.9"
std::string sceneCaption(const SceneRecord& scene, const std::string& remark);

// The pictures of the scenes that have points. `remark` adds what a scene's first point shows to the caption. `nameOf`
// turns a scene's name into that of its picture; without it they are the same.
template <class P, class Remark>
std::vector<Figure> sceneFigures(const OutputFolder& folder, const std::vector<BenchScene>& scenes,
                                 const std::vector<P>& points, Remark remark,
                                 std::string (*nameOf)(const std::string&) = nullptr) {
  std::vector<Figure> figures;
  for (const BenchScene& scene : scenes)
    for (const P& point : points)
      if (point.scene.file == scene.name) {
        figures.push_back(
            {readPicture(folder, nameOf ? nameOf(scene.name) : scene.name), sceneCaption(point.scene, remark(point))});
        break;
      }
  return figures;
}

// A line for each point that lost fragments.
template <class P>
std::vector<std::string> lostFragments(const std::vector<P>& points) {
  std::vector<std::string> warnings;
  for (const P& point : points)
    if (point.lostFragments > 0)
      warnings.push_back(point.scene.file + ", " + point.preset + ": " + std::to_string(point.lostFragments) +
                         " fragments did not fit into the A-buffer");
  return warnings;
}

}  // namespace halfsilver::bench
