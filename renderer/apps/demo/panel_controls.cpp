#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/methods.h>
#include "apps/demo/panels.h"
#include "apps/demo/viewer.h"
#include "apps/drawing.h"

namespace halfsilver::demo {
namespace {

constexpr std::array kMain = {"trace.method",   "trace.bounces",      "select.max_roughness",
                              "image.exposure", "image.antialiasing", "select.fraction"};

// A widget of the setting's kind.
void drawSetting(Settings& settings, const SettingInfo& info) {
  const auto assign = [&](const std::string& value) {
    try {
      set(settings, info.name, value);
    } catch (const Error&) {
      // Out of range while it is typed: the old value stays.
    }
  };
  const char* label = info.name.c_str();
  switch (info.kind) {
    case SettingInfo::Kind::boolean: {
      bool value = info.value == "true";
      if (ImGui::Checkbox(label, &value)) assign(value ? "true" : "false");
      break;
    }
    case SettingInfo::Kind::integer: {
      // A word that stands for a number is shown until a number is chosen.
      const bool word = isWord(info);
      int value = word ? static_cast<int>(info.low) : std::stoi(info.value);
      const char* format = word ? info.value.c_str() : "%d";
      if (ImGui::SliderInt(label, &value, static_cast<int>(info.low), static_cast<int>(info.high), format))
        assign(std::to_string(value));
      break;
    }
    case SettingInfo::Kind::real: {
      float value = std::stof(info.value);
      if (ImGui::SliderFloat(label, &value, static_cast<float>(info.low), static_cast<float>(info.high)))
        assign(std::to_string(value));
      break;
    }
    case SettingInfo::Kind::choice:
      if (!ImGui::BeginCombo(label, info.value.c_str())) break;
      for (const std::string& choice : info.choices)
        if (ImGui::Selectable(choice.c_str(), choice == info.value)) assign(choice);
      ImGui::EndCombo();
      break;
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.help.c_str());
}

void drawSettings(Settings& settings) {
  if (ImGui::BeginCombo("preset", "...")) {
    for (const Preset& preset : presets())
      if (ImGui::Selectable(preset.name.c_str())) {
        settings = Settings();
        applyPreset(settings, preset.name);
      }
    ImGui::EndCombo();
  }
  const std::vector<SettingInfo> all = describe(settings);
  for (const char* name : kMain)
    for (const SettingInfo& info : all)
      if (info.name == name) drawSetting(settings, info);
  if (!ImGui::TreeNode("all settings")) return;
  for (const SettingInfo& info : all) drawSetting(settings, info);
  ImGui::TreePop();
}

// The first directional light by the angles of where it comes from.
bool drawSun(Scene& scene) {
  const auto sun = std::find_if(scene.lights.begin(), scene.lights.end(),
                                [](const Light& light) { return light.type == LightType::directional; });
  if (sun == scene.lights.end()) return false;
  const glm::vec3 from = -sun->direction;
  float angles[2] = {glm::degrees(std::atan2(from.x, from.z)),
                     glm::degrees(std::asin(std::clamp(from.y, -1.0f, 1.0f)))};
  if (!ImGui::DragFloat2("sun", angles, 0.5f, -180, 180, "%.0f deg")) return false;
  const float azimuth = glm::radians(angles[0]), height = glm::radians(std::clamp(angles[1], -89.0f, 89.0f));
  sun->direction =
      -glm::vec3(std::sin(azimuth) * std::cos(height), std::sin(height), std::cos(azimuth) * std::cos(height));
  return true;
}

bool drawMaterial(Material& material) {
  ImGui::Separator();
  ImGui::Text("material '%s'", material.name.c_str());
  bool changed = false, mirror = material.mirror.has_value();
  if (ImGui::Checkbox("mirror", &mirror)) {
    material.mirror = mirror ? std::optional<float>(0.9f) : std::nullopt;
    changed = true;
  }
  if (material.mirror) changed |= ImGui::SliderFloat("reflectance", &*material.mirror, 0, 1);
  changed |= ImGui::SliderFloat("roughness", &material.roughness, 0, 1);
  changed |= ImGui::SliderFloat("metallic", &material.metallic, 0, 1);
  changed |= ImGui::ColorEdit3("base color", &material.baseColor.x, ImGuiColorEditFlags_Float);
  return changed;
}

void drawAnimation(const Model& model, Viewer& viewer) {
  const std::vector<Animation>& animations = model.rig.animations;
  if (animations.empty()) return;
  ImGui::Separator();
  const int chosen = viewer.chosen();
  if (ImGui::BeginCombo("animation", chosen < 0 ? "all" : animations[static_cast<std::size_t>(chosen)].name.c_str())) {
    if (ImGui::Selectable("all", chosen < 0)) viewer.choose(-1);
    for (std::size_t a = 0; a < animations.size(); ++a) {
      ImGui::PushID(static_cast<int>(a));
      if (ImGui::Selectable(animations[a].name.empty() ? "without a name" : animations[a].name.c_str()))
        viewer.choose(static_cast<int>(a));
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  const double duration = viewer.duration();
  auto time = static_cast<float>(duration > 0 ? std::fmod(viewer.seconds, duration) : 0.0);
  if (ImGui::SliderFloat("time", &time, 0, static_cast<float>(duration), "%.2f s"))
    viewer.seconds = static_cast<double>(time);
  ImGui::Checkbox("pause", &viewer.paused);
}

}  // namespace

SceneChange drawControls(OverlayState& state, float scale) {
  Options& options = state.options;
  SceneChange change;
  const ImVec2 area = ImGui::GetIO().DisplaySize;
  const ImGuiCond when = state.resized ? ImGuiCond_Always : ImGuiCond_FirstUseEver;
  ImGui::SetNextWindowPos({area.x - 10 * scale, 10 * scale}, when, {1, 0});
  ImGui::SetNextWindowSize({std::min(350 * scale, area.x - 20 * scale), 0}, when);
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin("Controls");
  ImGui::PushItemWidth(-155 * scale);
  int view = static_cast<int>(options.view);
  if (ImGui::Combo("show", &view, kViewNames, IM_ARRAYSIZE(kViewNames))) options.view = static_cast<View>(view);
  int cells = static_cast<int>(options.cells);
  if (ImGui::Combo("cells", &cells, kCellNames, IM_ARRAYSIZE(kCellNames))) options.cells = static_cast<Cells>(cells);
  ImGui::Checkbox("exact", &options.reference);
  ImGui::SameLine();
  ImGui::Checkbox("split", &options.split);
  ImGui::SameLine();
  ImGui::Checkbox("freeze", &options.frozen);
  auto wanted = static_cast<float>(options.frameTime);
  if (ImGui::SliderFloat("frame time", &wanted, 0, 200, wanted > 0 ? "hold %.0f ms" : "full size"))
    options.frameTime = static_cast<double>(wanted);
  ImGui::SliderInt("samples", &options.samples, 1, kMaxSamples, options.samples > 1 ? "%d" : "one",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Frames whose mean the picture becomes while nothing moves");
  ImGui::Separator();
  drawSettings(options.settings);
  if (options.split && ImGui::TreeNode("right side")) {
    drawSettings(options.other);
    ImGui::TreePop();
  }
  change.lights = drawSun(state.model.scene);
  if (state.material && *state.material < state.model.scene.materials.size())
    change.materials = drawMaterial(state.model.scene.materials[*state.material]);
  if (state.viewer) drawAnimation(state.model, *state.viewer);
  ImGui::Separator();
  ImGui::TextUnformatted("F1: all keys");
  ImGui::PopItemWidth();
  ImGui::End();
  return change;
}

}  // namespace halfsilver::demo
