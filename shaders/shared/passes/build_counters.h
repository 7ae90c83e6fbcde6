// Binding of the counters of builds: tracing/common/counters.glsl. Builds touch no queue of rays and use its numbers.
#ifndef HALFSILVER_PASSES_BUILD_COUNTERS_H
#define HALFSILVER_PASSES_BUILD_COUNTERS_H

#define SSBO_COUNTERS 5  // uint[COUNTER_SLOTS * COUNTER_KINDS]

#endif
