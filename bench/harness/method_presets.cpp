#include "bench/harness/method_presets.h"

#include <algorithm>

#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "bench/harness/bench_scene.h"

namespace halfsilver::bench {
namespace {

// Whether the preset differs from the default in how rays are traced, not in what they are for.
bool comparesMethods(const Settings& settings) {
  const Settings usual;
  return settings.trace.method != "none" && settings.trace.effect == usual.trace.effect &&
         settings.effect.glossy == usual.effect.glossy;
}

}  // namespace

std::vector<std::string> methodPresets(bool quick, std::size_t triangles, bool exact) {
  std::vector<std::string> names = {kDefaultPreset};
  std::vector<Settings> taken = {presetSettings(kDefaultPreset, quick, triangles)};
  for (const MethodInfo& method : methods())
    for (const Preset& preset : presets()) {
      const Settings settings = presetSettings(preset.name, quick, triangles);
      if (settings.trace.method != method.name || !comparesMethods(settings) || (preset.name == kReference && !exact) ||
          std::find(taken.begin(), taken.end(), settings) != taken.end())
        continue;
      names.push_back(preset.name);
      taken.push_back(settings);
    }
  return names;
}

ReflectivePreset reflectivePreset(const std::string& preset, bool quick, std::size_t triangles) {
  ReflectivePreset result{preset, presetSettings(preset, quick, triangles)};
  if (result.settings.select.mode != SelectMode::reflective) result.name += " reflective";
  result.settings.select.mode = SelectMode::reflective;
  return result;
}

}  // namespace halfsilver::bench
