#pragma once

#include <cstdint>

#include <halfsilver/gl/buffer.h>
#include "gl/program.h"

namespace halfsilver {

// Exclusive prefix sums on the GPU; see shaders/tracing/prefix_sum.comp for what `items` names. The buffers of the
// items and SSBO_LIST_BUILD are bound by the caller, who orders what wrote them.
class PrefixSum {
 public:
  PrefixSum(const gl::Api& api, const char* items);

  // For the items' own uniforms.
  const gl::Program& placing() const { return place_; }

  // The total goes to ListBuild::total.
  void sum(std::uint32_t items);
  // Hands each item its sum; after sum() of the same items.
  void place(std::uint32_t items);

  std::uint64_t bytes() const { return blocks_.bytes(); }

 private:
  void run(const gl::Program& program, std::uint32_t items, std::uint32_t groups);

  const gl::Api* api_;
  gl::Program sumBlocks_, sumSums_, place_;
  gl::Buffer blocks_;
};

}  // namespace halfsilver
