// Bindings of the methods that capture the scene from somewhere else: tracing/planar/ and tracing/cubemap/.
#ifndef HALFSILVER_PASSES_CAPTURES_H
#define HALFSILVER_PASSES_CAPTURES_H

#define SSBO_PLANES 11  // MirrorPlanes
#define UBO_PLANE 1     // vec4, the beginning of it: the chosen one
#define SSBO_PROBE 11   // vec4: where the cube is captured
#define UBO_PROBE 1     // the same

#define UNIT_CAPTURE 8  // usampler2D or usampler2DArray: triangle + 1, or 0; a trace reads no shadow maps

#define PLANE_CANDIDATES 64

// Planes: normal towards the camera, distance of the origin; no plane: all 0.
struct MirrorPlanes {
  vec4 chosen;
  vec4 candidates[PLANE_CANDIDATES];
  uint votes[PLANE_CANDIDATES];
};

#endif
