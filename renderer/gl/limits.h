#pragma once

#include <string>
#include <vector>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

// What the project asks of a device, beside what OpenGL 4.5 guarantees of functions.
struct Need {
  std::string what;
  GLint64 offered = 0;
  GLint64 least = 0;  // a device that offers less is refused
  GLint64 used = 0;   // by the default settings; a program that needs more than is offered is refused by name
};

// Storage blocks that the programs of the default settings and of all effects declare in a stage.
constexpr GLint kComputeBlocks = 12, kFragmentBlocks = 8, kVertexBlocks = 5;

std::vector<Need> needsOf(const Limits& limits);

}  // namespace halfsilver::gl
