#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/scene.h>

namespace halfsilver {

// A unit vector perpendicular to a unit vector, continuous except at -z.
glm::vec3 anyPerpendicular(const glm::vec3& normal);

// Writes tangents from positions, normals and texture coordinates after M. S. Mikkelsen, "Simulation of Wrinkled
// Surfaces Revisited" (2008): at each corner the direction in which u grows, projected into the plane of the normal and
// summed over equal vertices with the corner's angle as weight. glTF's sign: bitangent = w * cross(normal, tangent)
// points against growing v. The texture coordinates are those of `uvSet` after `transform`. A vertex shared by
// triangles of both orientations is split: copies are added at the end and the triangles changed. Returns for each
// added vertex the one that it copies.
std::vector<std::uint32_t> makeTangents(std::vector<Vertex>& vertices,
                                        std::span<std::array<std::uint32_t, 3>> triangles, std::size_t uvSet,
                                        const std::array<glm::vec3, 2>& transform);

}  // namespace halfsilver
