// Bindings of what the reflection effect asks the screen: effects/reflection/look.comp and seen.comp.
#ifndef HALFSILVER_PASSES_LOOK_H
#define HALFSILVER_PASSES_LOOK_H

#define SSBO_NEXT_RAYS 11   // Ray[]
#define SSBO_NEXT_PATHS 12  // RayPath[]
#define SSBO_NEXT_COUNT 13  // RayCount

#define UNIT_OCCLUSION 12  // GBuffer::occlusion

#endif
