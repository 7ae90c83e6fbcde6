#pragma once

#include <vector>

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "tracing/bvh/wide_bvh.h"
#include "tracing/grid.h"
#include "tracing/trace_pass.h"

namespace halfsilver {

// A bounding volume hierarchy in a compute shader: what users would build instead of an A-buffer, and the yardstick of
// the other methods. Made on the CPU from the triangles on the GPU, which are read back once, and kept while nothing
// moves. What moves is read back, and the boxes are fitted to it; when that has made the tree much worse than a new
// one, a new one is made.
//
// Sources: Wald 2007 (splits by binning), Ylitie, Karras & Laine 2017 (wide nodes with quantized boxes).
class BvhTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  BvhTracer(const gl::Api& api, const Settings& settings);

  // Waits for the GPU when something moved.
  void update(const FrameView& view, const SceneChange& change) override;
  void forget() override { built_ = false; }
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  TracerMemory memory() const override;
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }

 private:
  void readScene(const GpuScene& scene);
  void readMoved(const GpuScene& scene, const std::vector<VertexRange>& moved);
  std::vector<Bounds> boxes() const;
  void build();

  const gl::Api* api_;
  TracePass tracePass_;
  Grid grid_;  // the bounds alone: rays begin and end there
  std::vector<glm::uvec4> triangles_;
  std::vector<glm::vec3> positions_;
  WideBvh bvh_;
  double builtCost_ = 0;  // of bvh_ when it was made
  gl::Buffer nodes_, numbers_;
  bool built_ = false;  // for the geometry of the last update
};

}  // namespace halfsilver
