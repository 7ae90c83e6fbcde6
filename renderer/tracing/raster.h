#pragma once

#include <halfsilver/products.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

struct RasterShape {
  int resolution = 1;   // texels along each side
  int projections = 1;  // instances
};

// Draws all triangles with vertex pulling into a raster without attachments: no depth test, no culling; fragments write
// through storage buffers and images only. The caller has bound what the program reads.
void rasterizeScene(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray,
                    const GpuScene& scene, const RasterShape& shape);
// The same for an indirect draw, whose arguments begin the buffer.
void rasterizeListed(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray,
                     int resolution, const gl::Buffer& arguments);

// Runs a compute program of 64 invocations per group for `count` items, in two dimensions if one is too short; see the
// index computation in shaders/tracing/common/voxel_axis.comp. The caller has bound what the program reads.
void dispatchFor(const gl::Api& api, const gl::Program& program, std::size_t count);

}  // namespace halfsilver
