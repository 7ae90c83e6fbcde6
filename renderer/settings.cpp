#include <halfsilver/settings.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <type_traits>

#include <halfsilver/error.h>
#include <halfsilver/methods.h>

namespace halfsilver {
namespace {

// Names of choices, in the order of the enumerators. Those of a method's own are beside its settings.
constexpr auto choiceNames(Posing) { return std::array{"gpu", "cpu"}; }
constexpr auto choiceNames(PrimaryHits) { return std::array{"raster", "tested"}; }
constexpr auto choiceNames(Multisampling) { return std::array{"none", "lazy", "full"}; }
constexpr auto choiceNames(SelectMode) { return std::array{"none", "reflective", "all"}; }
constexpr auto choiceNames(SelectPattern) { return std::array{"scattered", "region"}; }
constexpr auto choiceNames(Fill) { return std::array{"sky", "neighbours"}; }
constexpr auto choiceNames(VoxelRaster) { return std::array{"voxel", "abuffer", "conservative", "shifted"}; }
constexpr auto choiceNames(AxisRule) { return std::array{"normal", "area", "own"}; }
constexpr auto choiceNames(TraceStage) { return std::array{"compute", "fragment"}; }
constexpr auto choiceNames(Effect) { return std::array{"reflection", "whitted", "occlusion", "path", "layers"}; }
constexpr auto choiceNames(Transfer) { return std::array{"xray", "surface", "blend"}; }
constexpr auto choiceNames(ShadowMethod) { return std::array{"maps", "rays", "refined"}; }
constexpr auto choiceNames(ShadowProjection) { return std::array{"uniform", "perspective"}; }
constexpr auto choiceNames(ToneMap) { return std::array{"filmic", "none"}; }
constexpr auto choiceNames(Antialiasing) { return std::array{"none", "fxaa", "temporal"}; }

template <class T>
constexpr bool isChoice = std::is_enum_v<T> || std::is_same_v<T, std::string>;  // the one text names a method

// A whole number, of which 0 is written as a word.
template <class T>
struct OrAuto {
  T& value;
};
template <class T>
OrAuto(T&) -> OrAuto<T>;         // Clang 14 needs it said
constexpr int kMaxVoxels = 512;  // along an axis
constexpr const char* kAuto = "auto";
template <class T>
constexpr bool isOrAuto = false;
template <class T>
constexpr bool isOrAuto<OrAuto<T>> = true;

template <class T>
std::vector<std::string> choicesOf() {
  if constexpr (std::is_enum_v<T>) {
    const auto names = choiceNames(T());
    return {names.begin(), names.end()};
  } else {
    std::vector<std::string> names;
    for (const MethodInfo& method : methods()) names.push_back(method.name);
    return names;
  }
}

std::string_view sectionOf(std::string_view name) { return name.substr(0, name.find('.')); }

// The settings of each method, of those sections for which `wanted` holds.
template <class S, class Visitor, class Wanted>
void visitMethods(S& s, Visitor&& visit, Wanted&& wanted) {
  const auto visitWanted = [&](const char* name, auto& value, double low, double high, const char* help) {
    if (wanted(sectionOf(name))) visit(name, value, low, high, help);
  };
  IdentitySettings::visit(s.identity, visitWanted);
  AttributeSettings::visit(s.attributes, visitWanted);
  DepthCubeSettings::visit(s.depthCube, visitWanted);
}

// The table: visit(name, value, low, high, help) for each setting; low and high count for numbers only.
template <class S, class Visitor>
void visitAll(S& s, Visitor&& visit) {
  visit("scene.cull_back_faces", s.scene.cullBackFaces, 0, 1, "single-sided materials are invisible from behind");
  visit("scene.posing", s.scene.posing, 0, 0, "what places animated vertices; cpu: in double precision");
  visit("primary.hits", s.primary.hits, 0, 0, "what decides which triangle a pixel's ray meets");
  visit("primary.multisampling", s.primary.multisampling, 0, 0, "whose triangles it is tested against");
  visit("primary.neighborhood", s.primary.neighborhood, 3, 7, "pixels along the square that those are of, odd");
  visit("primary.every", s.primary.every, 1, 8, "one pixel in so many has a ray, the others are interpolated");
  visit("select.mode", s.select.mode, 0, 0, "which pixels are traced");
  visit("select.fraction", s.select.fraction, 0, 1, "share of the selected pixels that is kept");
  visit("select.pattern", s.select.pattern, 0, 0, "where the pixels that are kept lie on the screen");
  visit("select.max_roughness", s.select.maxRoughness, 0, 1, "reflectivity fades to 0 at this roughness");
  visit("select.min_reflectivity", s.select.minReflectivity, 0, 1, "pixels at or below are not selected");
  visit("select.min_contribution", s.select.minContribution, 0, 1,
        "pixels that add at most about this to the display go");
  visit("select.fill", s.select.fill, 0, 0, "what stands in for reflections that are not traced");
  OrAuto voxels{s.voxels.resolution};
  visit("voxels.resolution", voxels, 1, kMaxVoxels,
        "voxels along each axis (identity: at most); auto: sqrt(3 texels), identity 512");
  visitMethods(s, visit, [](std::string_view section) { return section == "voxels"; });
  visit("voxels.raster", s.voxels.raster, 0, 0, "how triangles reach voxels");
  visit("voxels.axis", s.voxels.axis, 0, 0, "how a dominant axis is chosen");
  visit("abuffer.resolution", s.abuffer.resolution, 1, 4096, "texels along each axis");
  visitMethods(s, visit, [](std::string_view section) { return section != "voxels"; });
  visit("trace.method", s.trace.method, 0, 0, "the tracer");
  visit("trace.effect", s.trace.effect, 0, 0, "which rays there are and what their ends mean");
  visit("trace.bounces", s.trace.bounces, 1, 16, "reflections, or stretches of a path, one after the other");
  visit("trace.stage", s.trace.stage, 0, 0, "the shader stage that traces");
  visit("trace.tally", s.trace.tally, 0, 1, "counts each pixel's rays and hits by kind, for the layers and compare");
  visit("trace.count_work", s.trace.countWork, 0, 1, "counts each ray's steps and tests, for benchmarks");
  visit("effect.samples", s.effect.samples, 1, 64, "rays per pixel and pass, of effects that send several");
  visit("effect.passes", s.effect.passes, 1, 65536, "passes per frame, of the same");
  visit("effect.progressive", s.effect.progressive, 0, 1, "frames go on with the passes before while nothing changes");
  visit("effect.glossy", s.effect.glossy, 0, 1, "rough surfaces spread their reflections");
  visit("effect.roulette", s.effect.roulette, 0, 1, "random paths that carry little light end by chance");
  visit("effect.radius", s.effect.radius, 0, 10000, "meters within which things occlude; 0: any distance");
  visit("effect.layers", s.effect.layers, 1, 64, "surfaces behind each other that are looked at");
  visit("effect.transfer", s.effect.transfer, 0, 0, "what a layer adds to the light behind it and lets through");
  visit("effect.opacity", s.effect.opacity, 0, 1, "of a layer that is seen straight on");
  visit("shadow.method", s.shadow.method, 0, 0, "how shadows of direct lights are found");
  visit("shadow.projection", s.shadow.projection, 0, 0,
        "how maps of directional lights lie: kept, or finer near the camera and redrawn when it moves");
  visit("shadow.samples", s.shadow.samples, 1, 64, "rays to a light that has an extent");
  visit("shadow.kernel", s.shadow.kernel, 1, 31,
        "pixels along the square around a shadow's edge that rays decide, odd");
  visit("shadow.resolution", s.shadow.resolution, 16, 8192, "texels along a shadow map");
  visit("shadow.sky_directions", s.shadow.skyDirections, 0, 32, "shadowed directions that stand for the sky");
  visit("image.exposure", s.image.exposure, -20, 20, "stops");
  visit("image.tone_map", s.image.toneMap, 0, 0, "from linear radiance to the display");
  visit("image.motion", s.image.motion, 0, 1, "makes motion vectors, for the layers");
  visit("image.antialiasing", s.image.antialiasing, 0, 0, "how frames in motion get smooth edges");
}

// The shortest text that reads back as the same value: 0.4 for the float 0.4.
template <class T>
std::string numberText(T value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

[[noreturn]] void reject(std::string_view name, std::string_view value, const std::string& expected) {
  throw Error(ErrorKind::badInput,
              "setting " + std::string(name) + ": '" + std::string(value) + "' is not " + expected);
}

double parseNumber(std::string_view name, std::string_view value, double low, double high, bool whole,
                   const std::string& orElse = {}) {
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool valid = error == std::errc() && end == value.data() + value.size() && number >= low && number <= high &&
                     (!whole || number == std::floor(number));
  if (!valid)
    reject(name, value,
           std::string(whole ? "a whole number" : "a number") + " from " + numberText(low) + " to " + numberText(high) +
               orElse);
  return number;
}

}  // namespace

int resolutionOf(const VoxelSettings& voxels, const ABufferSettings& abuffer) {
  if (voxels.resolution != 0) return voxels.resolution;
  return std::clamp(static_cast<int>(std::lround(std::sqrt(3.0 * abuffer.resolution))), 1, kMaxVoxels);
}

bool isWord(const SettingInfo& info) {
  return std::find(info.choices.begin(), info.choices.end(), info.value) != info.choices.end();
}

std::vector<SettingInfo> describe(const Settings& settings) {
  std::vector<SettingInfo> infos;
  visitAll(settings, [&](const char* name, const auto& value, double low, double high, const char* help) {
    using T = std::decay_t<decltype(value)>;
    SettingInfo info{name, {}, SettingInfo::Kind::choice, low, high, {}, help};
    if constexpr (std::is_same_v<T, bool>) {
      info.kind = SettingInfo::Kind::boolean;
      info.value = value ? "true" : "false";
    } else if constexpr (isChoice<T>) {
      info.choices = choicesOf<T>();
      if constexpr (std::is_enum_v<T>) {
        info.value = info.choices[static_cast<std::size_t>(value)];
      } else {
        info.value = value;
        for (const MethodInfo& method : methods()) info.help += "; " + method.name + ": " + method.help;
      }
    } else if constexpr (isOrAuto<T>) {
      info.kind = SettingInfo::Kind::integer;
      info.choices = {kAuto};
      info.value = value.value == 0 ? kAuto : numberText(value.value);
    } else {
      info.kind = std::is_integral_v<T> ? SettingInfo::Kind::integer : SettingInfo::Kind::real;
      info.value = numberText(value);
    }
    infos.push_back(std::move(info));
  });
  return infos;
}

void set(Settings& settings, std::string_view name, std::string_view value) {
  bool found = false;
  visitAll(settings, [&](const char* known, auto& target, double low, double high, const char*) {
    if (name != known) return;
    found = true;
    using T = std::decay_t<decltype(target)>;
    if constexpr (std::is_same_v<T, bool>) {
      if (value != "true" && value != "false") reject(name, value, "true or false");
      target = value == "true";
    } else if constexpr (isChoice<T>) {
      const std::vector<std::string> names = choicesOf<T>();
      const auto chosen = std::find(names.begin(), names.end(), value);
      if (chosen == names.end()) {
        std::string list;
        for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
        reject(name, value, "one of " + list);
      }
      if constexpr (std::is_enum_v<T>)
        target = static_cast<T>(chosen - names.begin());
      else
        target = *chosen;
    } else if constexpr (isOrAuto<T>) {
      target.value =
          value == kAuto ? 0 : static_cast<int>(parseNumber(name, value, low, high, true, std::string(" or ") + kAuto));
    } else {
      target = static_cast<T>(parseNumber(name, value, low, high, std::is_integral_v<T>));
    }
  });
  if (!found) throw Error(ErrorKind::badInput, "unknown setting '" + std::string(name) + "'");
}

}  // namespace halfsilver
