#include "apps/demo/options.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/drawing.h"

namespace halfsilver::demo {

std::filesystem::path configFolder() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder && *folder)
    return std::filesystem::path(folder) / "halfsilver";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".config" / "halfsilver";
  return {};
}

void load(const std::filesystem::path& folder, Options& options) {
  std::error_code ignored;
  if (const auto file = folder / "demo-settings.toml"; std::filesystem::is_regular_file(file, ignored)) {
    try {
      applySettingsFile(options.settings, file);
    } catch (const Error&) {
      // From another version; the defaults do.
    }
  }
  std::ifstream stream(folder / "demo.json");
  const nlohmann::json kept = nlohmann::json::parse(stream, nullptr, false);
  if (!kept.is_object()) return;
  try {
    options.overlay = kept.value("overlay", options.overlay);
    options.verticalSync = kept.value("vertical_sync", options.verticalSync);
    options.bestSeconds = kept.value("best_seconds", options.bestSeconds);
    options.frameTime = kept.value("frame_time_ms", options.frameTime);
    options.samples = std::clamp(kept.value("samples", options.samples), 1, kMaxSamples);
  } catch (const nlohmann::json::exception&) {
    // A value of another type; what came before it holds.
  }
}

bool save(const std::filesystem::path& folder, const Options& options) {
  if (folder.empty()) return false;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return false;
  std::ofstream(folder / "demo-settings.toml") << settingsText(options.settings);
  const nlohmann::ordered_json kept{{"overlay", options.overlay},
                                    {"vertical_sync", options.verticalSync},
                                    {"best_seconds", options.bestSeconds},
                                    {"frame_time_ms", options.frameTime},
                                    {"samples", options.samples}};
  std::ofstream file(folder / "demo.json");
  return static_cast<bool>(file << kept.dump(2) << '\n' << std::flush);
}

}  // namespace halfsilver::demo
