// Bindings of the reflection effect's first rays: effects/reflection/spawn.comp.
#ifndef HALFSILVER_PASSES_SPAWN_H
#define HALFSILVER_PASSES_SPAWN_H

#define SSBO_CONTRIBUTIONS 9  // uint[CONTRIBUTION_CLASSES]
#define SSBO_SLOTS 10         // Radiance[]
#define SSBO_SLOT_PIXELS 11   // uint[]: the pixel of each group of slots

#endif
