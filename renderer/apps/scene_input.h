#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/model.h>
#include "apps/arguments.h"
#include "apps/light_argument.h"

// Scenes and cameras as the command line names them.
namespace halfsilver {

inline constexpr const char* kSceneHelp =
    ".gltf or .glb file, or builtin:NAME; a file's buffers and images are read from its folder and below, never "
    "through "
    "'..' from outside";
inline constexpr const char* kVariantHelp =
    "Use the materials of this variant, by name or index (see: halfsilver info)";

// A .gltf or .glb path, or "builtin:NAME", with the materials of a variant if one is named. Throws Error (badInput;
// usage for an unknown variant, listing the known ones).
Model loadScene(const std::string& name, const std::string& variant = {});

// Gives materials a reflectance at normal incidence; "*" means all. Throws Error (usage) for an unknown name, listing
// the known ones.
void applyMirrors(Scene& scene, std::span<const MirrorArgument> mirrors);

// Adds lights to those of the scene.
void addLights(Model& model, std::span<const LightArgument> lights);

struct CameraRequest {
  std::string name;                       // or index; empty: the scene's first
  std::optional<glm::dvec3> eye, target;  // world coordinates; both or none
  std::optional<double> fov;              // vertical, degrees; also changes a camera of the scene
};

// One of the cameras, which are relative to `origin` as the bounds are; if there is none and none is asked for, one
// that shows the bounds. Throws Error (usage): unknown camera (listing the known ones), eye without target or equal to
// it, fov not between 0 and 180.
Camera chooseCamera(std::span<const Camera> cameras, const Bounds& bounds, const glm::dvec3& origin,
                    const CameraRequest& request);
// One of the scene at rest.
Camera chooseCamera(const Scene& scene, const CameraRequest& request);

// The animations that --animation names: "all" or nothing for all that do not conflict, else one by name or index. A
// warning says which conflict. Throws Error (usage) for an unknown one.
std::vector<int> chooseAnimations(const Rig& rig, const std::string& name, std::vector<std::string>& warnings);

// "a, b, c", shortened if it is long.
std::string listNames(const std::vector<std::string>& names);

}  // namespace halfsilver
