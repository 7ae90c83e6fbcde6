#include "program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace halfsilver {
namespace {

constexpr const char* kOut = ".out";
constexpr const char* kErr = ".err";

}  // namespace

ProgramResult runProgramIn(const TemporaryFolder& folder, const std::string& arguments,
                           const std::string& environment) {
  const std::string command = "cd '" + folder.path().string() + "' && " + environment + " '" HALFSILVER_PROGRAM "' " +
                              arguments + " >" + kOut + " 2>" + kErr + " </dev/null";
  const int status = std::system(command.c_str());
  ProgramResult result;
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out = readText(folder / kOut);
  result.err = readText(folder / kErr);
  return result;
}

std::vector<std::string> filesIn(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    names.push_back(std::filesystem::relative(entry.path(), folder.path()).string());
  std::erase_if(names, [](const std::string& name) { return name == kOut || name == kErr; });
  std::sort(names.begin(), names.end());
  return names;
}

std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

nlohmann::json readJson(const std::filesystem::path& file) {
  const auto json = nlohmann::json::parse(readText(file), nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << file << " is not JSON";
  return json;
}

void writeWall(const TemporaryFolder& folder, double east) {
  const float positions[] = {-100, -100, 0, 100, -100, 0, 0, 100, 0};
  std::ofstream(folder / "wall.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(positions), sizeof(positions));
  nlohmann::json gltf = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"mesh": 0, "name": "wall"}, {"camera": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"name": "paint", "doubleSided": true, "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.2, 0.1, 1]}}],
    "cameras": [{"name": "near", "type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
    "buffers": [{"uri": "wall.bin", "byteLength": 36}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [-100, -100, 0], "max": [100, 100, 0]}]})");
  gltf["nodes"][0]["translation"] = {east, 0, 0};
  gltf["nodes"][1]["translation"] = {east, 0, 5};
  std::ofstream(folder / "wall.gltf") << gltf;
}

float valueAt(const Image& image, const std::string& channel, int x, int y) {
  const int c = image.channel(channel);
  if (c < 0) {
    ADD_FAILURE() << "no channel " << channel;
    return 0;
  }
  const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
  return image.data[pixel * image.channels.size() + static_cast<std::size_t>(c)];
}

}  // namespace halfsilver
