#include "frame/material_textures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <halfsilver/error.h>
#include <halfsilver/shared_structs.h>
#include "frame/pack_material.h"

namespace halfsilver {
namespace {

constexpr std::size_t kChannels = 4;
constexpr std::size_t kBucketBytes = std::size_t{1} << 30;  // some drivers refuse larger textures
constexpr int kAnisotropy = 8;
constexpr float kLargestHalf = 65504.0f;

std::size_t area(int width, int height) { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

int mipmapLevels(int width, int height) { return std::bit_width(static_cast<unsigned>(std::max(width, height))); }

int layersOf(const TextureGroup& group, const BucketLimits& limits) {
  const std::size_t fitting = std::max<std::size_t>(1, kBucketBytes / (kChannels * area(group.width, group.height)));
  return static_cast<int>(std::min<std::size_t>(fitting, static_cast<std::size_t>(limits.layers)));
}

// Doublings from one size to the other; shrinking loses detail and counts twice.
double distance(const TextureGroup& from, const TextureGroup& to) {
  const auto along = [](int a, int b) {
    const double doublings = std::log2(static_cast<double>(b) / a);
    return doublings < 0 ? -2 * doublings : doublings;
  };
  return along(from.width, to.width) + along(from.height, to.height);
}

std::size_t nearestPartner(const std::vector<TextureGroup>& candidates, std::size_t which) {
  std::size_t best = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i == which || candidates[i].srgb != candidates[which].srgb) continue;
    if (best == candidates.size() ||
        distance(candidates[which], candidates[i]) < distance(candidates[which], candidates[best]))
      best = i;
  }
  return best;
}

// The group with the fewest textures that has a partner.
std::size_t rarest(const std::vector<TextureGroup>& candidates) {
  std::size_t best = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (nearestPartner(candidates, i) < candidates.size() &&
        (best == candidates.size() || candidates[i].textures.size() < candidates[best].textures.size()))
      best = i;
  return best;
}

// Weights of source texels for one destination texel along one axis.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Taps> tapsAlong(int from, int to) {
  std::vector<Taps> taps(static_cast<std::size_t>(to));
  const double scale = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Taps& tap = taps[static_cast<std::size_t>(i)];
    if (scale > 1) {  // the average of what the destination texel covers
      const double low = i * scale, high = (i + 1) * scale;
      tap.first = static_cast<int>(low);
      for (int s = tap.first; s < from && s < high; ++s)
        tap.weights.push_back(static_cast<float>((std::min<double>(high, s + 1) - std::max<double>(low, s)) / scale));
    } else {
      const double center = std::clamp((i + 0.5) * scale - 0.5, 0.0, from - 1.0);
      tap.first = std::min(static_cast<int>(center), std::max(0, from - 2));
      const float weight = static_cast<float>(center - tap.first);
      tap.weights = {1 - weight};
      if (from > 1) tap.weights.push_back(weight);
    }
  }
  return taps;
}

float decode(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float encode(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

bool hasExtension(const gl::Api& api, std::string_view name) {
  GLint count = 0;
  api.GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i) {
    const GLubyte* extension = api.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
    if (extension && name == reinterpret_cast<const char*>(extension)) return true;
  }
  return false;
}

bool hasAnisotropy(const gl::Api& api) {
  // llvmpipe (Mesa 22.3) reads the coarsest level if an anisotropic texture is sampled with explicit gradients.
  return !api.software && (hasExtension(api, "GL_EXT_texture_filter_anisotropic") ||
                           hasExtension(api, "GL_ARB_texture_filter_anisotropic"));
}

std::vector<TextureRequest> requestsOf(const Scene& scene) {
  std::vector<bool> used(scene.textures.size());
  for (const Material& material : scene.materials)
    for (const TextureUse* use : textureUses(material))
      if (use->texture >= 0) used[static_cast<std::size_t>(use->texture)] = true;
  std::vector<TextureRequest> requests;
  for (std::size_t t = 0; t < used.size(); ++t) {
    if (!used[t]) continue;
    const Texture& texture = *scene.textures[t];
    requests.push_back({static_cast<int>(t), texture.width, texture.height, texture.srgb});
  }
  return requests;
}

gl::Texture makeBucket(const gl::Api& api, const TextureGroup& group, int layers) {
  return gl::Texture(api,
                     {GL_TEXTURE_2D_ARRAY, static_cast<GLenum>(group.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8), group.width,
                      group.height, layers, mipmapLevels(group.width, group.height)},
                     "material textures");
}

void finishBucket(const gl::Api& api, const gl::Texture& bucket, bool anisotropic) {
  bucket.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  bucket.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  bucket.parameter(GL_TEXTURE_WRAP_S, GL_REPEAT);
  bucket.parameter(GL_TEXTURE_WRAP_T, GL_REPEAT);
  if (anisotropic) bucket.parameter(GL_TEXTURE_MAX_ANISOTROPY, kAnisotropy);
  if (bucket.shape().levels > 1) api.GenerateTextureMipmap(bucket.name());
}

std::string sizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

std::string resamplingWarning(const Texture& texture, const TextureGroup& group) {
  return "texture '" + texture.name + "' is resampled from " + sizeText(texture.width, texture.height) + " to " +
         sizeText(group.width, group.height);
}

}  // namespace

