#include "apps/outputs.h"

#include <algorithm>
#include <span>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "apps/exposure.h"

namespace halfsilver {
namespace {

std::string lowerExtension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
  });
  return extension;
}

// R G B A of the layers.
Image colorOf(const Image& layers) {
  Image picture{layers.width, layers.height, {"R", "G", "B", "A"}, {}};
  picture.data.reserve(layers.pixelCount() * 4);
  for (std::size_t pixel = 0; pixel < layers.pixelCount(); ++pixel)
    for (const std::string& name : picture.channels)
      picture.data.push_back(
          layers.data[pixel * layers.channels.size() + static_cast<std::size_t>(layers.channel(name))]);
  return picture;
}

}  // namespace

std::vector<std::string> OutputPaths::wanted() const {
  std::vector<std::string> all;
  for (const std::string* path : {&picture, &stats, &layers})
    if (!path->empty()) all.push_back(*path);
  return all;
}

void checkOutputs(const OutputPaths& paths) {
  const std::string extension = lowerExtension(paths.picture);
  if (extension != ".png" && extension != ".exr")
    throw Error(ErrorKind::usage, "-o " + paths.picture + ": the picture must be a .png or .exr file");
  if (!paths.layers.empty() && lowerExtension(paths.layers) != ".exr")
    throw Error(ErrorKind::usage, "--layers " + paths.layers + ": layers must be an .exr file");
  std::vector<std::filesystem::path> absolute;
  for (const std::string& path : paths.wanted()) {
    absolute.push_back(std::filesystem::weakly_canonical(std::filesystem::absolute(path)));
    if (std::find(absolute.begin(), absolute.end() - 1, absolute.back()) != absolute.end() - 1)
      throw Error(ErrorKind::usage, path + " is given for two outputs");
  }
}

Outputs::Outputs(const OutputPaths& paths) {
  checkOutputs(paths);
  linear_ = lowerExtension(paths.picture) == ".exr";
  picture_.emplace(paths.picture);
  if (!paths.stats.empty()) stats_.emplace(paths.stats);
  if (!paths.layers.empty()) layers_.emplace(paths.layers);
}

double Outputs::writePictures(const Renderer& renderer, const OffscreenTarget& target, double diagonal) {
  const Image layers = linear_ || layers_ ? renderer.readLayers() : Image{};
  const std::vector<std::uint8_t> shown = linear_ ? std::vector<std::uint8_t>() : target.read();
  picture_->write(linear_ ? encodeExr(colorOf(layers), diagonal)
                          : encodePng(target.target().width, target.target().height, shown));
  if (layers_) layers_->write(encodeExr(layers, diagonal));
  return shareOfWhite(shown);
}

void Outputs::writeStatistics(const RunStatistics& statistics) {
  if (stats_) stats_->write(dump(toJson(statistics)));
}

void Outputs::commit() {
  for (std::optional<AtomicFile>* file : {&layers_, &stats_, &picture_})
    if (*file) (*file)->commit();
}

}  // namespace halfsilver
