#pragma once

#include "apps/demo/overlay.h"

// The parts of the overlay, between ImGui::NewFrame() and ImGui::Render(). `scale` is the display's.
namespace halfsilver::demo {

void drawStatus(const OverlayState& state, float scale);
void drawFigures(const OverlayState& state, float scale);  // times as plots, memory, rays
SceneChange drawControls(OverlayState& state, float scale);
void drawSplitter(Options& options, float scale);
void drawKeys(const OverlayState& state, float scale);

}  // namespace halfsilver::demo
