#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

// Parses the values of options. Each function throws Error (usage) that names the option and what it takes.
namespace halfsilver {

struct Size {
  int width = 0, height = 0;  // 1..16384
};

Size parseSize(std::string_view text);  // "960x540"

// "1.5,0,-2"; finite.
glm::dvec3 parseVector(std::string_view option, std::string_view text);

struct MirrorArgument {
  std::string material;    // or "*"
  float reflectivity = 0;  // 0..1
};

MirrorArgument parseMirror(std::string_view text);  // "floor=0.9"

struct ViewArgument {
  std::string scene;
  glm::dvec3 eye{0}, target{0};  // world coordinates
  std::optional<double> fov;     // vertical, degrees
};

ViewArgument parseView(std::string_view text);  // "sponza.glb=13,1.2,0.4,-5,2.6,-0.2,60"; the last is optional

struct SettingArgument {
  std::string name, value;
};

SettingArgument parseSetting(std::string_view text);  // "voxels.resolution=64"

}  // namespace halfsilver
