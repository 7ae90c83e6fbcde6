// Positions and normals of a part of the G-buffer, written whole for the host.
#include "lib/surface_point.glsl"
#include "shared/passes/read_surfaces.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f, binding = IMAGE_READ_POSITION) uniform writeonly image2D positionImage;
layout(rgba32f, binding = IMAGE_READ_NORMAL) uniform writeonly image2D normalImage;

uniform int firstColumn;  // of the part
uniform int firstRow;

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(positionImage)))) return;
  ivec2 pixel = place + ivec2(firstColumn, firstRow);
  imageStore(positionImage, place, surfacePoint(pixel));
  imageStore(normalImage, place, facingAt(pixel));
}
