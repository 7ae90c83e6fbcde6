// How the colors of a pixel add up: base + share * reflection. Without a traced ray the sky stands in for the reflection.
// With WITH_SEEN the screen has a say in what is too rough to be traced.
#include "lib/coat.glsl"
#include "lib/gbuffer.glsl"
#include "lib/sky.glsl"

layout(binding = UNIT_SHADED) uniform sampler2D gShaded;
#ifdef WITH_SEEN
layout(binding = UNIT_SEEN) uniform sampler2D gSeen;
#endif

struct Blend {
  vec3 base;   // radiance without the traced reflection
  vec3 share;  // of the reflection; 0 if there is none
  vec3 sky;    // radiance of the sky in the reflected direction
};

// Of a surface, the mirror that rays follow: of its coat or its own, see lib/coat.glsl.
struct Mirror {
  vec3 f0, reflectance;
  vec3 skyShare;  // of the sky in what is too rough to be traced
  bool coated;
};

// `toEye` and `facing`: unit; `material` as the G-buffer has it.
Mirror mirrorOf(ivec2 pixel, vec4 material, vec3 facing, vec3 toEye) {
  float cosine = dot(facing, toEye);
  Mirror m = Mirror(material.rgb, fresnelSchlick(material.rgb, cosine), skyShare(material.rgb, material.a, cosine), false);
  vec4 coat = vec4(0.0);
  if (frame.coats != 0u) coat = texelFetch(gCoat, pixel, 0);
  if (coat.z == 0.0) return m;
  bool ofCoat = coat.z < 0.0;
  float film = filmReflectance(abs(coat.z), dot(ofCoat ? facing : fromOctahedral(coat.xy), toEye));
  if (ofCoat) return Mirror(FILM_F0, vec3(film), vec3(film * (1.0 - roughnessFade(material.a))), true);
  return Mirror(m.f0, (1.0 - film) * m.reflectance, (1.0 - film) * m.skyShare, true);
}

// What it reflects beside the traced share. `sky`: radiance in the mirror direction.
vec3 untraced(ivec2 pixel, Mirror m, float roughness, vec3 sky, float visibility) {
#ifdef WITH_SEEN
  if (frame.glossySamples != 0u) {
    vec4 seen = texelFetch(gSeen, pixel, 0);
    // Of the directions in which the screen shows nothing, no more can see the sky than do of all.
    if (seen.a >= 0.0)
      return m.reflectance * (1.0 - roughnessFade(roughness)) * (seen.rgb + min(seen.a, visibility) * sky);
  }
#endif
  return m.skyShare * (sky * visibility);
}

// `facing` as the G-buffer has it.
Blend blendOf(ivec2 pixel, vec4 facing) {
  vec3 normal = facing.xyz;
  vec4 shaded = texelFetch(gShaded, pixel, 0);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  bool unlit = material.a < 0.0;
  if (!isSurface(facing) || unlit && !goesOn(facing)) return Blend(shaded.rgb, vec3(0.0), vec3(0.0));
  vec3 direction = normalize(pixelRay(pixel));
  Mirror mirror = mirrorOf(pixel, material, normal, -direction);
  vec3 share = mirror.reflectance * roughnessFade(material.a);
  vec3 clear = skyRadiance(reflect(direction, normal), material.a), sky = clear * shaded.a;
  vec3 base = (mirror.coated ? vec3(1.0) : 1.0 - share) * shaded.rgb +
              untraced(pixel, mirror, material.a, clear, shaded.a);
  if (!goesOn(facing)) return Blend(base, share, sky);
  // What is traced lies behind the surface.
  float alpha = alphaOf(facing);
  return Blend(alpha * (unlit ? shaded.rgb : base + share * sky), vec3(1.0 - alpha), skyRadiance(direction, 0.0));
}
