// Bindings of the surfaces that the host reads: passes/read_surfaces.comp.
#ifndef HALFSILVER_PASSES_READ_SURFACES_H
#define HALFSILVER_PASSES_READ_SURFACES_H

#define IMAGE_READ_POSITION 0
#define IMAGE_READ_NORMAL 1

#endif
