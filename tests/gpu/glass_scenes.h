#pragma once

#include <glm/glm.hpp>

#include <halfsilver/scene.h>

// Glass in simple shapes, and what optics says of it.
namespace halfsilver::testing {

// Fresnel's reflectance of unpolarized light by the cosine before and the index before over that behind.
double reflectance(double cosine, double ratio);

// Through the center of a pixel of a picture, unit. The camera is upright.
glm::dvec3 pixelRay(const Camera& camera, int x, int y, int width, int height);

Material unlit(const glm::vec3& color);
Material glass(float ior, float thickness);

// A floor on y = 0 whose light says where it is: x and z in 0..1 over its span, and 1.
inline constexpr double kSpan = 20;  // meters
void addTellingFloor(Scene& scene);

// Such a floor below a slab, under a black sky; a thin one is a single wall at its top.
inline constexpr double kLow = 0.5, kHigh = 0.9;  // meters
Scene slabOverFloor(const Material& material);

extern const Camera kOverSlab;
extern const Camera kOntoSlab;  // all pixels show it

// A ball of glass over a floor among triangles, in the light of the sun and a lamp.
Scene glassAmongTriangles();

}  // namespace halfsilver::testing
