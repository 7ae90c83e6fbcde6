// Light that is added to pixels: in fixed point, so that sums depend on no order and equal rays give equal bits.
#include "shared/passes/light_sums.h"
#include "shared/rays.h"

layout(std430, binding = SSBO_LIGHT_SUMS) buffer LightSumBlock { LightSum lightSums[]; };

uniform uint firstPixel;  // of the batch

const float BRIGHTEST = 1e9;

// What is negative or no number is nothing.
void addLight(uint pixel, vec3 light) {
  for (int i = 0; i < 3; ++i) {
    float value = light[i] > 0.0 ? min(light[i], BRIGHTEST) : 0.0;
    uint high = uint(value * (1.0 / 16.0));
    uint low = uint((value - float(high) * 16.0) * 268435456.0);  // 2^28; the difference is exact
    if ((high | low) == 0u) continue;
    uint before = atomicAdd(lightSums[pixel - firstPixel].low[i], low);
    if (before > 0xffffffffu - low) ++high;
    if (high != 0u) atomicAdd(lightSums[pixel - firstPixel].high[i], high);
  }
}
