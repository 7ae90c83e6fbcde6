// Binding numbers, shared by C++ and GLSL. A name per binding; nothing binds a bare number.
#ifndef HALFSILVER_BINDINGS_H
#define HALFSILVER_BINDINGS_H

// Uniform buffers.
#define UBO_FRAME 0

// Storage buffers: the scene.
#define SSBO_POSITIONS 0   // float[3 * vertices]
#define SSBO_ATTRIBUTES 1  // VertexAttributes[vertices]
#define SSBO_TRIANGLES 2   // uvec4[triangles]: three vertices, material
#define SSBO_MATERIALS 3   // GpuMaterial[materials]
#define SSBO_LIGHTS 4      // GpuLight[lights]
#define SSBO_DRAW_LIST 5   // uint[triangles]: triangle numbers in drawing order
// Rays.
#define SSBO_RAYS 6          // Ray[]
#define SSBO_RAY_COUNT 7     // RayCount
#define SSBO_HITS 8          // Hit[]
#define SSBO_HIT_SURFACES 9  // HitSurface[], methods that store attributes
#define SSBO_CONTRIBUTIONS 9  // uint[CONTRIBUTION_CLASSES], while pixels are selected
// The method's own structure.
#define SSBO_VOXELS 10
#define SSBO_HEADS 11
#define SSBO_ENTRIES 12
#define SSBO_LINKS 13
#define SSBO_COUNTERS 14
// What a build of bricks needs for a while.
#define SSBO_OUTER 13        // while rays are traced, in place of a build's candidates
#define SSBO_BRICK_BUILDS 5  // shares the draw list's number: rasterization for the screen and tracing never meet
#define SSBO_LIST_BUILD 9    // ListBuild; shares the number of surfaces that methods with attributes store
#define SSBO_MOVED_RUNS 8    // while runs are moved together, in place of hits
// Sums of normals while voxels are made, before there are heads, entries and links.
#define SSBO_NORMAL_X 11
#define SSBO_NORMAL_Y 12
#define SSBO_NORMAL_Z 13
// The next bounce.
#define SSBO_NEXT_RAYS 15
#define SSBO_NEXT_RAY_COUNT 5  // shares the draw list's number: rasterization and shading of hits never meet

// Texture units.
#define TEXTURE_BUCKETS 8  // material textures, sampler2DArray, units 0..7
#define UNIT_MATERIAL_TEXTURES 0
#define UNIT_SHADOW_MAPS 8  // sampler2DArrayShadow
#define UNIT_SKY 9          // sampler2D, equirectangular
#define UNIT_POSITION 10    // G-buffer
#define UNIT_NORMAL 11
#define UNIT_BASE_COLOR 12
#define UNIT_MATERIAL 13
#define UNIT_EMISSIVE 14
#define UNIT_VISIBILITY 15
// In passes that blend and need no material textures.
#define UNIT_SHADED 0
#define UNIT_REFLECTION 1

// Image units; a pass uses its own few.
#define IMAGE_POSITION 0
#define IMAGE_NORMAL 1
#define IMAGE_BASE_COLOR 2
#define IMAGE_MATERIAL 3
#define IMAGE_EMISSIVE 4
#define IMAGE_SHADED 5      // deferred radiance; a: sky visibility
#define IMAGE_REFLECTION 6  // radiance carried by the traced rays; a: 1 where traced
#define IMAGE_POOL 7        // entries of the attribute method

#endif
