#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/gl/texture.h>
#include <halfsilver/scene.h>

// The scene's textures as a few 2D arrays of equal size ("buckets"), which shaders can index without bindless textures.
namespace halfsilver {

// Textures of one size and encoding that share a bucket, or several if they exceed the layers of one.
struct TextureGroup {
  int width = 0, height = 0;  // of the bucket; textures of another size are resampled to it
  bool srgb = false;
  std::vector<int> textures;  // into Scene::textures
};

struct TextureRequest {
  int texture = 0;  // into Scene::textures
  int width = 0, height = 0;
  bool srgb = false;
};

struct BucketLimits {
  int textureSize = 0;  // texels along an edge
  int layers = 0;
  int buckets = 0;
};

// At most limits.buckets buckets: the rarest sizes join the nearest size of the same encoding.
std::vector<TextureGroup> planBuckets(std::span<const TextureRequest> requests, const BucketLimits& limits);
// Buckets that a group takes.
int bucketCount(const TextureGroup& group, const BucketLimits& limits);

// The texture at another size: averaged down, interpolated up, in linear light if it is sRGB-encoded.
Texture resample(const Texture& texture, int width, int height);

struct MaterialTextures {
  std::vector<gl::Texture> buckets;      // at least one, at most TEXTURE_BUCKETS
  std::vector<std::uint32_t> locations;  // a texture of the scene: bucket << 16 | layer, or NO_TEXTURE if unused
  std::vector<std::string> warnings;
};

// Uploads the textures that materials use, with mipmaps. Throws Error (badInput) for a texture without texels and Error
// (failed) when out of memory.
MaterialTextures uploadTextures(const gl::Api& api, const Scene& scene);

// The sky's image with mipmaps, rows from the top; 1 x 1 black if the sky is a gradient. A larger image than the
// device takes is halved until it fits.
gl::Texture uploadSky(const gl::Api& api, const Sky& sky);

}  // namespace halfsilver
