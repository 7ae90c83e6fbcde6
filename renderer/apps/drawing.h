#pragma once

#include <string>

#include <halfsilver/context.h>
#include <halfsilver/renderer.h>

// What every program that draws does alike.
namespace halfsilver {

// "auto", "egl" or "osmesa", as --context takes them.
ContextKind contextKind(const std::string& name);

// Rays of the CPU for trace.method=exact; empty where the project is built without Embree. The scene must outlive it.
// `threads` 0: one a core.
TracerFactory exactFactory(const Scene& scene, int threads);

// The first frame, as often as its structure needs to find its size (at most four times), and its report. Returns how
// often it was drawn.
int drawFirstFrame(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                   FrameReport& report);

}  // namespace halfsilver