int bucketCount(const TextureGroup& group, const BucketLimits& limits) {
  const int layers = layersOf(group, limits);
  return (static_cast<int>(group.textures.size()) + layers - 1) / layers;
}

std::vector<TextureGroup> planBuckets(std::span<const TextureRequest> requests, const BucketLimits& limits) {
  std::vector<TextureGroup> candidates;
  for (const TextureRequest& request : requests) {
    const int width = std::min(request.width, limits.textureSize);
    const int height = std::min(request.height, limits.textureSize);
    auto place = std::find_if(candidates.begin(), candidates.end(), [&](const TextureGroup& candidate) {
      return candidate.width == width && candidate.height == height && candidate.srgb == request.srgb;
    });
    if (place == candidates.end()) place = candidates.insert(candidates.end(), {width, height, request.srgb, {}});
    place->textures.push_back(request.texture);
  }
  const auto buckets = [&] {
    int sum = 0;
    for (const TextureGroup& candidate : candidates) sum += bucketCount(candidate, limits);
    return sum;
  };
  while (buckets() > limits.buckets) {
    const std::size_t which = rarest(candidates);
    if (which < candidates.size()) {
      TextureGroup& partner = candidates[nearestPartner(candidates, which)];
      std::vector<int>& moved = candidates[which].textures;
      partner.textures.insert(partner.textures.end(), moved.begin(), moved.end());
      candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(which));
      continue;
    }
    // One size an encoding is left: too many layers, so smaller ones.
    TextureGroup& largest = *std::max_element(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
      return bucketCount(a, limits) < bucketCount(b, limits);
    });
    if (largest.width == 1 && largest.height == 1)
      throw Error(ErrorKind::failed, "the scene has more textures than the device can hold in " +
                                         std::to_string(limits.buckets) + " arrays");
    largest.width = std::max(1, largest.width / 2);
    largest.height = std::max(1, largest.height / 2);
  }
  return candidates;
}

Texture resample(const Texture& texture, int width, int height) {
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const float value = static_cast<float>(i) / 255.0f;
    linear[i] = texture.srgb ? decode(value) : value;
  }
  const std::vector<Taps> columns = tapsAlong(texture.width, width), rows = tapsAlong(texture.height, height);
  const auto sourceWidth = static_cast<std::size_t>(texture.width);
  const auto targetWidth = static_cast<std::size_t>(width);
  std::vector<float> narrow(targetWidth * static_cast<std::size_t>(texture.height) * kChannels, 0.0f);
  for (std::size_t y = 0; y < static_cast<std::size_t>(texture.height); ++y)
    for (std::size_t x = 0; x < targetWidth; ++x)
      for (std::size_t tap = 0; tap < columns[x].weights.size(); ++tap) {
        const std::size_t source = (y * sourceWidth + static_cast<std::size_t>(columns[x].first) + tap) * kChannels;
        float* target = &narrow[(y * targetWidth + x) * kChannels];
        for (std::size_t c = 0; c < 3; ++c) target[c] += columns[x].weights[tap] * linear[texture.texels[source + c]];
        target[3] += columns[x].weights[tap] * static_cast<float>(texture.texels[source + 3]) / 255.0f;
      }
  Texture result{texture.name, width, height, texture.srgb, {}};
  result.texels.resize(area(width, height) * kChannels);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
    for (std::size_t i = 0; i < targetWidth * kChannels; ++i) {
      float sum = 0;
      for (std::size_t tap = 0; tap < rows[y].weights.size(); ++tap)
        sum += rows[y].weights[tap] *
               narrow[(static_cast<std::size_t>(rows[y].first) + tap) * targetWidth * kChannels + i];
      const float value = texture.srgb && i % kChannels != 3 ? encode(sum) : sum;
      result.texels[y * targetWidth * kChannels + i] =
          static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
    }
  return result;
}

