#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include <halfsilver/scene.h>

namespace halfsilver {

struct LightArgument {
  Light light;             // without its position
  glm::dvec3 position{0};  // world coordinates
};

inline constexpr const char* kLightHelp =
    "Add a light: directional:DX,DY,DZ:R,G,B (lux), point:X,Y,Z:R,G,B (candela), sphere:X,Y,Z:RADIUS:R,G,B or "
    "rectangle:X,Y,Z:UX,UY,UZ:VX,VY,VZ:R,G,B (nits; half edges, shines along cross(u, v)); can be repeated";

// The value of --light: the kind, its fields, and the color times the intensity in the kind's unit, see Light.
//   directional:DX,DY,DZ:R,G,B
//   point:X,Y,Z:R,G,B
//   sphere:X,Y,Z:RADIUS:R,G,B
//   rectangle:X,Y,Z:UX,UY,UZ:VX,VY,VZ:R,G,B   center and two half edges; it shines along cross(u, v)
// Throws Error (usage) that names what the kind takes.
LightArgument parseLight(std::string_view text);

}  // namespace halfsilver
