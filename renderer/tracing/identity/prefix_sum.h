#pragma once

#include <cstdint>
#include <functional>

#include <halfsilver/gl/buffer.h>
#include "gl/program.h"

namespace halfsilver {

// Exclusive prefix sums on the GPU, see shaders/tracing/identity/prefix_sum.glsl.
class PrefixSum {
 public:
  // Binds what the program reads of its items. The caller orders what wrote them.
  using BindItems = std::function<void()>;

  // `file`: the shader that defines what is summed.
  PrefixSum(const gl::Api& api, const char* file);

  void sum(std::uint32_t items, const BindItems& bind);
  // Hands each item its sum; after sum() of the same items.
  void place(std::uint32_t items, const BindItems& bind);

  std::uint64_t bytes() const { return blocks_.bytes(); }

 private:
  void run(const gl::Program& program, std::uint32_t items, std::uint32_t groups, const BindItems& bind);

  const gl::Api* api_;
  gl::Program sumBlocks_, sumSums_, place_;
  gl::Buffer blocks_;
};

}  // namespace halfsilver
