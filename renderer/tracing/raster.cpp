#include "tracing/raster.h"

#include <algorithm>

#include "gl/draw_state.h"

namespace halfsilver {
namespace {

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
  rasterize(api, program, vertexArray, shape.resolution, [&] {
    api.DrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(scene.triangleCount) * 3, shape.projections);
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
