#include "builtin/procedural_textures.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "builtin/random.h"

namespace halfsilver {
namespace {

using glm::vec2;
using glm::vec3;

// A square of numbers that repeats in both directions; the size is a power of two.
struct Field {
  explicit Field(int sideLength) : size(sideLength), values(static_cast<std::size_t>(sideLength * sideLength)) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y & (size - 1)) * static_cast<std::size_t>(size) +
           static_cast<std::size_t>(x & (size - 1));
  }
  float at(int x, int y) const { return values[index(x, y)]; }
  float& at(int x, int y) { return values[index(x, y)]; }
  // Coordinates in texels.
  float sample(float x, float y) const {
    const float fx = std::floor(x), fy = std::floor(y);
    const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
    const float u = x - fx, v = y - fy;
    return glm::mix(glm::mix(at(ix, iy), at(ix + 1, iy), u), glm::mix(at(ix, iy + 1), at(ix + 1, iy + 1), u), v);
  }

  int size;
  std::vector<float> values;
};

float smooth(float t) { return t * t * (3 - 2 * t); }

float band(float low, float high, float x) { return smooth(glm::clamp((x - low) / (high - low), 0.0f, 1.0f)); }

// Value noise, octave by octave, -1..1 at most and rarely beyond +-0.7. The periods are cells along each side.
Field clouds(int size, int periodX, int periodY, int octaves, std::uint32_t seed) {
  Field result(size);
  std::vector<float> row;
  float amplitude = 0.5f;
  for (int octave = 0; octave < octaves; ++octave, amplitude *= 0.5f, periodX *= 2, periodY *= 2) {
    const int stepX = size / periodX, stepY = size / periodY;
    if (stepX < 1 || stepY < 1) break;
    const auto lattice = [&](int x, int y) {
      const auto cell = static_cast<std::uint32_t>((y % periodY) * periodX + x % periodX);
      return static_cast<float>(2 * unitInterval(hash(cell ^ hash(seed + static_cast<std::uint32_t>(octave)))) - 1);
    };
    std::vector<float> upper(static_cast<std::size_t>(periodX + 1)), lower(upper.size());
    row.resize(upper.size());
    for (int y = 0; y < size; ++y) {
      if (y % stepY == 0)
        for (int x = 0; x <= periodX; ++x) {
          upper[static_cast<std::size_t>(x)] = lattice(x, y / stepY);
          lower[static_cast<std::size_t>(x)] = lattice(x, y / stepY + 1);
        }
      const float v = smooth(static_cast<float>(y % stepY) / static_cast<float>(stepY));
      for (std::size_t x = 0; x < row.size(); ++x) row[x] = amplitude * glm::mix(upper[x], lower[x], v);
      float* out = &result.values[result.index(0, y)];
      for (int x = 0; x < size; ++x) {
        const auto cell = static_cast<std::size_t>(x / stepX);
        out[x] += glm::mix(row[cell], row[cell + 1], smooth(static_cast<float>(x % stepX) / static_cast<float>(stepX)));
      }
    }
  }
  return result;
}

