#pragma once

#include <memory>
#include <string>

#include "apps/demo/demo.h"
#include "apps/demo/options.h"
#include "apps/demo/play.h"

// What the window and the run without one have in common at their start.
namespace halfsilver::demo {

// What the request asks to play. Throws Error (badInput, usage).
std::unique_ptr<Play> makePlay(const Request& request);
// Another scene in the viewer.
std::unique_ptr<Play> makeViewer(const Request& request, const std::string& scene);

// Options before anything was chosen: the device's own method of tracing, then preset, file and --set.
Options firstOptions(const Request& request);

void runWindow(const Request& request);
void runHeadless(const Request& request);

}  // namespace halfsilver::demo
