// Bindings of the sum of samples: passes/accumulate.comp.
#ifndef HALFSILVER_PASSES_ACCUMULATE_H
#define HALFSILVER_PASSES_ACCUMULATE_H

#define IMAGE_SUM 0  // radiance of all samples so far

#endif