MaterialTextures uploadTextures(const gl::Api& api, const Scene& scene) {
  const std::vector<TextureRequest> requests = requestsOf(scene);
  for (const TextureRequest& request : requests) {
    const Texture& texture = *scene.textures[static_cast<std::size_t>(request.texture)];
    if (texture.width < 1 || texture.height < 1 ||
        texture.texels.size() != area(texture.width, texture.height) * kChannels)
      throw Error(ErrorKind::badInput, "texture '" + texture.name + "' has " + std::to_string(texture.texels.size()) +
                                           " bytes, its size is " + sizeText(texture.width, texture.height));
  }
  const BucketLimits limits{api.limits.textureSize, api.limits.arrayLayers, TEXTURE_BUCKETS};
  const bool anisotropic = hasAnisotropy(api);
  MaterialTextures result;
  result.locations.assign(scene.textures.size(), NO_TEXTURE);
  for (const TextureGroup& group : planBuckets(requests, limits)) {
    const auto perBucket = static_cast<std::size_t>(layersOf(group, limits));
    for (std::size_t first = 0; first < group.textures.size(); first += perBucket) {
      const std::size_t layers = std::min(perBucket, group.textures.size() - first);
      gl::Texture bucket = makeBucket(api, group, static_cast<int>(layers));
      for (std::size_t layer = 0; layer < layers; ++layer) {
        const auto index = static_cast<std::size_t>(group.textures[first + layer]);
        const Texture* texture = scene.textures[index].get();
        Texture resized;
        if (texture->width != group.width || texture->height != group.height) {
          result.warnings.push_back(resamplingWarning(*texture, group));
          resized = resample(*texture, group.width, group.height);
          texture = &resized;
        }
        api.TextureSubImage3D(bucket.name(), 0, 0, 0, static_cast<GLint>(layer), group.width, group.height, 1, GL_RGBA,
                              GL_UNSIGNED_BYTE, texture->texels.data());
        result.locations[index] =
            static_cast<std::uint32_t>(result.buckets.size() << 16) | static_cast<std::uint32_t>(layer);
      }
      finishBucket(api, bucket, anisotropic);
      result.buckets.push_back(std::move(bucket));
    }
  }
  // Shaders sample a bucket even if no material has a texture.
  if (result.buckets.empty()) result.buckets.push_back(makeBucket(api, {1, 1, false, {}}, 1));
  return result;
}

gl::Texture uploadSky(const gl::Api& api, const Sky& sky) {
  if (sky.image.empty()) return gl::Texture(api, {GL_TEXTURE_2D, GL_RGBA16F, 1, 1, 1, 1}, "sky");
  int width = sky.imageWidth, height = sky.imageHeight;
  if (width < 1 || height < 1 || sky.image.size() != 3 * area(width, height))
    throw Error(ErrorKind::badInput, "the sky's image has " + std::to_string(sky.image.size()) +
                                         " values, its size is " + sizeText(width, height));
  std::vector<float> texels(sky.image.size());
  std::transform(sky.image.begin(), sky.image.end(), texels.begin(), [](float value) {
    return value > 0 ? std::min(value, kLargestHalf) : 0.0f;  // also not a number
  });
  while (width > api.limits.textureSize || height > api.limits.textureSize) {
    const int halfWidth = std::max(1, width / 2), halfHeight = std::max(1, height / 2);
    std::vector<float> half(3 * area(halfWidth, halfHeight));
    for (int y = 0; y < halfHeight; ++y)
      for (int x = 0; x < halfWidth; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          float sum = 0;
          for (const int sourceY : {std::min(2 * y, height - 1), std::min(2 * y + 1, height - 1)})
            for (const int sourceX : {std::min(2 * x, width - 1), std::min(2 * x + 1, width - 1)})
              sum += texels[3 * (area(width, sourceY) + static_cast<std::size_t>(sourceX)) + c];
          half[3 * (area(halfWidth, y) + static_cast<std::size_t>(x)) + c] = 0.25f * sum;
        }
    texels = std::move(half);
    width = halfWidth;
    height = halfHeight;
  }
  gl::Texture texture(api, {GL_TEXTURE_2D, GL_RGBA16F, width, height, 1, mipmapLevels(width, height)}, "sky");
  api.TextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGB, GL_FLOAT, texels.data());
  api.GenerateTextureMipmap(texture.name());
  texture.parameter(GL_TEXTURE_WRAP_S, GL_REPEAT);
  texture.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  texture.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

}  // namespace halfsilver
