// Bindings of the reflection effect's first rays: effects/reflection/spawn.comp.
#ifndef HALFSILVER_PASSES_SPAWN_H
#define HALFSILVER_PASSES_SPAWN_H

#define SSBO_CONTRIBUTIONS 9  // uint[CONTRIBUTION_CLASSES]

#endif
