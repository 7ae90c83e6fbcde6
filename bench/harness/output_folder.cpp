#include "bench/harness/output_folder.h"

#include <fstream>
#include <iterator>
#include <system_error>

#include <halfsilver/error.h>
#include "io/atomic_file.h"

namespace halfsilver::bench {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
  std::error_code error;
  for (fs::path folder = fs::absolute(path).lexically_normal();
       !fs::exists(folder, error) && folder.has_relative_path(); folder = folder.parent_path())
    created_.push_back(folder);
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_)) throw Error(ErrorKind::failed, path_.string() + ": cannot create the folder");
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  // Removes empty folders only.
  for (const fs::path& folder : created_) fs::remove(folder, ignored);
}

std::string pictureName(const std::string& scene, const std::string& way) {
  std::string name = scene;
  name += ' ';
  name += way;
  return name;
}

std::string pictureFile(const std::string& name) {
  std::string file = name;
  for (char& c : file)
    if (c == ':' || c == ' ') c = '-';
  file += ".png";
  return file;
}

void savePicture(const OutputFolder& folder, const std::string& name, const Workbench& bench) {
  AtomicFile file(folder / pictureFile(name));
  file.write(bench.thumbnail());
  file.commit();
}

std::string readPicture(const OutputFolder& folder, const std::string& name) {
  std::ifstream stream(folder / pictureFile(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace halfsilver::bench
