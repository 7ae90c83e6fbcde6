#pragma once

#include <cstdint>
#include <initializer_list>
#include <utility>

#include "gpu/glass_scenes.h"
#include "gpu/ray_witness.h"

// Small pictures of clear surfaces that blend deferred shading and reflections.
namespace halfsilver::testing {

using Pairs = std::initializer_list<std::pair<const char*, const char*>>;

inline constexpr int kWidth = 64, kHeight = 48;
inline constexpr std::uint64_t kPixels = static_cast<std::uint64_t>(kWidth) * kHeight;

class TransmissionTest : public WitnessTest {
 protected:
  static Settings settings(Pairs more = {}) {
    Settings result = settingsWith({{"trace.effect", "reflection"}});
    for (const auto& [name, value] : more) set(result, name, value);
    return result;
  }
  Frame see(const Scene& scene, const Camera& camera, Pairs more = {}) {
    const Frame frame = draw(scene, camera, settings(more), kWidth, kHeight);
    EXPECT_EQ(frame.report.overflow, 0u);
    return frame;
  }
  static glm::vec3 light(const Frame& frame, int x, int y) {
    return {frame.at(x, y, "R"), frame.at(x, y, "G"), frame.at(x, y, "B")};
  }
  static glm::vec3 middle(const Frame& frame) { return light(frame, kWidth / 2, kHeight / 2); }
  static glm::dvec3 ray(const Camera& camera, int x, int y) { return pixelRay(camera, x, y, kWidth, kHeight); }
};

}  // namespace halfsilver::testing
