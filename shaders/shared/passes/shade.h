// Bindings of deferred shading: passes/shade.comp.
#ifndef HALFSILVER_PASSES_SHADE_H
#define HALFSILVER_PASSES_SHADE_H

#define IMAGE_OCCLUSION 3  // GBuffer::occlusion

#endif
