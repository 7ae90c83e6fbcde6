#pragma once

#include <filesystem>
#include <string>

#include <halfsilver/calibration.h>

// Choices of trace.method=auto, kept from run to run.
namespace halfsilver {

// What a choice depends on: the device and the methods that there are, the scene, the view and the settings.
struct ChoiceKey {
  std::string device, version, methods, scene;
  std::size_t triangles = 0;
  int width = 0, height = 0;
  bool moves = false;
  std::string rest;  // all else, of any length

  std::string text() const;
};

// Of cacheFolder(); empty if there is none.
std::filesystem::path choicesFile();

// The choice that a file holds, or a new one, which is added to the file if something was measured. What cannot be read
// or written is no error: then there is nothing to remember.
MethodChoice rememberedChoice(const std::filesystem::path& file, const ChoiceKey& key,
                              const std::function<MethodChoice()>& choose);

}  // namespace halfsilver
