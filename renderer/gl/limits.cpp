#include "gl/limits.h"

namespace halfsilver::gl {

std::vector<Need> needsOf(const Limits& limits) {
  // What OpenGL 4.5 guarantees; 0: anything will do, what is too large for it is told when it is made.
  constexpr GLint64 kBlocks = 8, kUnits = 16;
  return {
      {"storage blocks in compute shaders", limits.computeStorageBlocks, kBlocks, kComputeBlocks},
      {"storage blocks in fragment shaders", limits.fragmentStorageBlocks, 0, kFragmentBlocks},
      {"storage blocks in vertex shaders", limits.vertexStorageBlocks, 0, kVertexBlocks},
      {"texture units of a stage", limits.textureUnits, kUnits, kUnits},
      {"bytes of a storage block", limits.storageBlockBytes, 0, 0},
      {"texels of a buffer texture", limits.bufferTexels, 0, 0},
      {"texels along a texture", limits.textureSize, 0, 0},
      {"layers of an array texture", limits.arrayLayers, 0, 0},
      {"pixels along a framebuffer", limits.framebufferSize, 0, 0},
  };
}

}  // namespace halfsilver::gl
