#include "apps/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace halfsilver {
namespace {

using Json = nlohmann::ordered_json;

StageSummary summarizeStage(const std::string& stage, const std::vector<double>& samples) {
  std::vector<double> valid;
  for (const double sample : samples)
    if (sample >= 0) valid.push_back(sample);
  // With two runs nobody can tell which is the outlier.
  if (valid.size() >= 3)
    std::erase_if(valid, [limit = 10 * median(valid)](double v) { return limit > 0 && v > limit; });
  StageSummary summary{stage, median(valid), 0, 0, valid.size(), samples.size() - valid.size()};
  if (!valid.empty()) {
    summary.min = *std::min_element(valid.begin(), valid.end());
    summary.max = *std::max_element(valid.begin(), valid.end());
  }
  return summary;
}

Json settingsJson(const Settings& settings) {
  Json json = Json::object();
  for (const SettingInfo& info : describe(settings)) {
    switch (info.kind) {
      case SettingInfo::Kind::boolean:
        json[info.name] = info.value == "true";
        break;
      case SettingInfo::Kind::integer:
        if (isWord(info))
          json[info.name] = info.value;
        else
          json[info.name] = std::atoi(info.value.c_str());
        break;
      case SettingInfo::Kind::real:
        json[info.name] = std::atof(info.value.c_str());
        break;
      case SettingInfo::Kind::choice:
        json[info.name] = info.value;
        break;
    }
  }
  return json;
}

template <class... Args>
std::string format(const char* pattern, Args... args) {
  char text[256];
  std::snprintf(text, sizeof(text), pattern, args...);
  return text;
}

std::string megabytes(std::uint64_t bytes) { return format("%.2f MB", static_cast<double>(bytes) / 1e6); }

double coverage(const FrameReport& report) {
  return report.pixels ? static_cast<double>(report.selected) / static_cast<double>(report.pixels) : 0;
}

// FrameReport::rays, behind the kinds: those that the screen has answered, of trace.method=screen-first and of
// effect.glossy, and those of the first that it left to the structure.
constexpr std::size_t kByScreen = 6, kByStructure = 7;

// null: no such limit was given.
Json budgetJson(const BudgetSummary& budget) {
  const auto limit = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  Json json = {{"milliseconds", limit(budget.limits.milliseconds)},
               {"megabytes", limit(budget.limits.bytes / 1e6)},
               {"frames", budget.frames},
               {"frames_held", budget.held},
               {"settled", budget.settled},
               {"min_contribution", budget.minContribution},
               {"dropped", budget.dropped}};
  if (budget.raysPerPixel) json["rays_per_pixel"] = budget.raysPerPixel->first;
  return json;
}

Json choiceJson(const MethodChoice& choice) {
  Json json = {{"method", choice.method}, {"reason", choice.reason}, {"measured_ms", Json::object()}};
  for (const MethodTime& time : choice.measured) json["measured_ms"][time.method] = time.milliseconds;
  return json;
}

std::string budgetLine(const BudgetSummary& budget, const FrameReport& report) {
  std::string limits;
  if (std::isfinite(budget.limits.milliseconds)) limits += format("%g ms", budget.limits.milliseconds);
  if (std::isfinite(budget.limits.bytes))
    limits += format(limits.empty() ? "%g MB" : " and %g MB", budget.limits.bytes / 1e6);
  if (budget.raysPerPixel)
    return format("budget      %s: met in %zu of %zu frames; %d of %d rays per pixel\n", limits.c_str(), budget.held,
                  budget.frames, budget.raysPerPixel->first, budget.raysPerPixel->second);
  return format(
      "budget      %s: met in %zu of %zu frames; dropped %llu of %llu pixels, contributions up to about %.4f\n",
      limits.c_str(), budget.held, budget.frames, static_cast<unsigned long long>(budget.dropped),
      static_cast<unsigned long long>(report.reflecting), static_cast<double>(budget.minContribution));
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::vector<std::string> stageNames() {
  return {"shadow", "gbuffer", "select", "voxelize", "build", "trace", "shade", "composite", "frame"};
}

void StageTimes::add(std::span<const StageTime> frame) {
  for (const StageTime& time : frame) {
    auto known = std::find_if(samples_.begin(), samples_.end(), [&](const auto& s) { return s.first == time.stage; });
    if (known == samples_.end()) known = samples_.insert(samples_.end(), {time.stage, {}});
    known->second.push_back(time.milliseconds);
  }
}

bool StageTimes::has(const std::string& stage) const {
  return std::any_of(samples_.begin(), samples_.end(), [&](const auto& s) { return s.first == stage; });
}

std::vector<StageSummary> StageTimes::summarize() const {
  std::vector<std::string> order = stageNames();
  for (const auto& [stage, times] : samples_)
    if (std::find(order.begin(), order.end(), stage) == order.end())
      order.insert(stage == "pose" ? order.begin() : order.end(), stage);  // the one that comes before all others
  std::vector<StageSummary> result;
  for (const std::string& stage : order) {
    const auto found = std::find_if(samples_.begin(), samples_.end(), [&](const auto& s) { return s.first == stage; });
    result.push_back(summarizeStage(stage, found == samples_.end() ? std::vector<double>{} : found->second));
  }
  return result;
}

Json toJson(const RunStatistics& s) {
  const MemoryReport& memory = s.report.memory;
  Json json;
  json["device"] = {{"vendor", s.device.vendor},
                    {"renderer", s.device.renderer},
                    {"version", s.device.version},
                    {"context", s.context},
                    {"software", s.device.software},
                    {"programs_compiled", s.device.programsCompiled},
                    {"programs_cached", s.device.programsCached}};
  json["scene"] = {{"file", s.sceneFile},      {"triangles", s.triangles}, {"vertices", s.vertices},
                   {"materials", s.materials}, {"textures", s.textures},   {"lights", s.lights},
                   {"diagonal", s.diagonal}};
  json["settings"] = settingsJson(s.settings);
  json["pixels"] = {{"width", s.width},
                    {"height", s.height},
                    {"total", s.report.pixels},
                    {"reflecting", s.report.reflecting},
                    {"selected", s.report.selected},
                    {"coverage", coverage(s.report)},
                    {"samples", s.samples}};
  json["pixels"]["passes"] = s.report.passes;
  json["pixels"]["resampled"] = s.report.resampled;
  json["pixels"]["interpolated"] = s.report.interpolated;
  json["rays"]["min_distance"] = s.report.minDistance;
  for (std::size_t kind = 0; kind < kRayKinds; ++kind) json["rays"][kRayKindNames[kind]] = s.report.rays[kind];
  json["rays"]["by_screen"] = s.report.rays[kByScreen];
  json["rays"]["by_structure"] = s.report.rays[kByStructure];
  json["memory"] = {{"voxels", memory.voxels},
                    {"heads", memory.heads},
                    {"pool_reserved", memory.poolReserved},
                    {"pool_used", memory.poolUsed},
                    {"fragments", memory.fragments},
                    {"fragments_stored", memory.fragmentsStored},
                    {"fragments_per_axis", memory.fragmentsPerAxis},
                    {"bytes_per_fragment", memory.bytesPerFragment},
                    {"grid", memory.grid},
                    {"structure_total", memory.structureTotal},
                    {"gbuffer", memory.gbuffer},
                    {"geometry", memory.geometry},
                    {"textures", memory.textures},
                    {"shadow_maps", memory.shadowMaps},
                    {"queues", memory.queues},
                    {"pictures", memory.pictures},
                    {"transient", memory.transient},
                    {"largest_buffer", memory.largestBuffer},
                    {"largest_buffer_name", memory.largestBufferName},
                    {"peak", memory.peak}};
  json["time_ms"] = Json::object();
  for (const StageSummary& stage : s.stages)
    json["time_ms"][stage.stage] = {{"median", stage.median},
                                    {"min", stage.min},
                                    {"max", stage.max},
                                    {"runs", stage.runs},
                                    {"rejected", stage.rejected}};
  json["wall_ms"] = Json::object();
  for (const auto& [lap, elapsed] : s.wallMilliseconds) json["wall_ms"][lap] = elapsed;
  if (s.budget) json["budget"] = budgetJson(*s.budget);
  if (s.choice) json["auto"] = choiceJson(*s.choice);
  json["warm_up_frames"] = s.warmUpFrames;
  json["overflow"] = s.report.overflow;
  json["lost_fragments"] = s.report.lostFragments;
  json["warnings"] = s.warnings;
  return json;
}

Json toJson(const Comparison& comparison) {
  Json json;
  json["rmse"] = comparison.rmse;
  // JSON has no infinity: null means that the images are equal.
  json["psnr_db"] = nullptr;
  if (std::isfinite(comparison.psnrDb)) json["psnr_db"] = comparison.psnrDb;
  json["max_error"] = comparison.maxError;
  json["yee_failures"] = nullptr;
  json["yee_fail_fraction"] = nullptr;
  if (comparison.perceptual) {
    json["yee_failures"] = comparison.perceptual->failures;
    json["yee_fail_fraction"] = comparison.perceptual->fraction;
  }
  if (comparison.layers) {
    json["compared_pixels"] = comparison.layers->pixels;
    json["hit_error"] = comparison.layers->hitError;
    json["false_miss"] = comparison.layers->falseMiss;
    json["false_hit"] = comparison.layers->falseHit;
    json["wrong_id"] = comparison.layers->wrongId;
    json["selected_mismatch"] = comparison.layers->selectedMismatch;
    json["overflow"] = comparison.layers->overflow;
    for (const KindComparison& kind : comparison.layers->kinds)
      json["kinds"][kind.kind] = {{"rays", kind.rays},
                                  {"unmatched", kind.unmatched},
                                  {"false_occlusion", kind.falseOcclusion},
                                  {"false_visibility", kind.falseVisibility},
                                  {"wrong_distance", kind.wrongDistance}};
  }
  return json;
}

std::string toTable(const RunStatistics& s) {
  const MemoryReport& memory = s.report.memory;
  std::string table;
  table += s.sceneFile + ", " + std::to_string(s.triangles) + " triangles, " + std::to_string(s.width) + "x" +
           std::to_string(s.height) + ", " + s.device.renderer + " (" + s.context + ")\n";
  if (s.choice) table += "trace.method=auto: " + s.choice->method + ", " + s.choice->reason + "\n";
  if (s.samples > 1) table += std::to_string(s.samples) + " samples per pixel; times are of the whole picture\n";
  table += "GPU stage       median        min        max ms   runs";
  table += s.firstFrame ? "   (first frame; use --repeat N for warm frames)\n" : "\n";
  for (const StageSummary& stage : s.stages) {
    if (stage.runs + stage.rejected == 0) continue;
    table += format("%-11s %10.3f %10.3f %10.3f    %5zu", stage.stage.c_str(), stage.median, stage.min, stage.max,
                    stage.runs);
    table += stage.rejected ? format("  (%zu rejected)\n", stage.rejected) : std::string("\n");
  }
  table += format("coverage    %.2f %% of the pixels traced (%llu of %llu)\n", 100 * coverage(s.report),
                  static_cast<unsigned long long>(s.report.selected), static_cast<unsigned long long>(s.report.pixels));
  const std::uint64_t byScreen = s.report.rays[kByScreen], byStructure = s.report.rays[kByStructure];
  if (s.settings.trace.method == "screen-first" && byScreen + byStructure > 0)
    table += format("answered    %.2f %% of the rays by the screen, the others by the structure\n",
                    100 * static_cast<double>(byScreen) / static_cast<double>(byScreen + byStructure));
  if (s.budget) table += budgetLine(*s.budget, s.report);
  table += "memory      structure " + megabytes(memory.structureTotal) + " (voxels " + megabytes(memory.voxels) +
           ", heads " + megabytes(memory.heads) + ", pool " + megabytes(memory.poolUsed) + " used of " +
           megabytes(memory.poolReserved) + "), peak " + megabytes(memory.peak) + "\n";
  table += "of the peak G-buffer " + megabytes(memory.gbuffer) + ", geometry " + megabytes(memory.geometry) +
           ", textures " + megabytes(memory.textures) + ", shadow maps " + megabytes(memory.shadowMaps) +
           ", queues of rays " + megabytes(memory.queues) +
           (memory.pictures ? ", samples and history " + megabytes(memory.pictures) : "") + "; the largest buffer, " +
           memory.largestBufferName + ", " + megabytes(memory.largestBuffer) + "\n";
  if (memory.grid[0] > 0) table += format("voxels      %d x %d x %d\n", memory.grid[0], memory.grid[1], memory.grid[2]);
  if (memory.fragments)
    table += format("fragments   %llu generated, %llu stored (x %llu, y %llu, z %llu), %.1f bytes each\n",
                    static_cast<unsigned long long>(memory.fragments),
                    static_cast<unsigned long long>(memory.fragmentsStored),
                    static_cast<unsigned long long>(memory.fragmentsPerAxis[0]),
                    static_cast<unsigned long long>(memory.fragmentsPerAxis[1]),
                    static_cast<unsigned long long>(memory.fragmentsPerAxis[2]), memory.bytesPerFragment);
  table += "wall clock ";
  for (const auto& [lap, elapsed] : s.wallMilliseconds) table += format(" %s %.3f s,", lap.c_str(), elapsed / 1000);
  table.back() = '\n';
  return table;
}

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace halfsilver
