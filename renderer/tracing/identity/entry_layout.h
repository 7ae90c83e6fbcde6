#pragma once

#include <cstdint>

#include "gl/program.h"

namespace halfsilver {

// How an entry's 32 bits are shared between a triangle's number and its box; see shaders/tracing/identity/entry.glsl.
struct EntryLayout {
  int slices = 4;  // of a voxel along each axis; 0: no box

  static EntryLayout of(std::uint32_t triangleCount);
  void apply(const gl::Program& program) const;
};

}  // namespace halfsilver
