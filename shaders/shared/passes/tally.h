// Bindings of the tally of rays: passes/tally.comp.
#ifndef HALFSILVER_PASSES_TALLY_H
#define HALFSILVER_PASSES_TALLY_H

#define SSBO_TALLY 9  // KindTally[] by pixel

#endif
