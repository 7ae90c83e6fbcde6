#pragma once

#include <cstdint>

#include <halfsilver/products.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Triangles that a compute shader chooses (shaders/tracing/common/listed_triangles.glsl) and where they go: small ones
// are the invocations of a dispatch, since the rasterizer's setup would cost many times their few texels; large ones
// are rasterized. Both are indirect, so the host knows no counts.
class ListedTriangles {
 public:
  explicit ListedTriangles(const gl::Api& api) : api_(&api), vertexArray_(api) {}

  // An empty list with room for all triangles. With `ownAxis` each is in one projection, else in three.
  void begin(const GpuScene& scene, bool ownAxis);
  void bind() const;  // SSBO_LISTED_TRIANGLES

  // Runs a program that chooses, in `invocations`, mostly one per triangle. The caller has bound what it reads besides
  // the triangles.
  void choose(const gl::Program& program, const GpuScene& scene, std::size_t invocations) const;
  // Runs `small` (compute) over the small ones, then `large` over the large ones in a raster of that many texels along
  // each side. The caller has bound what they read.
  void visit(const gl::Program& small, const gl::Program& large, int resolution) const;
  void rasterizeLarge(const gl::Program& large, int resolution) const;

  std::uint64_t bytes() const { return list_.bytes(); }
  void releaseMemory() { list_ = gl::Buffer(); }

 private:
  const gl::Api* api_;
  gl::EmptyVertexArray vertexArray_;
  gl::Buffer list_;
};

}  // namespace halfsilver
