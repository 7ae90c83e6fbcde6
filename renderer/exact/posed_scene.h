#pragma once

#include <cstdint>

#include <halfsilver/products.h>
#include <halfsilver/scene.h>
#include <halfsilver/scene_change.h>

namespace halfsilver {

// What rays need of a scene that the GPU poses: the caller's copy does not follow, so this one reads the GPU's vertices
// and windings back. All rays then see the same floats.
class PosedScene {
 public:
  PosedScene(const Scene& source, const GpuScene& posed);

  // Reads what the change moved. Waits for the GPU.
  void follow(const GpuScene& posed, const SceneChange& change);
  void copyMaterials(const Scene& source);

  const Scene& scene() const { return scene_; }
  std::uint64_t bytes() const;

 private:
  void readVertices(const GpuScene& posed, const VertexRange& range);
  void readTriangles(const GpuScene& posed, const TriangleRange& range);

  Scene scene_;
};

}  // namespace halfsilver
