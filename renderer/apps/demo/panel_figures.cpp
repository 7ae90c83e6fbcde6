#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "apps/demo/panels.h"
#include "apps/demo/viewer.h"

namespace halfsilver::demo {
namespace {

double megabytes(std::uint64_t bytes) { return 1e-6 * static_cast<double>(bytes); }

void drawPlots(const FrameLog& log, float scale) {
  for (const auto& [stage, series] : log.stages()) {
    const int last = (log.first() + static_cast<int>(FrameLog::kFrames) - 1) % static_cast<int>(FrameLog::kFrames);
    char label[64];
    std::snprintf(label, sizeof(label), "%.1f ms",
                  static_cast<double>(series.milliseconds[static_cast<std::size_t>(last)]));
    ImGui::PushID(stage.c_str());
    ImGui::PlotLines("##plot", series.milliseconds.data(), static_cast<int>(FrameLog::kFrames), log.first(), label, 0,
                     std::max(1.0f, 1.1f * series.max), {170 * scale, 26 * scale});
    ImGui::PopID();
    ImGui::SameLine();
    ImGui::TextUnformatted(stage.c_str());
  }
}

}  // namespace

void drawStatus(const OverlayState& state, float scale) {
  std::vector<std::string> lines = state.status;
  if (!state.message.empty()) lines.push_back(state.message);
  if (lines.empty()) return;
  const ImVec2 area = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * area.x, area.y - 50 * scale}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowBgAlpha(0.45f);
  ImGui::Begin("status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushTextWrapPos(0.9f * area.x);
  for (const std::string& line : lines) ImGui::TextUnformatted(line.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void drawFigures(const OverlayState& state, float scale) {
  const FrameFigures& last = state.log.last();
  const FrameReport& report = last.report;
  const MemoryReport& memory = report.memory;
  ImGui::SetNextWindowPos({10 * scale, 10 * scale}, state.resized ? ImGuiCond_Always : ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin("Frame", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::Text("%.1f ms, %d x %d", last.wallMilliseconds, last.width, last.height);
  if (!state.controller.empty()) ImGui::TextUnformatted(state.controller.c_str());
  const double pixels = static_cast<double>(std::max<std::uint64_t>(1, report.pixels));
  ImGui::Text("rays %llu, %.1f %% of the picture", static_cast<unsigned long long>(report.selected),
              100 * static_cast<double>(report.selected) / pixels);
  ImGui::Text("overflow %llu", static_cast<unsigned long long>(report.overflow));
  ImGui::Text("structure %.2f MB", megabytes(memory.structureTotal));
  ImGui::Text("geometry %.1f, textures %.1f, shadows %.1f MB", megabytes(memory.geometry), megabytes(memory.textures),
              megabytes(memory.shadowMaps));
  ImGui::Text("G-buffer %.1f, in all %.1f MB", megabytes(memory.gbuffer), megabytes(memory.peak));
  ImGui::Separator();
  drawPlots(state.log, scale);
  for (const std::string& warning : report.warnings) ImGui::TextWrapped("%s", warning.c_str());
  ImGui::End();
}

void drawSplitter(Options& options, float scale) {
  const ImVec2 area = ImGui::GetIO().DisplaySize;
  const float x = options.splitAt * area.x;
  ImGui::GetBackgroundDrawList()->AddLine({x, 0}, {x, area.y}, IM_COL32(255, 255, 255, 220), 2 * scale);
  ImGui::SetNextWindowPos({x, area.y - 40 * scale}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({220 * scale, 0});
  ImGui::SetNextWindowBgAlpha(0.6f);
  ImGui::Begin("split", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderFloat("##split", &options.splitAt, 0, 1,
                     (options.settings.trace.method + " | " + options.other.trace.method).c_str());
  ImGui::End();
}

void drawKeys(const OverlayState& state, float scale) {
  const Options& options = state.options;
  const ImVec2 area = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * area.x, 0.5f * area.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("Keys", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
  const auto line = [scale](const char* key, const char* what, const char* now = "") {
    ImGui::TextUnformatted(key);
    ImGui::SameLine(110 * scale);
    ImGui::Text("%s%s%s", what, *now ? ": " : "", now);
  };
  const auto onOff = [](bool on) { return on ? "on" : "off"; };
  line("G", "overlay", onOff(options.overlay));
  line("F1", "this list", onOff(options.keys));
  line("Space", "exact reference of the view", onOff(options.reference));
  line("Tab", "split screen", onOff(options.split));
  line("1 .. 9", "what the picture shows", kViewNames[static_cast<int>(options.view)]);
  line("B", "cells of the structure", kCellNames[static_cast<int>(options.cells)]);
  line("T", "frozen time", onOff(options.frozen));
  line("V", "vertical sync", onOff(options.verticalSync));
  line("F11", "fullscreen");
  line("F12", "screenshot; with Shift at four times the size");
  line("L", "layers of the picture to an EXR file");
  line("Enter", "start the game");
  line("R", "restart the game");
  line("Backspace", "put the ball back");
  line("F5 .. F8", "lanterns; plates on the floor switch them, too");
  line("N", "day or night in the game");
  line("W A S D", "roll the ball, or fly in a scene (right mouse button; E up, Q down; wheel: speed)");
  line("mouse", "left: orbit; middle: pan; wheel: zoom; double click: pivot");
  line("F", "show what was clicked, or all");
  line("left, right", "the folder's scenes");
  line("drop", "a scene's file on the window opens it");
  line("P", "pause the animations", state.viewer ? onOff(state.viewer->paused) : "");
  line("gamepad", "sticks roll and look, triggers fly up and down", state.gamepad ? "connected" : "none");
  line("", "A starts, Start restarts, Y puts the ball back, X is day or night, the pad is lanterns");
  line("Esc", "end");
  ImGui::End();
}

}  // namespace halfsilver::demo
