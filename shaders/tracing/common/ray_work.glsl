// What a ray does, for benchmarks: with COUNT_WORK its steps (cells or nodes) and its tests of triangles are counted,
// over all dispatches. Without it, nothing is left of this.
#ifdef COUNT_WORK
uint stepsDone = 0u, testsDone = 0u;
void countStep() { ++stepsDone; }
void countTest() { ++testsDone; }
#else
void countStep() {}
void countTest() {}
#endif
