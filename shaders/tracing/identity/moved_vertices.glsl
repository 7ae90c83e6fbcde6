// Vertices that have moved, and the blocks of triangles that may use them.
#include "shared/passes/identity.h"

layout(std430, binding = SSBO_MOVED_VERTICES) readonly buffer MovedBlock {
  uint rangeCount;
  uint blockCount;  // of MOVED_BLOCK triangles
  uint moved[];     // the ranges, ascending: first vertex and end; then the numbers of the blocks
};

uint movedBlock(uint number) { return moved[2u * rangeCount + number]; }
