// Rays, what effects know of them and what tracers answer; laid out as the structs of structs.h.
#ifndef HALFSILVER_RAYS_H
#define HALFSILVER_RAYS_H

// Ray results in Hit::t.
#define HIT_MISS -1.0
#define HIT_NOT_TRACED -2.0
#define HIT_OVERFLOW -3.0

// One ray as a tracer sees it.
struct Ray {
  vec3 origin;        // relative to Scene::origin, meters
  float maxDistance;  // hits beyond are misses, meters; FAR_AWAY: none is too far
  vec3 direction;     // unit
  uint excluded;      // triangle that the ray starts on, or NO_TRIANGLE
};
#define FAR_AWAY 3.0e38f

// Hits nearer than this share of the largest coordinate of a ray's origin are ignored: eight rounding steps.
#define NEAREST_SHARE (1.0f / 1048576.0f)

// RayCount::source: what SSBO_RAYS holds of a queue's rays.
#define RAYS_STORED 0u     // Ray[], with a RayPath[] at the same index
#define RAYS_OF_PIXELS 1u  // uint[]: pixels, as RayPath::pixel; mirror rays that start on the G-buffer's surfaces
#define RAYS_OF_CAMERA 2u  // uint[]: pixels; rays from the eye to the G-buffer's surfaces

// What an effect knows of a stored ray, at the same index.
struct RayPath {
  vec3 throughput;
  float pathLength;  // from the eye to the origin, meters (for texture footprints)
  uint pixel;        // y * width + x, row 0 at the bottom
  uint kindAndCounts;  // RAY_... | COUNTED_REFLECTION for each on the way, its own included | COUNTED_CLEAR likewise
  uint slot;         // where its light is summed; no two rays of a dispatch share one
  uint media;        // that the ray is in, see lib/media.glsl
};
#define COUNTED_REFLECTION (1u << 8)
#define COUNTED_CLEAR (1u << 16)  // a refraction, or a reflection inside of a volume
#define RAY_REFLECTION 0u
#define RAY_REFRACTION 1u
#define RAY_SHADOW 2u
#define RAY_OCCLUSION 3u
#define RAY_SCATTERED 4u  // a path's next stretch
#define RAY_THROUGH 5u    // the same way on, behind a surface
#define RAY_KINDS 8

// The same of a ray whose light is added to its pixel's LightSum. As large as a RayPath, pixel and kind in the same
// places.
struct ScatteredPath {
  vec3 throughput;    // a shadow ray's: the light that it brings if nothing is in its way
  float pathLength;   // as above
  uint pixel;         // as above
  uint kindAndSample; // RAY_... | sample << 8; of paths the sample has 8 bits, and surfaces passed are above them
  uint media;         // that the ray is in, see lib/media.glsl
  float density;      // of choosing the direction, per solid angle; 0: no choice; of a path's ray to a light its weight
};

// Light of all passes and samples of a pixel: sums in fixed point, high * 16 + low * 2^-28, so that they depend on no
// order.
struct LightSum {
  uint low[3];
  uint high[3];
};

// Light that the rays of one slot have gathered. The first generation's shading begins it.
struct Radiance {
  vec3 sum;
  uint pixel;  // that it belongs to, or NO_PIXEL if the slot's first ray was given up
};
#define NO_PIXEL 0xffffffffu

// Filled by the effect; `groups*` is an indirect dispatch of 64 rays per group.
struct RayCount {
  uint groupsX;
  uint groupsY;
  uint groupsZ;
  uint count;
  uint reflecting;  // before the selection is thinned by fraction and contribution
  uint unfinished;  // rays that a dispatch left for the next one (see tracing)
  uint overflow;    // rays that were given up
  uint source;      // RAYS_...
  uint byKind[RAY_KINDS];  // stored rays of all that the queue has held in a frame
};

// Result of one ray (16 bytes). t in meters along the unit direction; triangle is NO_TRIANGLE unless it hit.
struct Hit {
  float t;
  uint triangle;
  float u;  // barycentric weight of the second vertex
  float v;  // of the third
};

// What a search did for a ray, if it counts (trace.count_work).
struct RayWork {
  uint steps;  // cells or nodes
  uint tests;  // of triangles, or texels looked at
};

// A pixel's rays of one kind.
struct KindTally {
  uint rays;
  uint hits;
  uint low;  // of the hits' distances, in TALLY_UNIT of the scene's diagonal; the carry is in `high`
  uint high;
};
#define TALLY_UNIT (1.0f / 1048576.0f)

// A ray that waits for the next dispatch, at the ray's index.
struct PausedRay {
  float t;            // where to go on, meters
  uint bestTriangle;  // nearest so far + 1, or 0
  uint tested;        // candidates of the voxel at t that are done
  uint own;           // the method's own
};

// Surface attributes of a hit as a method stored them (Kastrati & Goswami 2017, figure 2).
struct HitSurface {
  vec3 baseColor;
  float padding;
  vec3 normal;  // unit
  float reflectivity;
};

#endif
