// Bindings and structs of the pass that poses vertices: passes/pose.comp.
#ifndef HALFSILVER_PASSES_POSE_H
#define HALFSILVER_PASSES_POSE_H

#define SSBO_REST 9            // RestVertex[]
#define SSBO_INFLUENCES 10     // JointInfluences[], of skinned vertices
#define SSBO_MORPH_DELTAS 11   // float[MORPH_FLOATS * vertices] per target
#define SSBO_MORPH_WEIGHTS 12  // MorphWeight[]
#define SSBO_POSE_MATRICES 13  // PoseMatrix[]
#define SSBO_POSE_GROUPS 14    // PoseGroup[]

// Invocations per group: up to so many vertices of one instance, or triangles if it has flat normals.
#define POSE_GROUP 64
// Of a vertex in a morph target: changes of position, normal and tangent.
#define MORPH_FLOATS 9
// PoseGroup::flags.
#define POSE_TURNED 1u  // flat triangles wind the other way round

struct RestVertex {
  vec3 position;  // relative to the middle of the instance's rest positions
  float bitangentSign;
  vec3 normal;
  float padding0;
  vec3 tangent;
  float padding1;
};

struct JointInfluences {
  uint joints[4];
  float weights[4];  // those of a vertex have the sum 1
};

struct MorphWeight {
  uint deltas;  // the first float of the target
  float weight;
};

// From relative rest positions to positions relative to Scene::origin.
struct PoseMatrix {
  vec4 rows[3];
};

struct PoseGroup {
  uint first;   // vertex or triangle of the instance
  uint count;   // of these
  uint vertex;  // of the scene: the instance's first
  uint rest;    // likewise, and the next three
  uint influences;
  uint matrix;
  uint morphWeights;
  uint morphCount;
  uint flags;
  uint jointSets;  // JointInfluences per vertex
  uint padding0;
  uint padding1;
};

#endif
