#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/scene.h>

namespace halfsilver {

// Where nearly all triangles of a scene are. A few large ones, such as a ground that reaches to the horizon, would
// otherwise stretch a voxel grid until everything else is in one voxel.
struct SceneCore {
  Bounds bounds;                     // relative to Scene::origin
  std::vector<std::uint32_t> outer;  // triangles that reach beyond; at most kMaxOuterTriangles
};

inline constexpr std::size_t kMaxOuterTriangles = 32;

// The whole scene, unless leaving out the largest triangles makes its longest side at least four times shorter.
SceneCore findCore(const Scene& scene);

}  // namespace halfsilver
