#include "tracing/raster.h"

#include <algorithm>

#include "gl/draw_state.h"

namespace halfsilver {

void rasterizeScene(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray,
                    const GpuScene& scene, const RasterShape& shape, const gl::Buffer* indirect) {
  const gl::Framebuffer framebuffer(api, shape.resolution, shape.resolution);
  framebuffer.bind();
  gl::DrawState{.viewport = {0, 0, shape.resolution, shape.resolution}}.apply(api);
  vertexArray.bind();
  program.use();
  if (indirect) {
    api.BindBuffer(GL_DRAW_INDIRECT_BUFFER, indirect->name());
    api.DrawArraysIndirect(GL_TRIANGLES, nullptr);
  } else {
    api.DrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(scene.triangleCount) * shape.verticesPerTriangle,
                            shape.projections);
  }
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
