#include "tracing/raster.h"

#include <algorithm>

namespace halfsilver {

void rasterizeScene(const gl::Api& api, const gl::Program& program, const gl::EmptyVertexArray& vertexArray,
                    const GpuScene& scene, const RasterShape& shape, const gl::Buffer* indirect) {
  const gl::Framebuffer framebuffer(api, shape.resolution, shape.resolution);
  framebuffer.bind();
  api.Viewport(0, 0, shape.resolution, shape.resolution);
  api.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  for (const GLenum state :
       {GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_POLYGON_OFFSET_FILL})
    api.Disable(state);
  api.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  vertexArray.bind();
  program.use();
  if (indirect) {
    api.BindBuffer(GL_DRAW_INDIRECT_BUFFER, indirect->name());
    api.DrawArraysIndirect(GL_TRIANGLES, nullptr);
  } else {
    api.DrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(scene.triangleCount) * shape.verticesPerTriangle,
                            shape.projections);
  }
  api.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void dispatchFor(const gl::Api& api, const gl::Program& program, std::size_t count) {
  constexpr std::size_t kGroup = 64, kMostGroups = 65535;
  const std::size_t groups = (count + kGroup - 1) / kGroup;
  if (groups == 0) return;
  program.use();
  const std::size_t rows = (groups + kMostGroups - 1) / kMostGroups;
  api.DispatchCompute(static_cast<GLuint>(std::min(groups, kMostGroups)), static_cast<GLuint>(rows), 1);
}

}  // namespace halfsilver
