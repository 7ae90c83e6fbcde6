#pragma once

#include <memory>
#include <string>

#include <halfsilver/model.h>
#include "builtin/mesh_builder.h"
#include "builtin/procedural_textures.h"

// What all scenes made in code share: the built-in ones and those of benchmarks.
namespace halfsilver {

inline constexpr glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

Model makeSphereScene();
Model makeTeapotScene();
Model makeAtriumScene();
Model makeGameScene();
Model makeCornellScene(bool boxes);
Model makeFurnaceScene();
Model makeSlabScene();
Model makePrismScene();
Model makeGlassScene();

// Newell's teapot in its own units: standing on y = 0, 3.15 high, spout along +x. Each of the 32 patches becomes
// steps x steps cells.
void addTeapot(MeshBuilder& builder, double scale, glm::dvec3 base, int steps);

std::uint32_t addMaterial(Scene& scene, Material material);
TextureUse addTexture(Scene& scene, std::shared_ptr<const Texture> texture);

Material dielectric(std::string name, glm::vec3 linearColor, float roughness);
Material metal(std::string name, glm::vec3 linearColor, float roughness);

Sky clearSky();
Light sunlight(glm::vec3 travels, glm::vec3 color, float lux);
Camera lookAt(std::string name, glm::vec3 eye, glm::vec3 target, float verticalFovDegrees);

// Moves a finished mesh into the scene.
void setMesh(Scene& scene, Mesh mesh);

}  // namespace halfsilver
