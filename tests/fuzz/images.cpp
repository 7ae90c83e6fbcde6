// An image of any format: decoded into as many values as its size says, or refused. Both ways to read one: as a file of
// its own, and as a texture of a scene.
#include "expect.h"
#include "io/gltf_images.h"
#include "io/small_codecs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfsilver;
  const std::span<const std::uint8_t> bytes(data, size);
  ImageFile file;
  std::string problem;
  if (decodeSmall(bytes, file, problem))
    fuzz::expect(file.image.data.size() == file.image.pixelCount() * file.image.channels.size(),
                 "another number of values");
  else
    fuzz::expect(!problem.empty() && problem.find('\n') == std::string::npos, "refused without a line");

  const gltf::ImageHeader header = gltf::imageHeader(bytes);
  if (header.format == gltf::ImageFormat::unknown || !canHold(bytes, double(header.size.x) * header.size.y)) return 0;
  // A WebP of one color is as large as it says in a few bytes, and would take all of a run's time.
  constexpr std::size_t kMostPixels = std::size_t{1} << 24;
  if (std::size_t{header.size.x} * header.size.y > kMostPixels) return 0;
  Texture texture;
  if (gltf::decodeImage(header, bytes, texture))
    fuzz::expect(texture.texels.size() == std::size_t{4} * header.size.x * header.size.y, "another number of texels");
  return 0;
}
