// What rays ask for, and what becomes of it.
#include "shared/passes/identity.h"

layout(std430, binding = SSBO_BRICK_WORK) coherent buffer BrickWorkBlock { BrickWork brickWork; };
