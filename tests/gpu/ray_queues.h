#pragma once

#include <vector>

#include <halfsilver/products.h>

namespace halfsilver::testing {

// Rays made by hand as an effect would leave them: with their count and an indirect dispatch of 64 rays per group.
// `paths`: one per ray, or none.
RayQueue makeQueue(const gl::Api& api, const std::vector<shared::Ray>& rays,
                   const std::vector<shared::RayPath>& paths = {});
// An empty queue with room.
RayQueue makeQueue(const gl::Api& api, std::uint32_t capacity);

}  // namespace halfsilver::testing
