// The lights (GpuLight) as texels of floats. Software rasterizers read a storage buffer number by number and lane by
// lane, a texel in one go.
#include "shared/bindings.h"
#include "shared/structs.h"

layout(binding = UNIT_LIGHTS) uniform samplerBuffer lightTexels;

// Texels of a GpuLight.
const int LIGHT_TEXELS = 31;
const int LIGHT_POSITION = 0;    // position, range
const int LIGHT_DIRECTION = 1;   // direction, type
const int LIGHT_COLOR = 2;       // color, width of a shadow texel
const int LIGHT_SHADOW = 3;      // cone's scale and offset, first shadow layer, shadow layers
const int LIGHT_HEMISPHERE = 4;  // steady share
const int LIGHT_EXTENT = 4;      // y a sphere's radius, z the area
const int LIGHT_HALF_WIDTH = 5;  // of a rectangle
const int LIGHT_HALF_HEIGHT = 6;
const int LIGHT_MATRICES = 7;  // four for each layer

vec4 lightTexel(uint light, int texel) { return texelFetch(lightTexels, int(light) * LIGHT_TEXELS + texel); }

mat4 shadowMatrix(uint light, int face) {
  int first = LIGHT_MATRICES + 4 * face;
  return mat4(lightTexel(light, first), lightTexel(light, first + 1), lightTexel(light, first + 2),
              lightTexel(light, first + 3));
}
