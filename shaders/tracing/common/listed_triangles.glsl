// Triangles that a compute step has chosen, in one buffer: small ones from its front, large ones from its end.
#include "shared/passes/listed_triangles.h"

layout(std430, binding = SSBO_LISTED_TRIANGLES) coherent buffer ListedBlock {
  ListedTriangles listed;
  uint listedTriangles[];
};

uint placeOfLarge(uint number) { return uint(listedTriangles.length()) - 1u - number; }

void listSmallTriangle(uint triangle) {
  uint number = atomicAdd(listed.smallCount, 1u);
  if (number % TRIANGLE_GROUP == 0u && number / TRIANGLE_GROUP < MAX_TRIANGLE_GROUPS)
    atomicAdd(listed.smallGroupsX, 1u);
  listedTriangles[number] = triangle;
}

// For the pairs of large triangles and bricks, instead of the rasterizer.
void listPairedTriangle(uint triangle) {
  listedTriangles[placeOfLarge(atomicAdd(listed.pairedCount, 1u))] = triangle;
}

void listLargeTriangle(uint triangle) {
  listedTriangles[placeOfLarge(atomicAdd(listed.largeVertices, 6u) / 6u)] = triangle;
}
