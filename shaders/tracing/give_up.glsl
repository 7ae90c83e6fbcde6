// A brick is to be built anew; what its run held is garbage from now on.
layout(std430, binding = SSBO_LIST_BUILD) coherent buffer ListBuildBlock { ListBuild listBuild; };

void giveUp(uint brick) {
  uint run = atomicExchange(bricks[brick], BRICK_MISSING);
  if (!present(run)) return;
  atomicAdd(listBuild.stale, runWords(run));
  atomicAdd(listBuild.staleHeaders, headerWords(run));
}
