// Poses vertices after the glTF 2.0 specification, section 3.7: rest pose, then morph targets, then joints or the node.
// What scene/pose.cpp does on the host.
#include "shared/bindings.h"
#include "shared/passes/pose.h"
#include "shared/structs.h"

layout(local_size_x = POSE_GROUP) in;

layout(std430, binding = SSBO_POSITIONS) writeonly buffer PositionBlock { float positions[]; };
layout(std430, binding = SSBO_ATTRIBUTES) writeonly buffer AttributeBlock { VertexAttributes attributes[]; };
layout(std430, binding = SSBO_REST) readonly buffer RestBlock { RestVertex restVertices[]; };
layout(std430, binding = SSBO_INFLUENCES) readonly buffer InfluenceBlock { JointInfluences influences[]; };
layout(std430, binding = SSBO_MORPH_DELTAS) readonly buffer DeltaBlock { float morphDeltas[]; };
layout(std430, binding = SSBO_MORPH_WEIGHTS) readonly buffer WeightBlock { MorphWeight morphWeights[]; };
layout(std430, binding = SSBO_POSE_MATRICES) readonly buffer MatrixBlock { PoseMatrix poseMatrices[]; };
layout(std430, binding = SSBO_POSE_GROUPS) readonly buffer GroupBlock { PoseGroup groups[]; };

uniform uint groupCount;

uint number = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
PoseGroup group = groups[min(number, groupCount - 1u)];

struct Placement {
  mat3 linear;
  vec3 offset;
};

// Loops end where a branch would be run all the same by software rasterizers.
Placement placementOf(uint vertex) {
  bool skinned = group.influences != NOT_SKINNED;
  JointInfluences influence = influences[skinned ? group.influences + vertex : 0u];
  vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  int joints = skinned ? 4 : 1;
  for (int k = 0; k < joints; ++k) {
    float weight = skinned ? influence.weights[k] : 1.0;
    uint matrix = group.matrix + (skinned ? influence.joints[k] : 0u);
    for (int row = 0; row < 3; ++row) rows[row] += weight * poseMatrices[matrix].rows[row];
  }
  return Placement(transpose(mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz)), vec3(rows[0].w, rows[1].w, rows[2].w));
}

// `part`: 0 position, 1 normal, 2 tangent.
vec3 morphed(vec3 value, uint vertex, uint part) {
  for (uint k = 0u; k < group.morphCount; ++k) {
    MorphWeight target = morphWeights[group.morphWeights + k];
    uint delta = target.deltas + MORPH_FLOATS * vertex + 3u * part;
    value += target.weight * vec3(morphDeltas[delta], morphDeltas[delta + 1u], morphDeltas[delta + 2u]);
  }
  return value;
}

vec3 restPosition(uint vertex) { return morphed(restVertices[group.rest + vertex].position, vertex, 0u); }

// Unit length, or the fallback for a vector of zero. Scaled first, as squares of tiny values underflow.
vec3 unit(vec3 v, vec3 fallback) {
  float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
  return largest > 0.0 ? normalize(v / largest) : fallback;
}

// As in scene/tangents.cpp.
vec3 anyPerpendicular(vec3 normal) {
  float side = normal.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (side + normal.z);
  return normalize(vec3(1.0 + side * normal.x * normal.x * a, side * normal.x * normal.y * a, -side * normal.x));
}

// Of the triangle that the vertex belongs to. An offset that its corners share is left out, for precision.
vec3 flatNormal(uint vertex) {
  vec3 corners[3] = vec3[3](vec3(0.0), vec3(0.0), vec3(0.0));
  uint count = (group.flags & POSE_FLAT_NORMALS) != 0u ? 3u : 0u;
  for (uint k = 0u; k < count; ++k) {
    uint corner = vertex - vertex % 3u + k;
    Placement placement = placementOf(corner);
    corners[k] = placement.linear * restPosition(corner);
    if (group.influences != NOT_SKINNED) corners[k] += placement.offset;
  }
  vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  return unit((group.flags & POSE_TURNED) != 0u ? -normal : normal, vec3(0.0, 1.0, 0.0));
}

void main() {
  if (number >= groupCount || gl_LocalInvocationID.x >= group.count) return;
  uint vertex = group.first + gl_LocalInvocationID.x;
  RestVertex rest = restVertices[group.rest + vertex];
  Placement placement = placementOf(vertex);
  mat3 linear = placement.linear;
  float side = determinant(linear) < 0.0 ? -1.0 : 1.0;

  vec3 position = placement.offset + linear * restPosition(vertex);
  // The inverse transpose times the absolute determinant, which flattening matrices have, too.
  mat3 cofactors = mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
  vec3 normal = unit(side * (cofactors * morphed(rest.normal, vertex, 1u)), vec3(0.0, 1.0, 0.0));
  vec3 ofTriangle = flatNormal(vertex);
  if ((group.flags & POSE_FLAT_NORMALS) != 0u) normal = ofTriangle;
  vec3 tangent = unit(linear * morphed(rest.tangent, vertex, 2u), vec3(0.0));
  tangent = unit(tangent - normal * dot(normal, tangent), anyPerpendicular(normal));

  uint place = group.vertex + vertex;
  positions[3u * place] = position.x;
  positions[3u * place + 1u] = position.y;
  positions[3u * place + 2u] = position.z;
  attributes[place].normal = normal;
  attributes[place].bitangentSign = side * rest.bitangentSign;
  attributes[place].tangent = tangent;
}
