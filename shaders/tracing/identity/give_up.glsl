// A brick that is to be built again; what its run held is garbage from now on.
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

// Whether it was empty.
bool giveUp(uint brick) {
  if (bricks[brick] == BRICK_MISSING) return false;  // another triangle came before; looking saves the atomic
  uint state = atomicExchange(bricks[brick], BRICK_MISSING);
  if (present(state)) {
    atomicAdd(brickWork.staleWords, runWords(state));
    atomicAdd(brickWork.staleHeaderWords, headerWords(state));
  }
  return emptyBrick(state);
}
