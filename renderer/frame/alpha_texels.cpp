#include "frame/alpha_texels.h"

#include <map>

namespace halfsilver {

AlphaTexels uploadAlphas(const gl::Api& api, const Scene& scene, const std::vector<bool>& holes) {
  AlphaTexels result;
  result.places.resize(scene.materials.size());
  std::map<int, AlphaPlace> known;  // by texture
  std::vector<std::uint8_t> bytes;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const int number = scene.materials[m].baseColorTexture.texture;
    if (!holes[m] || number < 0) continue;
    const auto [place, isNew] = known.try_emplace(number);
    if (isNew) {
      const Texture& texture = *scene.textures[static_cast<std::size_t>(number)];
      place->second = {static_cast<std::uint32_t>(bytes.size()), static_cast<std::uint32_t>(texture.width),
                       static_cast<std::uint32_t>(texture.height)};
      for (std::size_t i = 3; i < texture.texels.size(); i += 4) bytes.push_back(texture.texels[i]);
    }
    result.places[m] = place->second;
  }
  result.texels = gl::makeTexelBuffer<std::uint8_t>(api, bytes, "alpha of cut textures", gl::kByteTexels);
  return result;
}

}  // namespace halfsilver
