#include "frame/layers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/ray_kinds.h>

namespace halfsilver {
namespace {

using shared::Hit;
using shared::HitSurface;
using shared::Ray;
using shared::RayPath;

enum Layer : std::size_t {
  R,
  G,
  B,
  A,
  depthZ,
  normalX,
  normalY,
  normalZ,
  reflectivityY,
  selectedY,
  hitT,
  hitId,
  hitNx,
  hitNy,
  hitNz,
  reflectionR,
  reflectionG,
  reflectionB,
  layerCount
};

// Normals of hits that have no stored one, from the vertices.
class VertexNormals {
 public:
  explicit VertexNormals(const GpuScene& scene)
      : triangles_(scene.triangles.read<glm::uvec4>(scene.triangleCount)),
        attributes_(scene.attributes.read<shared::VertexAttributes>(scene.vertexCount)) {}

  glm::vec3 at(const Hit& hit) const {
    const glm::uvec4 corners = triangles_[hit.triangle];
    const auto normal = [&](glm::uint corner) { return attributes_[corner].normal; };
    return (1.0f - hit.u - hit.v) * normal(corners.x) + hit.u * normal(corners.y) + hit.v * normal(corners.z);
  }

 private:
  std::vector<glm::uvec4> triangles_;
  std::vector<shared::VertexAttributes> attributes_;
};

std::vector<std::uint32_t> pixelsOf(const RayQueue& rays, std::uint32_t count) {
  if (rays.ofPixels()) return rays.rays.read<std::uint32_t>(count);
  std::vector<std::uint32_t> pixels;
  for (const RayPath& path : rays.paths.read<RayPath>(count)) pixels.push_back(path.pixel);
  return pixels;
}

void addHits(Image& image, const FrameView& view, const RayBatch& batch, std::span<const glm::vec4> normals,
             RayReader& reader, std::optional<VertexNormals>& vertexNormals) {
  reader.submit(view, batch.rays, 0);
  const std::span<const Ray> queue = reader.rays(view, batch.rays);
  const auto count = static_cast<std::uint32_t>(queue.size());
  const std::vector<std::uint32_t> pixels = pixelsOf(batch.rays, count);
  const std::vector<Hit> results = batch.hits.hits.read<Hit>(count);
  std::vector<HitSurface> surfaces;
  if (batch.hits.surfaces)
    surfaces = batch.hits.surfaces.read<HitSurface>(count);
  else if (!vertexNormals)
    vertexNormals.emplace(view.scene);

  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t pixel = pixels[i];
    if (normals[pixel].w < 0) continue;  // no reflection, see GBuffer::normal
    const std::size_t row = height - 1 - pixel / width;
    float* out = &image.data[(row * width + pixel % width) * layerCount];
    out[selectedY] = 1;
    out[hitT] = results[i].t;
    if (results[i].t < 0) continue;
    out[hitId] = static_cast<float>(results[i].triangle);
    glm::vec3 normal = vertexNormals ? vertexNormals->at(results[i]) : surfaces[i].normal;
    if (glm::dot(normal, normal) > 0) normal = glm::normalize(normal);
    if (glm::dot(normal, queue[i].direction) > 0) normal = -normal;
    for (std::size_t axis = 0; axis < 3; ++axis) out[hitNx + axis] = normal[static_cast<glm::length_t>(axis)];
  }
}

// With more channels; a pixel's values lie side by side.
Image withChannels(const Image& image, std::initializer_list<std::string> names, std::span<const float> values) {
  const std::size_t before = image.channels.size(), more = names.size();
  Image result{image.width, image.height, image.channels, {}};
  result.channels.insert(result.channels.end(), names.begin(), names.end());
  result.data.reserve(image.pixelCount() * (before + more));
  for (std::size_t pixel = 0; pixel < image.pixelCount(); ++pixel) {
    const auto present = image.data.begin() + static_cast<std::ptrdiff_t>(pixel * before);
    result.data.insert(result.data.end(), present, present + static_cast<std::ptrdiff_t>(before));
    const std::span<const float> added = values.subspan(pixel * more, more);
    result.data.insert(result.data.end(), added.begin(), added.end());
  }
  return result;
}

// The index of a G-buffer's pixel in an image, whose rows begin at the top.
std::size_t fromTop(const Image& image, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  return (height - 1 - pixel / width) * width + pixel % width;
}

// Down is positive.
Image withMotion(const Image& image, const gl::Texture& motion) {
  std::vector<glm::vec2> texels(image.pixelCount());
  std::vector<float> values(2 * image.pixelCount());
  motion.read(GL_RG, GL_FLOAT, texels.size() * sizeof(glm::vec2), texels.data());
  for (std::size_t pixel = 0; pixel < texels.size(); ++pixel) {
    values[2 * fromTop(image, pixel)] = texels[pixel].x;
    values[2 * fromTop(image, pixel) + 1] = 0.0f - texels[pixel].y;
  }
  return withChannels(image, {"motion.X", "motion.Y"}, values);
}

// Of how many lights the shadows are in doubt, and how many light the pixel for certain.
Image withShadows(const Image& image, const gl::Texture& marks) {
  const auto layers = static_cast<std::size_t>(marks.shape().depth), pixels = image.pixelCount();
  std::vector<glm::uvec2> texels(pixels * layers);
  marks.read(GL_RG_INTEGER, GL_UNSIGNED_INT, texels.size() * sizeof(glm::uvec2), texels.data());
  std::vector<float> values(2 * pixels, 0.0f);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    float* value = &values[2 * fromTop(image, i % pixels)];
    value[0] += static_cast<float>(std::popcount(texels[i].x & texels[i].y));
    value[1] += static_cast<float>(std::popcount(texels[i].x & ~texels[i].y));
  }
  return withChannels(image, {"shadow.marked", "shadow.lit"}, values);
}

