#include "frame/surface_reader.h"

#include "shared/passes/read_surfaces.h"

namespace halfsilver {

SurfaceReader::SurfaceReader(const gl::Api& api)
    : api_(&api), program_(gl::Program::compute(api, "passes/read_surfaces.comp")) {}

Surfaces SurfaceReader::read(const FrameView& view, int x, int y, int width, int height) const {
  const gl::Texture::Shape shape{.format = GL_RGBA32F, .width = width, .height = height};
  const gl::Texture positions(*api_, shape, "positions for the host"), normals(*api_, shape, "normals for the host");
  program_.use();
  program_.set("firstColumn", x);
  program_.set("firstRow", y);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.gbuffer.visibility.bind(UNIT_VISIBILITY);
  view.gbuffer.normal.bind(UNIT_NORMAL);
  positions.bindImage(IMAGE_READ_POSITION, GL_WRITE_ONLY);
  normals.bindImage(IMAGE_READ_NORMAL, GL_WRITE_ONLY);
  constexpr int kGroup = 8;
  api_->DispatchCompute(static_cast<GLuint>((width + kGroup - 1) / kGroup),
                        static_cast<GLuint>((height + kGroup - 1) / kGroup), 1);
  // This dispatch writes images that the host reads.
  api_->MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  return {readTexels(positions), readTexels(normals)};
}

std::vector<glm::vec4> readTexels(const gl::Texture& texture) {
  std::vector<glm::vec4> texels(static_cast<std::size_t>(texture.shape().width) *
                                static_cast<std::size_t>(texture.shape().height));
  texture.read(GL_RGBA, GL_FLOAT, texels.size() * sizeof(glm::vec4), texels.data());
  return texels;
}

}  // namespace halfsilver
