// Bricks that rays wait for, while they are built; by their number in bricks[].
#include "shared/passes/identity.h"

struct BrickBuild {
  uint brick;
  uint run;                     // place of its run, or BRICK_MISSING if it found none
  uint next[VOXELS_PER_BRICK];  // entries counted for each voxel; then where its next entry goes
};
layout(std430, binding = SSBO_BRICK_BUILDS) coherent buffer BrickBuildBlock { BrickBuild builds[]; };
