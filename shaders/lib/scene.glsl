// The scene's triangles and materials, pulled from storage buffers. No textures here.
#include "lib/frame.glsl"

layout(std430, binding = SSBO_POSITIONS) readonly buffer PositionBlock { float positions[]; };
layout(std430, binding = SSBO_ATTRIBUTES) readonly buffer AttributeBlock { VertexAttributes attributes[]; };
layout(std430, binding = SSBO_TRIANGLES) readonly buffer TriangleBlock { uvec4 triangles[]; };
layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock { GpuMaterial materials[]; };

vec3 vertexPosition(uint vertex) {
  return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
}

// xyz: vertices; w: material.
uvec4 triangleAt(uint triangle) { return triangles[triangle]; }

void trianglePositions(uint triangle, out vec3 a, out vec3 b, out vec3 c) {
  uvec4 corners = triangles[triangle];
  a = vertexPosition(corners.x);
  b = vertexPosition(corners.y);
  c = vertexPosition(corners.z);
}

// Whether the back of the material's triangles can be seen.
bool doubleSided(uint materialIndex) {
  return frame.cullBackFaces == 0u || (materials[materialIndex].flags & MATERIAL_DOUBLE_SIDED) != 0u;
}
