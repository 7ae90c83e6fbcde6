// Binding, constants and struct of triangles that compute steps list: tracing/common/listed_triangles.glsl. Passes that
// list triangles touch no queue of rays and use its numbers.
#ifndef HALFSILVER_PASSES_LISTED_TRIANGLES_H
#define HALFSILVER_PASSES_LISTED_TRIANGLES_H

#define SSBO_LISTED_TRIANGLES 7  // ListedTriangles, then uint[triangles]

// A triangle is small if its box has at most so many texels in every projection, and so many depths.
#define SMALL_TEXELS 128
#define SMALL_DEPTHS 64
// Invocations per group of a dispatch over triangles, and the groups along x that OpenGL guarantees.
#define TRIANGLE_GROUP 64
#define MAX_TRIANGLE_GROUPS 65535

// Arguments of an indirect draw of the large triangles, then of an indirect dispatch over the small ones.
struct ListedTriangles {
  uint largeVertices;
  uint projections;
  uint firstVertex;
  uint firstInstance;
  uint smallGroupsX;
  uint smallGroupsY;
  uint smallGroupsZ;
  uint smallCount;
  uint pairedCount;  // large ones that are not rasterized
};

#endif
