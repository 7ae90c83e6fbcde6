#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <halfsilver/settings.h>

namespace halfsilver::bench {

// What a comparison of methods consists of: the presets that send mirror rays through a method of the table, the
// default first, the others in the table's order. Of presets that come to the same settings at the same size of a
// scene, the first. With `exact`, the reference is one of them.
std::vector<std::string> methodPresets(bool quick, std::size_t triangles, bool exact);

// A preset's rays set aside: those of the reflective pixels, as the other methods trace them.
struct ReflectivePreset {
  std::string name;  // the preset's, with " reflective" if it takes other pixels
  Settings settings;
};
ReflectivePreset reflectivePreset(const std::string& preset, bool quick, std::size_t triangles);

}  // namespace halfsilver::bench
