#include "frame/alpha_texels.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

constexpr std::size_t kAlphasPerTexel = 4;  // in a word, the first in its lowest byte, whatever the host's order

std::vector<std::uint32_t> pack(const std::vector<std::uint8_t>& alphas) {
  std::vector<std::uint32_t> words((alphas.size() + kAlphasPerTexel - 1) / kAlphasPerTexel);
  for (std::size_t i = 0; i < alphas.size(); ++i)
    words[i / kAlphasPerTexel] |= std::uint32_t{alphas[i]} << (8 * (i % kAlphasPerTexel));
  return words;
}

void checkLimit(const gl::Api& api, std::size_t alphas) {
  constexpr auto kMaxNumber = std::size_t{std::numeric_limits<std::int32_t>::max()};  // shaders count with int
  const std::size_t limit = std::min(static_cast<std::size_t>(api.limits.bufferTexels) * kAlphasPerTexel, kMaxNumber);
  if (alphas > limit)
    throw Error(ErrorKind::failed, "the textures that cut holes have " + std::to_string(alphas) +
                                       " texels in all, the device's limit for their alpha is " +
                                       std::to_string(limit));
}

}  // namespace

AlphaTexels uploadAlphas(const gl::Api& api, const Scene& scene, const std::vector<bool>& holes) {
  AlphaTexels result;
  result.places.resize(scene.materials.size());
  std::map<int, AlphaPlace> known;  // by texture
  std::vector<std::uint8_t> alphas;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const int number = scene.materials[m].baseColorTexture.texture;
    if (!holes[m] || number < 0) continue;
    const auto [place, isNew] = known.try_emplace(number);
    if (isNew) {
      const Texture& texture = *scene.textures[static_cast<std::size_t>(number)];
      place->second = {static_cast<std::uint32_t>(alphas.size()), static_cast<std::uint32_t>(texture.width),
                       static_cast<std::uint32_t>(texture.height)};
      checkLimit(api, alphas.size() + texture.texels.size() / 4);
      for (std::size_t i = 3; i < texture.texels.size(); i += 4) alphas.push_back(texture.texels[i]);
    }
    result.places[m] = place->second;
  }
  result.texels = gl::makeTexelBuffer<std::uint32_t>(api, pack(alphas), "alpha of cut textures", gl::kWordTexels);
  return result;
}

}  // namespace halfsilver