std::uint8_t toByte(float value) { return static_cast<std::uint8_t>(glm::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

// color(x, y) for each texel: sRGB-encoded RGB and alpha.
template <class ColorAt>
std::shared_ptr<const Texture> paint(std::string name, int size, bool srgb, ColorAt&& color) {
  auto texture = std::make_shared<Texture>();
  texture->name = std::move(name);
  texture->width = texture->height = size;
  texture->srgb = srgb;
  texture->texels.resize(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  std::uint8_t* out = texture->texels.data();
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::vec4 texel = color(x, y);
      for (int c = 0; c < 4; ++c) *out++ = toByte(texel[c]);
    }
  return texture;
}

// Heights in texels.
std::shared_ptr<const Texture> normalMap(std::string name, const Field& height) {
  return paint(std::move(name), height.size, false, [&](int x, int y) {
    const float right = 0.5f * (height.at(x + 1, y) - height.at(x - 1, y));
    const float up = 0.5f * (height.at(x, y - 1) - height.at(x, y + 1));
    return glm::vec4(0.5f + 0.5f * glm::normalize(vec3(-right, -up, 1)), 1.0f);
  });
}

struct Masonry {
  int size = 512;
  int columns = 3, rows = 6;
  float joint = 2.5f;    // half width in texels
  float bevel = 3.0f;    // texels over which the edge is rounded
  float wobble = 1.5f;   // unevenness of the edges, texels
  float relief = 0.8f;   // unevenness of the faces, texels
  float spread = 0.07f;  // of brightness from stone to stone
  float grain = 0.10f;   // of brightness within a stone
  vec3 stone{1}, warm{1}, mortar{1};
  std::uint32_t seed = 1;
};

SurfaceTextures masonry(const std::string& name, const Masonry& m) {
  const Field coarse = clouds(m.size, 8, 8, 5, m.seed);
  const Field fine = clouds(m.size, 64, 64, 3, m.seed + 100);
  Field height(m.size);
  const float width = static_cast<float>(m.size) / static_cast<float>(m.columns);
  const float tall = static_cast<float>(m.size) / static_cast<float>(m.rows);
  auto color = paint(name, m.size, true, [&](int x, int y) {
    const float uneven = m.wobble * coarse.at(x, y);
    const float fy = (static_cast<float>(y) + 0.5f + uneven) / tall;
    const float row = std::floor(fy);
    const auto rowIndex = static_cast<std::uint32_t>((static_cast<int>(row) + m.rows) % m.rows);
    const float shift = rowIndex % 2 == 0 ? 0.0f : 0.5f;
    const float fx = (static_cast<float>(x) + 0.5f + uneven) / width + shift;
    const float column = std::floor(fx);
    const auto columnIndex = static_cast<std::uint32_t>((static_cast<int>(column) + m.columns) % m.columns);
    const float toEdge = std::min((0.5f - std::abs(fx - column - 0.5f)) * width,  //
                                  (0.5f - std::abs(fy - row - 0.5f)) * tall);
    const float face = band(m.joint, m.joint + m.bevel, toEdge);
    const float grain = coarse.at(x, y) + 0.6f * fine.at(x, y);
    height.at(x, y) = 3.0f * face + m.relief * grain * (0.4f + 0.6f * face);
    const std::uint32_t id = hash(m.seed * 977u + rowIndex * 31u + columnIndex);
    const auto tint = static_cast<float>(unitInterval(id));
    const float bright = 1 + m.spread * (2 * static_cast<float>(unitInterval(hash(id))) - 1) + m.grain * grain;
    return glm::vec4(glm::mix(m.mortar * (1 + m.grain * grain), glm::mix(m.stone, m.warm, tint) * bright, face), 1.0f);
  });
  return {std::move(color), normalMap(name + " normal", height)};
}

}  // namespace

SurfaceTextures stoneBlocks() {
  Masonry m;
  m.stone = vec3(0.82f, 0.75f, 0.64f);
  m.warm = vec3(0.86f, 0.77f, 0.62f);
  m.mortar = vec3(0.58f, 0.52f, 0.44f);
  m.seed = 11;
  return masonry("stone blocks", m);
}

SurfaceTextures bricks() {
  Masonry m;
  m.columns = 5;
  m.rows = 16;
  m.joint = 1.8f;
  m.bevel = 2.5f;
  m.wobble = 1.2f;
  m.relief = 1.0f;
  m.spread = 0.10f;
  m.grain = 0.15f;
  m.stone = vec3(0.64f, 0.38f, 0.27f);
  m.warm = vec3(0.72f, 0.45f, 0.32f);
  m.mortar = vec3(0.66f, 0.60f, 0.52f);
  m.seed = 23;
  return masonry("bricks", m);
}

SurfaceTextures woodPlanks() {
  constexpr int kSize = 256, kPlanks = 4, kPlank = kSize / kPlanks;
  const Field fibres = clouds(kSize, 64, 4, 2, 31);
  const Field bend = clouds(kSize, 4, 4, 3, 32);
  Field height(kSize);
  auto color = paint("wood planks", kSize, true, [&](int x, int y) {
    const int plank = x / kPlank;
    const float across = static_cast<float>(x % kPlank) + 0.5f;
    const float toEdge = std::min(across, static_cast<float>(kPlank) - across);
    const std::uint32_t id = hash(static_cast<std::uint32_t>(plank) + 41);
    // Each plank is a different piece of the same pattern.
    const int shifted = y + static_cast<int>(id % kSize);
    const float rings = 0.5f + 0.5f * std::sin(across * 0.35f + 9.0f * bend.at(x, shifted));
    const float face = band(0.6f, 2.6f, toEdge);
    const float grain = 0.45f * rings + 0.9f * fibres.at(x, shifted);
    height.at(x, y) = 1.6f * face + 0.5f * grain;
    const float bright =
        (0.85f + 0.22f * static_cast<float>(unitInterval(id)) - 0.26f * grain) * (0.35f + 0.65f * face);
    return glm::vec4(vec3(0.56f, 0.37f, 0.22f) * bright, 1.0f);
  });
  return {std::move(color), normalMap("wood planks normal", height)};
}

std::shared_ptr<const Texture> marbleSlabs() {
  constexpr int kSize = 512, kSlab = kSize / 2;
  const Field first = clouds(kSize, 4, 4, 6, 51);
  const Field second = clouds(kSize, 4, 4, 6, 52);
  const Field mist = clouds(kSize, 8, 8, 4, 53);
  return paint("marble slabs", kSize, true, [&](int x, int y) {
    const int slab = (y / kSlab) * 2 + x / kSlab;
    // Slabs are cut from far apart, so that veins stop at the joints.
    const float px = static_cast<float>(x + 173 * slab), py = static_cast<float>(y + 311 * slab);
    const float warpX = 60.0f * first.sample(px, py), warpY = 60.0f * second.sample(px, py);
    const float broad = std::abs(second.sample(px + warpY, py + warpX));
    const float narrow = std::abs(first.sample(0.5f * px + warpX + 77, 0.5f * py - warpY));
    const float vein = 0.75f * (1 - band(0.0f, 0.055f, broad)) + 0.45f * (1 - band(0.0f, 0.10f, narrow));
    const float cloud = 0.94f + 0.07f * mist.sample(px, py);
    const float edgeX = 0.5f + static_cast<float>(std::min(x % kSlab, kSlab - 1 - x % kSlab));
    const float edgeY = 0.5f + static_cast<float>(std::min(y % kSlab, kSlab - 1 - y % kSlab));
    const float face = band(0.8f, 2.6f, std::min(edgeX, edgeY));
    const vec3 stone = glm::mix(vec3(0.98f, 0.97f, 0.95f), vec3(0.58f, 0.57f, 0.58f), std::min(vein, 1.0f)) * cloud;
    return glm::vec4(stone * (0.45f + 0.55f * face), 1.0f);
  });
}

std::shared_ptr<const Texture> plaster() {
  constexpr int kSize = 256;
  const Field broad = clouds(kSize, 4, 4, 6, 61);
  const Field fine = clouds(kSize, 128, 128, 2, 62);
  return paint("plaster", kSize, true, [&](int x, int y) {
    const float bright = 0.92f + 0.11f * broad.at(x, y) + 0.05f * fine.at(x, y);
    return glm::vec4(vec3(1.0f, 0.985f, 0.96f) * bright, 1.0f);
  });
}

std::shared_ptr<const Texture> damask(const std::string& name, vec3 ground, vec3 figure) {
  constexpr int kSize = 256;
  const Field wear = clouds(kSize, 8, 8, 4, 71);
  return paint(name, kSize, true, [&](int x, int y) {
    const vec2 at = (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / static_cast<float>(kSize);
    // Medallions on a staggered grid: petals modulate the outline of rings.
    const vec2 cell(at.x * 3, at.y * 6);
    const float stagger = std::floor(cell.y);
    vec2 local(cell.x + 0.5f * (stagger - 2 * std::floor(0.5f * stagger)), cell.y);
    local = local - glm::floor(local) - 0.5f;
    local.y *= 0.8f;
    const float angle = std::atan2(local.y, local.x), radius = glm::length(local);
    const float petals = radius * (1 + 0.18f * std::cos(8 * angle));
    float motif = 1 - band(0.008f, 0.022f, std::abs(petals - 0.30f) - 0.018f);
    motif =
        std::max(motif, 1 - band(0.0f, 0.02f, std::abs(radius * (1 + 0.35f * std::cos(4 * angle)) - 0.13f) - 0.03f));
    motif = std::max(motif, 1 - band(0.03f, 0.045f, radius));
    // Borders at the sides and at the foot.
    const float edge = std::min(std::min(at.x, 1 - at.x), 0.6f * (1 - at.y));
    if (edge < 0.075f) motif = edge > 0.018f && edge < 0.055f ? 1.0f : 0.0f;
    const float weave = 0.04f * ((x + y) % 2 == 0 ? 1.0f : -1.0f) + 0.10f * wear.at(x, y);
    return glm::vec4(glm::mix(ground, figure, 0.85f * motif) * (1 + weave), 1.0f);
  });
}

std::shared_ptr<const Texture> leafSprig() {
  constexpr int kSize = 256;
  const Field mottle = clouds(kSize, 8, 8, 4, 81);
  struct Leaflet {
    vec2 root, axis, side;
    float length, width, shade;
  };
  std::vector<Leaflet> leaflets;
  Random random(82);
  constexpr int kPairs = 5;
  for (int i = 0; i <= 2 * kPairs; ++i) {
    const bool tip = i == 2 * kPairs;
    const float step = static_cast<float>(tip ? kPairs : i / 2) / kPairs;
    const float turn = tip ? 0.0f : (i % 2 == 0 ? -1.0f : 1.0f) * static_cast<float>(random.between(0.85, 1.15));
    const vec2 axis(std::sin(turn), -std::cos(turn));
    const float length = 0.40f - 0.10f * step;
    leaflets.push_back({vec2(0.5f, 0.88f - 0.60f * step), axis, vec2(-axis.y, axis.x), tip ? 0.28f : length, 0.105f,
                        static_cast<float>(random.between(0.85, 1.15))});
  }
  return paint("leaf sprig", kSize, true, [&](int x, int y) {
    const vec2 at = (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / static_cast<float>(kSize);
    // Gaps have a leaf's color too, so that filtering makes no dark fringe.
    vec3 color(0.30f, 0.45f, 0.15f);
    float cover = 0;
    const float stem = 0.006f + 0.008f * at.y - std::abs(at.x - 0.5f);
    if (at.y > 0.25f) cover = band(-0.003f, 0.003f, stem);
    for (const Leaflet& leaf : leaflets) {
      const vec2 local = at - leaf.root;
      const float along = glm::dot(local, leaf.axis) / leaf.length;
      if (along <= 0 || along >= 1) continue;
      const float across = glm::dot(local, leaf.side) / leaf.width;
      const float outline = 1.9f * std::sqrt(along) * (1 - along) - std::abs(across);
      const float inside = band(-0.03f, 0.03f, outline);
      if (inside <= 0) continue;
      const float vein = 1 - band(0.0f, 0.07f, std::abs(across));
      const float ribs = 0.5f + 0.5f * std::sin(38 * (along - 0.35f * std::abs(across)));
      const float bright = leaf.shade * (0.92f + 0.10f * ribs + 0.35f * mottle.at(x, y));
      const vec3 blade = glm::mix(vec3(0.27f, 0.44f, 0.13f), vec3(0.52f, 0.62f, 0.28f), 0.7f * vein) * bright;
      color = glm::mix(color, blade, inside);
      cover = std::max(cover, inside);
    }
    return glm::vec4(color, cover);
  });
}

std::shared_ptr<const Texture> checker(vec3 light, vec3 dark) {
  constexpr int kSize = 256, kCheck = kSize / 2;
  const Field cloud = clouds(kSize, 8, 8, 5, 91);
  return paint("checker", kSize, true, [&](int x, int y) {
    const bool even = (x / kCheck + y / kCheck) % 2 == 0;
    return glm::vec4((even ? light : dark) * (1 + 0.08f * cloud.at(x, y)), 1.0f);
  });
}

}  // namespace halfsilver
