#include <halfsilver/products.h>

namespace halfsilver {

std::size_t GpuScene::geometryBytes() const {
  return positions.bytes() + attributes.bytes() + triangles.bytes() + materials.bytes() + drawList.bytes() +
         indices.bytes();
}

std::size_t GpuScene::textureBytes() const {
  std::size_t sum = sky.bytes() + skyTable.sums.bytes() + alphas.bytes();
  for (const gl::Texture& texture : textures) sum += texture.bytes();
  return sum;
}

void GpuScene::bindTriangles() const {
  positions.bindStorage(SSBO_POSITIONS);
  triangles.bindStorage(SSBO_TRIANGLES);
}

void GpuScene::bindSurfaces() const {
  bindTriangles();
  attributes.bindStorage(SSBO_ATTRIBUTES);
  materials.bindStorage(SSBO_MATERIALS);
  alphas.bind(UNIT_ALPHA);
  // Units without a bucket of their own are never read, but must hold a texture of the right kind.
  for (std::size_t bucket = 0; bucket < TEXTURE_BUCKETS; ++bucket)
    textures[bucket < textures.size() ? bucket : 0].bind(static_cast<GLuint>(UNIT_MATERIAL_TEXTURES + bucket));
}

void ShadowMaps::bind() const {
  lights.bind(UNIT_LIGHTS);
  maps.bind(UNIT_SHADOW_MAPS);
}

std::size_t GBuffer::bytes() const {
  std::size_t sum = 0;
  for (const gl::Texture* texture : {&depth, &visibility, &normal, &material, &lobes, &coat, &shaded, &reflection,
                                     &seen, &occlusion, &motion, &shadowMarks, &tested})
    sum += texture->bytes();
  return sum;
}

void GBuffer::bindSurface() const {
  normal.bind(UNIT_NORMAL);
  material.bind(UNIT_MATERIAL);
  visibility.bind(UNIT_VISIBILITY);
  (coat ? coat : material).bind(UNIT_COAT);
  if (lobes) lobes.bind(UNIT_LOBES);
  shaded.bindImage(IMAGE_SHADED, GL_READ_WRITE);
  reflection.bindImage(IMAGE_REFLECTION, GL_READ_WRITE);
}

}  // namespace halfsilver
