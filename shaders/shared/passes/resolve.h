// Bindings of the reflection effect's sums: effects/reflection/resolve.comp and resolve_behind.comp.
#ifndef HALFSILVER_PASSES_RESOLVE_H
#define HALFSILVER_PASSES_RESOLVE_H

#define SSBO_SLOTS 10         // Radiance[]
#define SSBO_DIRECT_LIGHT 11  // LightSum[] by pixel of the batch: direct light on what its rays found

#endif
