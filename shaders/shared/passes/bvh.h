// Bindings, constants and structs of the bvh method: tracing/bvh/.
#ifndef HALFSILVER_PASSES_BVH_H
#define HALFSILVER_PASSES_BVH_H

#define SSBO_BVH_NODES 12      // BvhNode[]
#define SSBO_BVH_TRIANGLES 13  // uint[]: numbers, leaf by leaf

#define BVH_WIDTH 4
#define BVH_MAX_LEAF 4  // triangles

// A child: the number of its node, or a leaf: the first of its triangles and how many there are, less one.
#define BVH_NO_CHILD 0xffffffffu
#define BVH_LEAF 0x80000000u
#define BVH_LEAF_SHIFT 29  // of the count
#define BVH_LEAF_FIRST 0x1fffffffu

// Levels of nodes at most; a ray leaves up to three children behind at each.
#define BVH_MAX_DEPTH 21
#define BVH_STACK 64

// Four children and their boxes, 64 bytes. A box is a multiple of the node's step from its origin along each axis, in a
// byte: child i has bits 8 i to 8 i + 7 of a word. The steps are powers of two, so a bound is exact but for one sum.
struct BvhNode {
  vec3 origin;
  uint exponents;  // of the steps, as floats have them: x in bits 0..7, y, z
  uint low[3];
  uint parent;  // number; the root's own
  uint high[3];
  uint padding;
  uint children[BVH_WIDTH];
};

#endif
