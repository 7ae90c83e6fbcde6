// How the colors of a pixel add up: base + share * reflection. Without a traced ray the sky stands in for the reflection.
#include "lib/fresnel.glsl"
#include "lib/gbuffer.glsl"
#include "lib/sky.glsl"

layout(binding = UNIT_SHADED) uniform sampler2D gShaded;

struct Blend {
  vec3 base;   // radiance without the traced reflection
  vec3 share;  // of the reflection; 0 if there is none
  vec3 sky;    // radiance of the sky in the reflected direction
};

// `position` and `normal` as the G-buffer has them.
Blend blendOf(ivec2 pixel, vec4 position, vec4 facing) {
  vec3 normal = facing.xyz;
  vec4 shaded = texelFetch(gShaded, pixel, 0);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  bool unlit = material.a < 0.0;
  if (position.w <= 0.0 || unlit && !goesOn(facing)) return Blend(shaded.rgb, vec3(0.0), vec3(0.0));
  vec3 direction = normalize(fromCamera(position.xyz));
  float cosine = -dot(normal, direction);
  vec3 share = reflectionShare(material.rgb, material.a, cosine);
  vec3 sky = skyRadiance(reflect(direction, normal), material.a) * shaded.a;
  vec3 base = (1.0 - share) * shaded.rgb + skyShare(material.rgb, material.a, cosine) * sky;
  if (!goesOn(facing)) return Blend(base, share, sky);
  // What is traced lies behind the surface.
  float alpha = alphaOf(facing);
  return Blend(alpha * (unlit ? shaded.rgb : base + share * sky), vec3(1.0 - alpha), skyRadiance(direction, 0.0));
}
