#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "settings.h"

// Settings in TOML: sections and keys are the settings' names ([voxels] resolution = 64). A file names only what it
// changes. The presets are the files config/<name>.toml, embedded in the library.
namespace halfsilver {

// Applies a text to the settings. `name` stands for the file in messages. Throws Error (badInput) with
// "name:line: what" for a syntax error, an unknown key, a value of the wrong type or out of range; the settings are
// then unchanged.
void applySettingsText(Settings& settings, std::string_view text, const std::string& name);

// As above from a file; also throws Error (badInput) when it cannot be read.
void applySettingsFile(Settings& settings, const std::filesystem::path& file);

// The text that makes these settings out of the defaults: what differs from them, and what `always` names in any case.
std::string settingsText(const Settings& settings, std::span<const std::string> always = {});

struct Preset {
  std::string name;
  std::string description;                                  // one line, the first comment of the file
  std::vector<std::pair<std::string, std::string>> values;  // what differs from the defaults: name, value
};

// All presets, sorted by name.
std::vector<Preset> presets();

// Throws Error (usage) for an unknown name, listing the known ones.
void applyPreset(Settings& settings, std::string_view name);

struct PresetFile {
  std::string_view name;  // without ".toml"
  std::string_view text;
};

// All files config/*.toml, embedded by the build (config/embed_presets.cmake).
std::span<const PresetFile> presetFiles();

}  // namespace halfsilver
