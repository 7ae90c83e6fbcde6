#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/harness/workbench.h"

namespace halfsilver::bench {

// A folder that is created if it does not exist, and removed again if nothing was put into it.
class OutputFolder {
 public:
  // Throws Error (failed) if it cannot be created or is a file.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> created_;  // innermost first
};

// Of a scene drawn in one of several ways.
std::string pictureName(const std::string& scene, const std::string& way);
// File name of a picture: "builtin:sphere" is in builtin-sphere.png.
std::string pictureFile(const std::string& name);
// Saves the last frame that was drawn.
void savePicture(const OutputFolder& folder, const std::string& name, const Workbench& bench);
// Bytes of the PNG; empty if there is none.
std::string readPicture(const OutputFolder& folder, const std::string& name);

}  // namespace halfsilver::bench
