#include "bench/modes/pareto/variants.h"

#include <algorithm>

#include "bench/harness/bench_scene.h"
#include "bench/harness/method_presets.h"

namespace halfsilver::bench {

std::vector<Variant> variants(bool quick, std::size_t triangles) {
  const std::string kastrati = "kastrati2017", hu = "hu2014", share = "share of the pixels";
  const int voxels = presetSettings(kastrati, quick, triangles).voxels.resolution;
  const std::string half = std::to_string(voxels / 2);
  std::vector<Variant> all = {
      {kDefaultPreset, "", kDefaultPreset, {}, true, ""},
      {kDefaultPreset, "2 voxels per triangle", kDefaultPreset, {{"voxels.per_triangle", "2"}}, false, ""},
      {kDefaultPreset, "64 voxels per triangle", kDefaultPreset, {{"voxels.per_triangle", "64"}}, false, ""},
      {kDefaultPreset, "kept", kDefaultPreset, {{"abuffer.keep", "true"}}, true, "builds nothing"},
      {kDefaultPreset, "2 bounces", kDefaultPreset, {{"trace.bounces", "2"}}, true, "draws more"},
      {kDefaultPreset, "4 bounces", kDefaultPreset, {{"trace.bounces", "4"}}, false, "draws more"},
      {kastrati, "", kastrati, {}, true, ""},
      {kastrati, "half the voxels", kastrati, {{"voxels.resolution", half}}, false, ""},
      {kastrati, "512 texels", kastrati, {{"abuffer.resolution", "512"}}, false, ""},
      {kastrati, "256 texels", kastrati, {{"abuffer.resolution", "256"}}, false, ""},
      {kastrati, "1 step", kastrati, {{"search.steps", "1"}}, false, ""},
      {kastrati, "256 texels, 1 step", kastrati, {{"abuffer.resolution", "256"}, {"search.steps", "1"}}, false, ""},
      {kastrati, "all steps", kastrati, {{"search.steps", "0"}}, false, ""},
      {kastrati, "512 texels, all steps", kastrati, {{"abuffer.resolution", "512"}, {"search.steps", "0"}}, false, ""},
      {kastrati,
       "fine voxel pass, all steps",
       kastrati,
       {{"voxels.raster", "abuffer"}, {"search.steps", "0"}},
       false,
       ""},
      {kastrati, "1 entry per page", kastrati, {{"abuffer.page_size", "1"}}, false, ""},
      {kastrati, "16 entries per page", kastrati, {{"abuffer.page_size", "16"}}, false, ""},
      {hu, "", hu, {}, true, ""},
      {hu, "reflective pixels", hu, {{"select.mode", "reflective"}}, false, ""},
      {hu, "half the voxels", hu, {{"voxels.resolution", half}}, false, ""},
      {hu, "1024 texels", hu, {{"abuffer.resolution", "1024"}}, false, ""},
      {hu, "512 texels", hu, {{"abuffer.resolution", "512"}}, false, ""},
      {hu, "256 texels", hu, {{"abuffer.resolution", "256"}}, false, ""},
      {hu, "1 step", hu, {{"search.steps", "1"}}, false, ""},
      {hu, "all steps", hu, {{"search.steps", "0"}}, false, ""},
      {hu, "planes", hu, {{"search.test", "plane"}}, false, ""},
      {"screen space", "", "screen-space", {}, true, "knows what the camera sees"},
      {"exact rays, CPU", "", kDefaultPreset, {{"trace.method", "exact"}}, true, "no GPU method"},
      {share, "1/4 of the pixels", kDefaultPreset, {{"select.fraction", "0.25"}}, true, ""},
      {share, "1/16 of the pixels", kDefaultPreset, {{"select.fraction", "0.0625"}}, false, ""},
      {share,
       "1/4 of the pixels, sky between",
       kDefaultPreset,
       {{"select.fraction", "0.25"}, {"select.fill", "sky"}},
       false,
       ""},
  };
  // Methods without a variant of their own, as they are.
  for (const std::string& preset : methodPresets(quick, triangles, false))
    if (std::none_of(all.begin(), all.end(), [&](const Variant& v) { return v.preset == preset && v.values.empty(); }))
      all.push_back({preset, "", preset, {}, true, ""});
  for (const char* threshold : {"0.01", "0.02", "0.05", "0.1", "0.2"})
    all.push_back({"threshold of contribution",
                   threshold,
                   kDefaultPreset,
                   {{"select.min_contribution", threshold}},
                   std::string(threshold) == "0.1",
                   ""});
  if (quick) std::erase_if(all, [](const Variant& variant) { return !variant.quick; });
  return all;
}

Settings settingsOf(const Variant& variant, bool quick, std::size_t triangles) {
  Settings settings = presetSettings(variant.preset, quick, triangles);
  settings.identity.keep = false;
  for (const auto& [name, value] : variant.values) set(settings, name, value);
  return settings;
}

}  // namespace halfsilver::bench
