#include "tracing/raster.h"

#include <algorithm>

#include "gl/draw_state.h"

namespace halfsilver {
namespace {

// Of hardware, which is reset if a draw takes seconds; fragments with lists may be hundreds per triangle.
constexpr std::uint32_t kTrianglesPerDraw = 1u << 16;

// A raster without attachments lives as long as the draw.
template <class Draw>
void rasterize(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray, int resolution,
               const Draw& draw) {
  const gl::Framebuffer framebuffer(api, resolution, resolution);
  framebuffer.bind();
  gl::DrawState{.viewport = {0, 0, resolution, resolution}}.apply(api);
  vertexArray.bind();
  program.use();
  draw();
}

}  // namespace

void rasterizeScene(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray,
                    const GpuScene& scene, const RasterShape& shape) {
  const std::uint32_t perDraw = api.software ? scene.triangleCount : kTrianglesPerDraw;
  rasterize(api, program, vertexArray, shape.resolution, [&] {
    for (std::uint32_t first = 0; first < scene.triangleCount; first += perDraw) {
      if (first > 0) api.Flush();
      api.DrawArraysInstanced(GL_TRIANGLES, static_cast<GLint>(3 * first),
                              static_cast<GLsizei>(3 * std::min(perDraw, scene.triangleCount - first)),
                              shape.projections);
    }
  });
}

void rasterizeListed(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray,
                     int resolution, const gl::Buffer& arguments) {
  rasterize(api, program, vertexArray, resolution, [&] {
    api.BindBuffer(GL_DRAW_INDIRECT_BUFFER, arguments.name());
    api.DrawArraysIndirect(GL_TRIANGLES, nullptr);
  });
}

void dispatchFor(const gl::Api& api, const gl::Program& program, std::size_t count) {
  constexpr std::size_t kGroup = 64, kMaxGroups = 65535;
  const std::size_t groups = (count + kGroup - 1) / kGroup;
  if (groups == 0) return;
  program.use();
  const std::size_t rows = (groups + kMaxGroups - 1) / kMaxGroups;
  api.DispatchCompute(static_cast<GLuint>(std::min(groups, kMaxGroups)), static_cast<GLuint>(rows), 1);
}

}  // namespace halfsilver
