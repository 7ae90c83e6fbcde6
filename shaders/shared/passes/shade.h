// Bindings of deferred shading: passes/shade.comp.
#ifndef HALFSILVER_PASSES_SHADE_H
#define HALFSILVER_PASSES_SHADE_H

#define IMAGE_SHADED 0  // deferred radiance; a: sky visibility

#endif
