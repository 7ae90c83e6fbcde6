#pragma once

// Settings of shadows, see settings.h.
namespace halfsilver {

// How the direct lights' shadows are found, in the deferred shading and in reflections. Effects that follow light on
// their own (RayEffect::bringsAllLight) are not asked, but whitted sends no ray where refined needs none.
enum class ShadowMethod {
  maps,
  rays,    // to each light from every surface; shadows of rectangles and spheres are soft
  refined  // rays from what reflections show and from pixels that are near an edge of a map's shadow, else maps
};

// How the map of a directional light lies.
enum class ShadowProjection {
  uniform,     // over the whole scene, kept while the camera moves
  perspective  // a second one over what the camera sees, finer near it and redrawn when it moves
};

struct ShadowSettings {
  ShadowMethod method = ShadowMethod::maps;
  ShadowProjection projection = ShadowProjection::uniform;
  int resolution = 864;    // texels, of each shadow map, 16..8192
  int skyDirections = 10;  // shadowed directions that stand for the sky, 0..32; 0: unshadowed sky light
  int samples = 8;         // rays to a light that has an extent, 1..64
  int kernel = 5;          // refined: pixels along the square around an edge that rays decide, 1..31, odd

  bool operator==(const ShadowSettings&) const = default;
};

}  // namespace halfsilver
