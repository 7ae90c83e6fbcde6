#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <halfsilver/ray_kinds.h>

namespace halfsilver {

// Of FrameReport::rays: RAY_... of shaders/shared/rays.h.
inline constexpr std::size_t kShadowRays = 2, kRayKinds = kRayKindNames.size();

struct StageTime {
  // "pose", "shadow", "gbuffer", "select", "voxelize", "build", "trace", "shade", "composite", "frame"
  std::string stage;
  double milliseconds = 0;  // GPU time; negative if the driver's answer was rejected
};

struct MemoryReport {  // bytes unless marked as counts
  std::uint64_t voxels = 0, heads = 0, poolReserved = 0, poolUsed = 0;
  std::uint64_t fragments = 0, fragmentsStored = 0;  // counts
  std::uint64_t fragmentsPerAxis[3] = {0, 0, 0};     // counts, stored
  int grid[3] = {0, 0, 0};                           // voxels along each axis
  double bytesPerFragment = 0;
  std::uint64_t structureTotal = 0;
  std::uint64_t gbuffer = 0;
  std::uint64_t geometry = 0;  // vertices, triangles, materials
  std::uint64_t textures = 0;  // of materials, and the sky
  std::uint64_t shadowMaps = 0;
  std::uint64_t queues = 0;         // rays, their hits and light, of all frames
  std::uint64_t transient = 0;      // of the tracer, beside the structure: the most at once
  std::uint64_t pictures = 0;       // sums of samples and what else stays from frame to frame for smooth edges
  std::uint64_t largestBuffer = 0;  // that shaders read, of all that the context has made so far
  std::string largestBufferName;
  std::uint64_t peak = 0;  // all GPU memory that the renderer held at once: the last eight, of all frames
};

struct FrameReport {
  std::uint64_t pixels = 0;
  std::uint64_t resampled = 0;     // pixels that show a triangle of their neighborhood, see PrimarySettings
  std::uint64_t interpolated = 0;  // pixels whose color is their neighbors'
  std::uint64_t reflecting = 0;    // pixels that select.mode takes
  std::uint64_t selected = 0;      // of these, pixels that are traced
  std::vector<std::uint32_t>
      contributions;  // reflecting pixels of select.fraction by contribution, in classes of equal ratio
  std::array<std::uint64_t, 8> rays{};  // traced, by kind; behind the kinds those that the screen and a structure
                                        // answer, the former also of what effect.glossy does not trace
  float minDistance = 0;  // nearer hits may be ignored, meters: eight rounding steps of the scene's largest coordinate
  std::uint32_t passes = 1;  // that the picture is the mean of
  std::vector<StageTime> times;
  MemoryReport memory;
  std::uint64_t overflow = 0;       // rays given up
  std::uint64_t lostFragments = 0;  // fragments that the structure could not hold
  std::vector<std::string> warnings;
};

// What the search did for one ray.
struct RayWork {
  std::uint32_t steps = 0;  // through cells of a grid or nodes of a hierarchy
  std::uint32_t tests = 0;  // of triangles; of texels by methods that store attributes
};

}  // namespace halfsilver
