// Smooths glossy reflections over neighbors with alike surfaces, the wider the rougher; mirrors stay as they are.
// With SEEN what the screen has answered: the share that it does not know, too.
#include "lib/gbuffer.glsl"
#include "shared/passes/resolve.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_REFLECTION) uniform sampler2D gReflection;
layout(binding = IMAGE_REFLECTION, rgba32f) uniform writeonly image2D filtered;

const int REACH = 3;            // pixels
const float WIDEST = 2.0;       // standard deviation, pixels
const float WIDE_ROUGHNESS = 0.3;  // from which on it is that

#ifdef SEEN
bool known(vec4 light) { return light.a >= 0.0; }
#else
bool known(vec4 light) { return light.a > 0.0; }
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return;
  vec4 traced = texelFetch(gReflection, pixel, 0);
  float roughness = texelFetch(gMaterial, pixel, 0).a;
  vec4 facing = facingAt(pixel);
  if (known(traced) && roughness > 0.0 && !goesOn(facing)) {
    vec3 position = drawnPoint(pixel), normal = facing.xyz;
    float deviation = WIDEST * min(roughness / WIDE_ROUGHNESS, 1.0), pixelWidth = coneWidth(drawnDepth(pixel));
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = -REACH; y <= REACH; ++y)
      for (int x = -REACH; x <= REACH; ++x) {
        ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(frame.width, frame.height) - 1);
        vec4 light = texelFetch(gReflection, other, 0);
        vec4 otherFacing = facingAt(other);
        float cosine = max(dot(normal, otherFacing.xyz), 0.0);
        float offPlane = abs(dot(normal, drawnPoint(other) - position)) / pixelWidth;
        float unlike = abs(texelFetch(gMaterial, other, 0).a - roughness);
        float weight = exp(-0.5 * float(x * x + y * y) / (deviation * deviation) - offPlane - 40.0 * unlike) *
                       pow(cosine, 64.0);
        if (!known(light) || goesOn(otherFacing)) continue;
        sum += weight * light;
        weights += weight;
      }
    traced = sum / weights;  // the pixel itself has the weight 1
  }
  imageStore(filtered, pixel, traced);
}
