// The scene's triangles with their vertices' attributes and materials. No textures here.
#include "lib/frame.glsl"
#include "lib/triangles.glsl"

layout(std430, binding = SSBO_ATTRIBUTES) readonly buffer AttributeBlock { VertexAttributes attributes[]; };
layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock { GpuMaterial materials[]; };

// Whether the back of the material's triangles can be seen.
bool doubleSided(uint materialIndex) {
  return frame.cullBackFaces == 0u || (materials[materialIndex].flags & MATERIAL_DOUBLE_SIDED) != 0u;
}
