#include "apps/tune_candidates.h"

#include <algorithm>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>

namespace halfsilver {
namespace {

// Methods with settings to tune. The default one comes first: it is what the others have to beat.
std::vector<MethodInfo> tunedMethods() {
  std::vector<MethodInfo> tuned;
  for (const MethodInfo& method : methods())
    if (!method.knobs.empty()) tuned.push_back(method);
  const std::string standard = TraceSettings().method;
  std::stable_partition(tuned.begin(), tuned.end(), [&](const MethodInfo& m) { return m.name == standard; });
  return tuned;
}

// One value per knob.
using Values = std::vector<std::string>;

std::vector<Values> combinations(std::span<const Knob> knobs) {
  std::vector<Values> all = {{}};
  for (const Knob& knob : knobs) {
    std::vector<Values> longer;
    for (const Values& start : all)
      for (const std::string& value : knob.values) {
        longer.push_back(start);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

// What is drawn is the request's, the structure that of the method's own preset.
Settings startOf(const MethodInfo& method, const ViewRequest& request) {
  Settings settings = baseSettings(request);
  const std::vector<SettingInfo> defaults = describe(Settings());
  for (const MethodInfo& each : methods())
    for (const std::string& name : each.settings) {
      const auto value =
          std::find_if(defaults.begin(), defaults.end(), [&](const SettingInfo& s) { return s.name == name; });
      if (!name.starts_with("trace.")) set(settings, name, value->value);
    }
  settings.trace.method = TraceSettings().method;
  applyPreset(settings, method.preset);
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
  for (const MethodInfo& method : tunedMethods()) {
    const Settings start = startOf(method, request);
    std::vector<std::string> names;
    for (const Knob& knob : method.knobs) names.push_back(knob.setting);
    const std::span<const Knob> knobs(method.knobs);
    // The last knob is climbed, the others make a ladder each.
    for (const Values& fixed : combinations(knobs.first(knobs.size() - 1))) {
      Ladder ladder;
      for (const std::string& last : knobs.back().values) {
        Candidate candidate{method.preset, names, start};
        for (std::size_t i = 0; i < fixed.size(); ++i) set(candidate.settings, names[i], fixed[i]);
        set(candidate.settings, names.back(), last);
        applyOverrides(candidate.settings, request);
        // --set chose another method, which this method's settings do not affect.
        if (candidate.settings.trace.method != start.trace.method) continue;
        if (std::find(known.begin(), known.end(), candidate.settings) != known.end()) continue;
        known.push_back(candidate.settings);
        ladder.push_back(std::move(candidate));
      }
      if (!ladder.empty()) ladders.push_back(std::move(ladder));
    }
  }
  if (ladders.empty())
    throw Error(ErrorKind::usage, "--set trace.method: these methods have settings to tune: " + tunedSettings());
  return ladders;
}

std::string tunedSettings() {
  std::string text;
  for (const MethodInfo& method : tunedMethods()) {
    std::string names;
    for (const Knob& knob : method.knobs) names += (names.empty() ? "" : ", ") + knob.setting;
    text += (text.empty() ? "" : ", ") + method.name + " (" + names + ")";
  }
  return text;
}

}  // namespace halfsilver
