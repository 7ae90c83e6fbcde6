// Bricks that rays wait for, in the order of their numbers.
#include "shared/passes/identity.h"

struct BrickRequest {
  uint brick;
  uint run;  // place of its run, or BRICK_MISSING if it found none
};
layout(std430, binding = SSBO_REQUESTS) coherent buffer BrickRequestBlock { BrickRequest requests[]; };
