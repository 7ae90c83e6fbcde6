#include "apps/tune_candidates.h"

#include <algorithm>

#include <halfsilver/error.h>
#include <halfsilver/io.h>

namespace halfsilver {
namespace {

struct Axis {
  std::string name;
  std::vector<std::string> values;
};

// Each combination of the other axes' values makes a ladder over the last axis.
struct Family {
  std::string preset;
  std::vector<Axis> axes;
};

std::vector<Family> families() {
  return {{"halfsilver", {{"voxels.per_triangle", {"2", "4", "8", "16", "32", "64"}}}},
          {"kastrati2017",
           {{"search.steps", {"1", "3", "0"}},
            {"voxels.resolution", {"64", "128", "256"}},
            {"abuffer.resolution", {"256", "512", "1024", "2048"}}}}};
}

// One value for each axis.
using Values = std::vector<std::string>;

std::vector<Values> combinations(std::span<const Axis> axes) {
  std::vector<Values> all = {{}};
  for (const Axis& axis : axes) {
    std::vector<Values> longer;
    for (const Values& start : all)
      for (const std::string& value : axis.values) {
        longer.push_back(start);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

Settings familySettings(const ViewRequest& request, const Family& family) {
  Settings settings = baseSettings(request);
  const Settings defaults;
  settings.voxels = defaults.voxels;
  settings.abuffer = defaults.abuffer;
  settings.search = defaults.search;
  settings.trace.method = defaults.trace.method;
  applyPreset(settings, family.preset);
  return settings;
}

}  // namespace

std::string Candidate::text() const {
  std::string text = preset;
  for (const SettingInfo& info : describe(settings))
    if (std::find(tuned.begin(), tuned.end(), info.name) != tuned.end()) text += ' ' + info.name + '=' + info.value;
  return text;
}

std::vector<Ladder> tuneLadders(const ViewRequest& request) {
  std::vector<Ladder> ladders;
  std::vector<Settings> known;
  for (const Family& family : families()) {
    const Settings start = familySettings(request, family);
    std::vector<std::string> names;
    for (const Axis& axis : family.axes) names.push_back(axis.name);
    const std::span<const Axis> axes(family.axes);
    for (const Values& fixed : combinations(axes.first(axes.size() - 1))) {
      Ladder ladder;
      for (const std::string& last : axes.back().values) {
        Candidate candidate{family.preset, names, start};
        for (std::size_t i = 0; i < fixed.size(); ++i) set(candidate.settings, names[i], fixed[i]);
        set(candidate.settings, names.back(), last);
        applyOverrides(candidate.settings, request);
        // --set chose another method, which this family's settings do not affect.
        if (candidate.settings.trace.method != start.trace.method) continue;
        if (std::find(known.begin(), known.end(), candidate.settings) != known.end()) continue;
        known.push_back(candidate.settings);
        ladder.push_back(std::move(candidate));
      }
      if (!ladder.empty()) ladders.push_back(std::move(ladder));
    }
  }
  if (ladders.empty())
    throw Error(ErrorKind::usage, "--set trace.method: only the methods identity and attributes have settings to tune");
  return ladders;
}

}  // namespace halfsilver
