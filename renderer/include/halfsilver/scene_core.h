#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/scene.h>

namespace halfsilver {

// Where nearly all triangles of a scene lie. A few large ones, such as a ground that reaches to the horizon, would
// otherwise stretch a voxel grid until everything else lies in one voxel.
struct SceneCore {
  Bounds bounds;                     // relative to Scene::origin
  std::vector<std::uint32_t> outer;  // triangles that reach beyond; at most kMostOuterTriangles
};

inline constexpr std::size_t kMostOuterTriangles = 32;

// The whole scene where leaving out the largest triangles does not make its longest side four times shorter.
SceneCore findCore(const Scene& scene);

}  // namespace halfsilver
