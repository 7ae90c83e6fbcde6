#include <algorithm>
#include <iostream>

#include <halfsilver/io.h>
#include "apps/commands.h"

namespace halfsilver {
namespace {

void listPresets() {
  const std::vector<Preset> all = presets();
  std::size_t width = 0;
  for (const Preset& preset : all) width = std::max(width, preset.name.size());
  for (const Preset& preset : all) {
    std::cout << preset.name << std::string(width + 2 - preset.name.size(), ' ') << preset.description << '\n';
    for (const auto& [name, value] : preset.values)
      std::cout << std::string(width + 2, ' ') << name << '=' << value << '\n';
  }
}

}  // namespace

void addPresetsCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("presets", "List the presets and what each sets");
  command->callback(listPresets);
}

}  // namespace halfsilver
