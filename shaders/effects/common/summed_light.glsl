// What a sum of light is worth.
#include "shared/rays.h"

vec3 radianceOf(LightSum sum) {
  vec3 high = vec3(sum.high[0], sum.high[1], sum.high[2]), low = vec3(sum.low[0], sum.low[1], sum.low[2]);
  return 16.0 * high + low / 268435456.0;
}
