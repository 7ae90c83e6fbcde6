#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace halfsilver {

// Float image, rows from the top, channels interleaved: data[(y * width + x) * channels + c].
// Channel names are those of an EXR file ("R", "depth.Z"); their order is the order of storage.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> data;

  int channelCount() const { return static_cast<int>(channels.size()); }
  std::size_t pixelCount() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  // Index of a channel by its name, or -1.
  int channel(const std::string& name) const {
    for (int c = 0; c < channelCount(); ++c)
      if (channels[static_cast<std::size_t>(c)] == name) return c;
    return -1;
  }
};

}  // namespace halfsilver
