// A brick that is to be built again; what its run held is garbage from now on.
#include "tracing/identity/brick_work.glsl"
#include "tracing/identity/bricks.glsl"

void giveUp(uint brick) {
  if (bricks[brick] == BRICK_MISSING) return;  // another triangle came before; looking saves the atomic
  uint run = atomicExchange(bricks[brick], BRICK_MISSING);
  if (!present(run)) return;
  atomicAdd(brickWork.staleWords, runWords(run));
  atomicAdd(brickWork.staleHeaderWords, headerWords(run));
}