Image withWork(const Image& image, const RayBatch& batch, std::span<const shared::RayWork> work) {
  std::vector<float> values(2 * image.pixelCount(), 0.0f);
  const std::vector<std::uint32_t> pixels = pixelsOf(batch.rays, static_cast<std::uint32_t>(work.size()));
  for (std::size_t i = 0; i < work.size(); ++i) {
    values[2 * fromTop(image, pixels[i])] = static_cast<float>(work[i].steps);
    values[2 * fromTop(image, pixels[i]) + 1] = static_cast<float>(work[i].tests);
  }
  return withChannels(image, {"work.steps", "work.tests"}, values);
}

Image withAnswers(const Image& image, std::span<const RayBatch> batches,
                  std::span<const std::vector<std::uint32_t>> answers) {
  std::vector<float> values(image.pixelCount(), 0.0f);
  for (std::size_t batch = 0; batch < answers.size(); ++batch) {
    const std::vector<std::uint32_t>& those = answers[batch];
    const std::vector<std::uint32_t> pixels = pixelsOf(batches[batch].rays, static_cast<std::uint32_t>(those.size()));
    for (std::size_t i = 0; i < those.size(); ++i) values[fromTop(image, pixels[i])] = static_cast<float>(those[i]);
  }
  return withChannels(image, {"answered.Y"}, values);
}

}  // namespace

Image assembleLayers(const FrameView& view, const gl::Texture& linear, std::span<const RayBatch> batches,
                     std::span<const shared::RayWork> work, std::span<const std::vector<std::uint32_t>> answers,
                     const SurfaceReader& surfaces, RayReader& reader) {
  const GBuffer& gbuffer = view.gbuffer;
  Image image{gbuffer.width,
              gbuffer.height,
              {"R", "G", "B", "A", "depth.Z", "normal.X", "normal.Y", "normal.Z", "reflectivity.Y", "selected.Y",
               "hit.T", "hit.id", "hit.nx", "hit.ny", "hit.nz", "reflection.R", "reflection.G", "reflection.B"},
              {}};
  image.data.assign(image.pixelCount() * layerCount, 0.0f);
  const std::vector<glm::vec4> color = readTexels(linear), reflection = readTexels(gbuffer.reflection);
  const auto [position, normal] = surfaces.read(view);
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = (height - 1 - y) * width + x;
      float* out = &image.data[(y * width + x) * layerCount];
      for (glm::length_t c = 0; c < 4; ++c) out[R + static_cast<std::size_t>(c)] = color[pixel][c];
      out[hitT] = static_cast<float>(HIT_NOT_TRACED);
      out[hitId] = -1;
      for (glm::length_t c = 0; c < 3; ++c) out[reflectionR + static_cast<std::size_t>(c)] = reflection[pixel][c];
      if (position[pixel].w <= 0) continue;
      out[depthZ] = position[pixel].w;
      for (glm::length_t c = 0; c < 3; ++c) out[normalX + static_cast<std::size_t>(c)] = normal[pixel][c];
      out[reflectivityY] = std::max(normal[pixel].w, 0.0f);
    }
  std::optional<VertexNormals> vertexNormals;
  for (const RayBatch& batch : batches) addHits(image, view, batch, normal, reader, vertexNormals);
  if (gbuffer.motion) image = withMotion(image, gbuffer.motion);
  if (gbuffer.shadowMarks) image = withShadows(image, gbuffer.shadowMarks);
  if (!work.empty()) image = withWork(image, batches.front(), work);
  if (!answers.empty()) image = withAnswers(image, batches, answers);
  return image;
}

Image withTally(Image layers, const RayTally& tally, double diagonal) {
  for (std::size_t kind = 0; kind < tally.kinds.size(); ++kind) {
    const std::vector<shared::KindTally> pixels = tally.kinds[kind].read<shared::KindTally>(layers.pixelCount());
    if (std::all_of(pixels.begin(), pixels.end(), [](const shared::KindTally& pixel) { return pixel.rays == 0; }))
      continue;
    std::vector<float> values(3 * pixels.size());
    for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel) {
      const shared::KindTally& of = pixels[pixel];
      const double sum = diagonal * TALLY_UNIT * (0x1p32 * of.high + of.low);
      float* value = &values[3 * fromTop(layers, pixel)];
      value[0] = static_cast<float>(of.rays);
      value[1] = static_cast<float>(of.hits);
      value[2] = of.hits ? static_cast<float>(sum / of.hits) : 0.0f;
    }
    const std::string name = kRayKindNames[kind];
    layers = withChannels(layers, {"rays." + name, "hits." + name, "distance." + name}, values);
  }
  return layers;
}

}  // namespace halfsilver
