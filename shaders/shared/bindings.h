// Binding numbers that mean the same in every pass, shared by C++ and GLSL; a pass's own are in shared/passes/. Nothing
// binds a bare number.
#ifndef HALFSILVER_BINDINGS_H
#define HALFSILVER_BINDINGS_H

// Uniform buffers.
#define UBO_FRAME 0

// Storage buffers: the scene.
#define SSBO_POSITIONS 0   // float[3 * vertices]
#define SSBO_ATTRIBUTES 1  // VertexAttributes[vertices]
#define SSBO_TRIANGLES 2   // uvec4[triangles]: three vertices, material
#define SSBO_MATERIALS 3   // GpuMaterial[materials]
// A queue of rays and their hits.
#define SSBO_RAYS 5       // Ray[], or uint[] of pixels, see RayCount::source
#define SSBO_PATHS 6      // RayPath[], of stored rays
#define SSBO_RAY_COUNT 7  // RayCount
#define SSBO_HITS 8       // Hit[]
// The passes' own numbers begin here.
#define SSBO_PASS 9

// Texture units: the scene.
#define TEXTURE_BUCKETS 8  // material textures, sampler2DArray, units 0..7
#define UNIT_MATERIAL_TEXTURES 0
#define UNIT_SHADOW_MAPS 8  // sampler2DArrayShadow
#define UNIT_SKY 9          // sampler2D, equirectangular
#define UNIT_LIGHTS 16      // samplerBuffer: GpuLight[lights] in texels
#define UNIT_ALPHA 17       // usamplerBuffer: alpha of the textures that cut holes, a byte per texel
// The G-buffer.
#define UNIT_DEPTH 10
#define UNIT_NORMAL 11
#define UNIT_MATERIAL 13
#define UNIT_VISIBILITY 15
#define UNIT_LOBES 24
#define UNIT_COAT 25
// Its lit layers, in passes that blend; those read no material textures.
#define UNIT_SHADED 0
#define UNIT_REFLECTION 1
#define UNIT_SEEN 7
// As images.
#define IMAGE_SHADED 0
#define IMAGE_REFLECTION 1
#define IMAGE_SEEN 2

#endif
