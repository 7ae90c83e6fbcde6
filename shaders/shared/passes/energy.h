// The table of effects/common/energy.comp: by cosine and roughness; slice 0 of surfaces that reflect, the others of
// boundaries, by the logarithm of their relative index of refraction.
#ifndef HALFSILVER_PASSES_ENERGY_H
#define HALFSILVER_PASSES_ENERGY_H

#define ENERGY_SIZE 32  // cosines and roughnesses, from 0 to 1
#define ENERGY_ETAS 32
#define ENERGY_ETA_OCTAVES 1.5  // either way

#define IMAGE_ENERGY 0
#define UNIT_ENERGY 18  // sampler3D

#endif
