// Bindings of rays to lights: effects/light_rays/, beside those of light_sums.h.
#ifndef HALFSILVER_PASSES_LIGHT_RAYS_H
#define HALFSILVER_PASSES_LIGHT_RAYS_H

#define IMAGE_SHADED 0  // deferred radiance; a: sky visibility

#endif
