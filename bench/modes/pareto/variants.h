#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/settings.h>

namespace halfsilver::bench {

// A preset with some settings changed; one mark of the chart.
struct Variant {
  std::string family, knob;  // "halfsilver", "2 voxels per triangle"; empty knob: the preset as it is
  std::string preset;
  std::vector<std::pair<std::string, std::string>> values;  // as after --set
  bool quick = false;                                       // also measured by --quick
  std::string beside;                                       // why it does not compete; empty if it does

  std::string name() const { return knob.empty() ? family : family + ", " + knob; }
};

std::vector<Variant> variants(bool quick, std::size_t triangles);

// Everything is rebuilt in each frame, as for a moving scene, unless the variant says otherwise.
Settings settingsOf(const Variant& variant, bool quick, std::size_t triangles);

}  // namespace halfsilver::bench
