// Bindings of the reflection effect's shading of hits: effects/reflection/shade.comp.
#ifndef HALFSILVER_PASSES_SHADE_HITS_H
#define HALFSILVER_PASSES_SHADE_HITS_H

#define SSBO_HIT_SURFACES 9  // HitSurface[], if the method stores attributes
#define SSBO_SLOTS 10        // Radiance[]
#define SSBO_NEXT_RAYS 11    // Ray[]
#define SSBO_NEXT_PATHS 12   // RayPath[]
#define SSBO_NEXT_COUNT 13   // RayCount

#define MOST_CLEAR 8  // refractions and reflections inside on a path, beside its bounces

#endif
