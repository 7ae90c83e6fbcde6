#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>

#include <halfsilver/scene.h>

// Small tileable pictures made in code: seamless in both directions unless stated otherwise. Colors are given and
// stored sRGB-encoded; normal maps follow glTF (green is up in the picture).
namespace halfsilver {

struct SurfaceTextures {
  std::shared_ptr<const Texture> color;
  std::shared_ptr<const Texture> normal;
};

// Ashlar: six courses of three blocks, 512 texels; meant for 2.4 m.
SurfaceTextures stoneBlocks();
// Sixteen courses of bricks in stretcher bond, 512 texels; meant for 1.3 m.
SurfaceTextures bricks();
// Planks along v, 256 texels; meant for 1 m.
SurfaceTextures woodPlanks();
// Four slabs of veined marble (two by two) with fine dark edges, near white, 512 texels.
std::shared_ptr<const Texture> marbleSlabs();
// Faint clouds on near white, 256 texels: to be tinted by the material.
std::shared_ptr<const Texture> plaster();
// Woven cloth with a pattern of medallions and bordered edges (u = 0 and 1, v = 1; not tileable), 256 texels.
std::shared_ptr<const Texture> damask(const std::string& name, glm::vec3 ground, glm::vec3 figure);
// A sprig with leaflets that grows from (0.5, 1) to (0.5, 0); alpha is the cut-out, 256 texels. Not tileable.
std::shared_ptr<const Texture> leafSprig();
// Two by two checks, 256 texels.
std::shared_ptr<const Texture> checker(glm::vec3 light, glm::vec3 dark);

}  // namespace halfsilver
