#pragma once

#include <cstdlib>
#include <filesystem>

namespace halfsilver {

// Where what can be made again is kept from run to run: the folder that the environment names in HALFSILVER_CACHE
// (empty: nowhere), otherwise halfsilver/ in the user's cache folder ($XDG_CACHE_HOME or ~/.cache; names that are not
// absolute are to be ignored, XDG Base Directory Specification). Empty: nothing is kept. It need not exist.
inline std::filesystem::path cacheFolder() {
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* value = std::getenv(name);
    return value ? value : "";
  };
  if (std::getenv("HALFSILVER_CACHE")) return variable("HALFSILVER_CACHE");
  const std::filesystem::path cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (cache.is_absolute()) return cache / "halfsilver";
  return home.is_absolute() ? home / ".cache" / "halfsilver" : std::filesystem::path();
}

}  // namespace halfsilver
