// An entry of a list: a triangle, and above its number a box in the voxel, which slices of it, along each axis, the
// triangle reaches into there. Most parts of triangles are small, so a ray that crosses the voxel passes most of them by.
uniform int boxSlices;      // along an axis: 4 if triangles leave 12 bits, or 3, 2 or 0
uniform uint triangleBits;  // mask of the bits that hold the triangle
uniform uint boxShift;      // below the box
uniform uint boxFold0;      // shifts that bring the bits of an axis together at its lowest
uniform uint boxFold1;
uniform uint boxAxes;       // these lowest bits

// Boxes are larger by more than rounding moves a point of a ray or of a triangle.
const float boxSlack = 0.002;  // voxels

uint packEntry(uint triangle, uint box) { return triangle | box << boxShift; }
uint triangleOf(uint entry) { return entry & triangleBits; }

// Until its run is complete, an entry holds its voxel's number in the brick in place of the box.
uint packVoxelEntry(uint triangle, uint voxel) { return packEntry(triangle, boxSlices > 0 ? voxel : 0u); }

// The slices that a range, 0 to 1 in the voxel, reaches into: a bit each.
uint slicesOf(float low, float high) {
  int last = max(boxSlices - 1, 0);
  int from = clamp(int(floor((low - boxSlack) * float(boxSlices))), 0, last);
  int to = clamp(int(floor((high + boxSlack) * float(boxSlices))), 0, last);
  uint all = (1u << uint(boxSlices)) - 1u;
  return (all << uint(from)) & (all >> uint(last - to));
}

// `low`, `high` in voxels, from the voxel's lowest corner.
uint boxBits(vec3 low, vec3 high) {
  uint slices = uint(boxSlices);
  return slicesOf(low.x, high.x) | slicesOf(low.y, high.y) << slices | slicesOf(low.z, high.z) << (2u * slices);
}

// Whether the entry's box and one of two others share a slice of each axis.
bool boxMeets(uint entry, uvec2 boxes) {
  uvec2 both = uvec2(entry >> boxShift) & boxes;
  both |= both >> boxFold0;
  both |= both >> boxFold1;
  both &= boxAxes;
  return both.x == boxAxes || both.y == boxAxes;
}
