// Bindings of effects that add light to pixels: effects/common/light_sums.glsl and what includes it.
#ifndef HALFSILVER_PASSES_LIGHT_SUMS_H
#define HALFSILVER_PASSES_LIGHT_SUMS_H

#define SSBO_HIT_SURFACES 9  // HitSurface[], if the method stores attributes
#define SSBO_LIGHT_SUMS 10  // LightSum[]
#define SSBO_NEXT_RAYS 11   // Ray[]
#define SSBO_NEXT_PATHS 12  // ScatteredPath[]
#define SSBO_NEXT_COUNT 13  // RayCount

#endif
