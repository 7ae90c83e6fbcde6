#pragma once

#include <memory>
#include <random>
#include <utility>

#include <halfsilver/scene.h>
#include "gpu/shader_function.h"

namespace halfsilver::testing {

inline std::shared_ptr<Texture> noise(int width, int height, bool srgb, unsigned seed) {
  std::minstd_rand random(seed);
  auto texture = plainTexture(width, height, {0, 0, 0, 0}, srgb);
  for (std::uint8_t& value : texture->texels) value = static_cast<std::uint8_t>(random() >> 8);
  return texture;
}

inline Scene quadWith(const TextureUse& use, std::shared_ptr<const Texture> texture) {
  Scene scene;
  Material material;
  material.baseColorTexture = use;
  material.baseColorTexture.texture = 0;
  scene.materials = {material};
  scene.textures = {std::move(texture)};
  addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 0);
  return scene;
}

}  // namespace halfsilver::testing
