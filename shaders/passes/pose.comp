// Poses vertices after the glTF 2.0 specification, section 3.7: rest pose, then morph targets, then joints or the node.
// What scene/pose.cpp does on the host. SKINNED, MORPHED and FLAT_NORMALS are defined for what the instances of a batch
// have, so that nobody pays for what others do.
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

uniform uint firstGroup, groupCount;

uint number = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
PoseGroup group = groups[firstGroup + min(number, groupCount - 1u)];

struct Placement {
  mat3 linear;
  vec3 offset;
};

Placement placementOf(vec4 rows[3]) {
  return Placement(transpose(mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz)), vec3(rows[0].w, rows[1].w, rows[2].w));
}

Placement placementOf(uint vertex) {
#ifdef SKINNED
  vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  for (uint set = 0u; set < group.jointSets; ++set) {
    JointInfluences influence = influences[group.influences + group.jointSets * vertex + set];
    for (int k = 0; k < 4; ++k) {
      PoseMatrix matrix = poseMatrices[group.matrix + influence.joints[k]];
      for (int row = 0; row < 3; ++row) rows[row] += influence.weights[k] * matrix.rows[row];
    }
  }
  return placementOf(rows);
#else
  return placementOf(poseMatrices[group.matrix].rows);
#endif
}

// `part`: 0 position, 1 normal, 2 tangent.
vec3 morphed(vec3 value, uint vertex, uint part) {
#ifdef MORPHED
  for (uint k = 0u; k < group.morphCount; ++k) {
    MorphWeight target = morphWeights[group.morphWeights + k];
    uint delta = target.deltas + MORPH_FLOATS * vertex + 3u * part;
    value += target.weight * vec3(morphDeltas[delta], morphDeltas[delta + 1u], morphDeltas[delta + 2u]);
  }
#endif
  return value;
}

// Relative to the placement's offset.
vec3 turnedPosition(uint vertex, mat3 linear) {
  return linear * morphed(restVertices[group.rest + vertex].position, vertex, 0u);
}

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

float sideOf(mat3 linear) { return determinant(linear) < 0.0 ? -1.0 : 1.0; }

vec3 normalOf(uint vertex, mat3 linear) {
  // The inverse transpose times the absolute determinant, which flattening matrices have, too.
  mat3 cofactors = mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
  vec3 normal = morphed(restVertices[group.rest + vertex].normal, vertex, 1u);
  return unit(sideOf(linear) * (cofactors * normal), vec3(0.0, 1.0, 0.0));
}

// Of a triangle.
vec3 flatNormal(vec3 corners[3]) {
  vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  return unit((group.flags & POSE_TURNED) != 0u ? -normal : normal, vec3(0.0, 1.0, 0.0));
}

void write(uint vertex, Placement placement, vec3 position, vec3 normal) {
  RestVertex rest = restVertices[group.rest + vertex];
  vec3 tangent = unit(placement.linear * morphed(rest.tangent, vertex, 2u), vec3(0.0));
  tangent = unit(tangent - normal * dot(normal, tangent), anyPerpendicular(normal));
  uint place = group.vertex + vertex;
  positions[3u * place] = position.x;
  positions[3u * place + 1u] = position.y;
  positions[3u * place + 2u] = position.z;
  attributes[place].normal = normal;
  attributes[place].bitangentSign = sideOf(placement.linear) * rest.bitangentSign;
  attributes[place].tangent = tangent;
}

void main() {
  if (number >= groupCount || gl_LocalInvocationID.x >= group.count) return;
#ifdef FLAT_NORMALS
  uint vertex = 3u * (group.first + gl_LocalInvocationID.x);
  Placement placements[3];
  vec3 corners[3], offsets[3];
  for (uint k = 0u; k < 3u; ++k) {
    placements[k] = placementOf(vertex + k);
    corners[k] = turnedPosition(vertex + k, placements[k].linear);
    offsets[k] = placements[k].offset;
#ifdef SKINNED
    // An offset that the corners share stays apart, for precision.
    corners[k] += offsets[k];
    offsets[k] = vec3(0.0);
#endif
  }
  vec3 normal = flatNormal(corners);
  for (uint k = 0u; k < 3u; ++k) write(vertex + k, placements[k], corners[k] + offsets[k], normal);
#else
  uint vertex = group.first + gl_LocalInvocationID.x;
  Placement placement = placementOf(vertex);
  vec3 position = placement.offset + turnedPosition(vertex, placement.linear);
  write(vertex, placement, position, normalOf(vertex, placement.linear));
#endif
}
