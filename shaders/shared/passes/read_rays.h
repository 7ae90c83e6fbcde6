// Binding of the rays that the host reads: passes/read_rays.comp.
#ifndef HALFSILVER_PASSES_READ_RAYS_H
#define HALFSILVER_PASSES_READ_RAYS_H

#define SSBO_READ_RAYS 9  // Ray[]

#endif
