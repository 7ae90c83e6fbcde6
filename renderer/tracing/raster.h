#pragma once

#include <halfsilver/products.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

struct RasterShape {
  int resolution = 1;           // texels along each side
  int projections = 1;          // instances
  int verticesPerTriangle = 3;  // 6: conservative
};

// Draws all triangles, or those of `indirect` (an indirect draw's arguments), with vertex pulling into a raster without
// attachments: no depth test, no culling; fragments write through storage buffers and images only. The caller has bound
// what the program reads.
void rasterizeScene(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray,
                    const GpuScene& scene, const RasterShape& shape, const gl::Buffer* indirect = nullptr);

// Runs a compute program of 64 invocations per group for `count` items, in two dimensions if one is too short; see the
// index computation in shaders/tracing/common/voxel_axis.comp. The caller has bound what the program reads.
void dispatchFor(const gl::Api& api, const gl::Program& program, std::size_t count);

}  // namespace halfsilver
