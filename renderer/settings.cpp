#include <halfsilver/settings.h>

#include <charconv>
#include <cmath>
#include <type_traits>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

template <class E>
struct Choices;  // names in the order of the enumerators
#define HALFSILVER_CHOICES(E, ...)                                    \
  template <>                                                         \
  struct Choices<E> {                                                 \
    static std::vector<std::string> names() { return {__VA_ARGS__}; } \
  };
HALFSILVER_CHOICES(SelectMode, "none", "reflective", "all")
HALFSILVER_CHOICES(SelectPattern, "scattered", "region")
HALFSILVER_CHOICES(Fill, "sky", "neighbours")
HALFSILVER_CHOICES(VoxelRaster, "voxel", "abuffer", "conservative")
HALFSILVER_CHOICES(AxisRule, "normal", "area", "own")
HALFSILVER_CHOICES(Buffers, "single", "three")
HALFSILVER_CHOICES(Lists, "pages", "linked")
HALFSILVER_CHOICES(Method, "none", "attributes", "identity", "exact", "auto")
HALFSILVER_CHOICES(TraceStage, "compute", "fragment")
HALFSILVER_CHOICES(ToneMap, "filmic", "none")
#undef HALFSILVER_CHOICES

// The table: visit(name, value, low, high, help) for each setting; low and high count for numbers only.
template <class S, class Visitor>
void visitAll(S& s, Visitor&& visit) {
  visit("scene.cull_back_faces", s.scene.cullBackFaces, 0, 1, "single-sided materials are invisible from behind");
  visit("select.mode", s.select.mode, 0, 0, "which pixels are traced");
  visit("select.fraction", s.select.fraction, 0, 1, "share of the selected pixels that is kept");
  visit("select.pattern", s.select.pattern, 0, 0, "where the pixels that are kept lie on the screen");
  visit("select.max_roughness", s.select.maxRoughness, 0, 1, "reflectivity fades to 0 at this roughness");
  visit("select.min_reflectivity", s.select.minReflectivity, 0, 1, "pixels at or below are not selected");
  visit("select.min_contribution", s.select.minContribution, 0, 1,
        "pixels that add at most about this to the display go");
  visit("select.fill", s.select.fill, 0, 0, "what stands in for reflections that are not traced");
  visit("voxels.resolution", s.voxels.resolution, 1, 512, "voxels along each axis (identity: at most)");
  visit("voxels.per_triangle", s.voxels.perTriangle, 0, 1000, "voxels a triangle; 0: as resolution says (identity)");
  visit("voxels.raster", s.voxels.raster, 0, 0, "how triangles reach voxels");
  visit("voxels.axis", s.voxels.axis, 0, 0, "how a dominant axis is chosen");
  visit("abuffer.resolution", s.abuffer.resolution, 1, 4096, "texels along each axis");
  visit("abuffer.keep", s.abuffer.keep, 0, 1, "keep what is built while the geometry stays (identity)");
  visit("abuffer.page_size", s.abuffer.pageSize, 1, 64, "entries of a page");
  visit("abuffer.buffers", s.abuffer.buffers, 0, 0, "one buffer a fragment, or all three");
  visit("abuffer.lists", s.abuffer.lists, 0, 0, "pages or a linked list of entries");
  visit("abuffer.sorted", s.abuffer.sorted, 0, 1, "entries are sorted by depth after the build");
  visit("search.steps", s.search.steps, 0, 64, "linear steps in a voxel; 0: full 2D-DDA");
  visit("search.refinements", s.search.refinements, 0, 32, "binary search steps");
  visit("trace.method", s.trace.method, 0, 0, "the tracer");
  visit("trace.bounces", s.trace.bounces, 1, 16, "reflections along a path");
  visit("trace.stage", s.trace.stage, 0, 0, "the shader stage that traces");
  visit("shadow.resolution", s.shadow.resolution, 16, 8192, "texels along a shadow map");
  visit("shadow.sky_directions", s.shadow.skyDirections, 0, 32, "shadowed directions that stand for the sky");
  visit("image.exposure", s.image.exposure, -20, 20, "stops");
  visit("image.tone_map", s.image.toneMap, 0, 0, "from linear radiance to the display");
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

double parseNumber(std::string_view name, std::string_view value, double low, double high, bool whole) {
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool valid = error == std::errc() && end == value.data() + value.size() && number >= low && number <= high &&
                     (!whole || number == std::floor(number));
  if (!valid)
    reject(name, value,
           std::string(whole ? "a whole number" : "a number") + " from " + numberText(low) + " to " + numberText(high));
  return number;
}

}  // namespace

std::vector<SettingInfo> describe(const Settings& settings) {
  std::vector<SettingInfo> infos;
  visitAll(settings, [&](const char* name, const auto& value, double low, double high, const char* help) {
    using T = std::decay_t<decltype(value)>;
    SettingInfo info{name, {}, SettingInfo::Kind::choice, low, high, {}, help};
    if constexpr (std::is_same_v<T, bool>) {
      info.kind = SettingInfo::Kind::boolean;
      info.value = value ? "true" : "false";
    } else if constexpr (std::is_enum_v<T>) {
      info.choices = Choices<T>::names();
      info.value = info.choices[static_cast<std::size_t>(value)];
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
    } else if constexpr (std::is_enum_v<T>) {
      const std::vector<std::string> names = Choices<T>::names();
      std::string list;
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == value) {
          target = static_cast<T>(i);
          return;
        }
        list += (i ? ", " : "") + names[i];
      }
      reject(name, value, "one of " + list);
    } else {
      target = static_cast<T>(parseNumber(name, value, low, high, std::is_integral_v<T>));
    }
  });
  if (!found) throw Error(ErrorKind::badInput, "unknown setting '" + std::string(name) + "'");
}

}  // namespace halfsilver
