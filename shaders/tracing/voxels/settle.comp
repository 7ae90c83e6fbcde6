// What rays find in each occupied voxel: the average of its fragments' normals, one of its triangles, and that one's
// color. One invocation per voxel.
#include "lib/triangles.glsl"
#include "shared/passes/voxelize.h"
#include "shared/passes/voxels.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/packed_unit.glsl"
#include "tracing/common/stored_surface.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_NORMAL_X) readonly buffer NormalX { int normalX[]; };
layout(std430, binding = SSBO_NORMAL_Y) readonly buffer NormalY { int normalY[]; };
layout(std430, binding = SSBO_NORMAL_Z) readonly buffer NormalZ { int normalZ[]; };
layout(std430, binding = SSBO_VOXEL_TRIANGLES) readonly buffer TriangleOfVoxel { uint voxelTriangles[]; };
layout(std430, binding = SSBO_SETTLED) writeonly buffer SurfaceBlock { VoxelSurface voxelSurfaces[]; };
uniform uint count;
uniform float voxelSize;  // meters

// Of the point of the triangle's plane next to the voxel's center.
vec2 barycentricsAt(uint triangle, vec3 center) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 edge1 = b - a, edge2 = c - a, area = cross(edge1, edge2);
  float size = dot(area, area);
  if (size == 0.0) return vec2(0.0);
  vec3 at = center - a;
  vec2 weights = clamp(vec2(dot(cross(at, edge2), area), dot(cross(edge1, at), area)) / size, 0.0, 1.0);
  return weights / max(1.0, weights.x + weights.y);
}

void main() {
  uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (index >= count) return;
  uint triangle = voxelTriangles[index];
  if (triangle == NO_TRIANGLE) return;
  uvec3 size = uvec3(voxelCount);
  uvec3 voxel = uvec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));
  vec3 center = gridLow + (vec3(voxel) + 0.5) / vec3(size) / gridInverse;
  StoredSurface surface = evaluateStoredSurface(triangle, barycentricsAt(triangle, center), voxelSize);
  // The sums are of normals in units of voxels. Opposite ones may cancel: then the triangle's own has to do.
  vec3 normal = vec3(normalX[index], normalY[index], normalZ[index]) * gridInverse * vec3(voxelCount);
  normal = dot(normal, normal) > 0.0 ? normalize(normal) : surface.normal;
  vec4 color = clamp(vec4(surface.baseColor, surface.reflectivity), 0.0, 1.0);
  voxelSurfaces[index] = VoxelSurface(packUnit(normal), packUnorm4x8(sqrt(color)));
}
