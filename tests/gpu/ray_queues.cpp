#include "gpu/ray_queues.h"

#include <algorithm>

namespace halfsilver::testing {

RayQueue makeQueue(const gl::Api& api, const std::vector<shared::Ray>& rays,
                   const std::vector<shared::RayPath>& paths) {
  const auto rayCount = static_cast<std::uint32_t>(rays.size());
  RayQueue queue = makeQueue(api, std::max(1u, rayCount));
  queue.rays.write(std::span<const shared::Ray>(rays));
  queue.paths.write(std::span<const shared::RayPath>(paths));
  shared::RayCount count{};
  count.groupsX = (rayCount + 63) / 64;
  count.groupsY = count.groupsZ = 1;
  count.count = rayCount;
  queue.count.write(std::span<const shared::RayCount>(&count, 1));
  return queue;
}

RayQueue makeQueue(const gl::Api& api, std::uint32_t capacity) {
  RayQueue queue;
  queue.capacity = capacity;
  queue.rays = gl::Buffer(api, capacity * sizeof(shared::Ray), "rays");
  queue.paths = gl::Buffer(api, capacity * sizeof(shared::RayPath), "ray paths");
  queue.count = gl::Buffer(api, sizeof(shared::RayCount), "ray count");
  queue.count.fill(0);
  return queue;
}

}  // namespace halfsilver::testing
