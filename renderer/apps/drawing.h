#pragma once

#include <string>

#include <halfsilver/context.h>
#include <halfsilver/renderer.h>

// What all programs that draw have in common.
namespace halfsilver {

// "auto", "egl" or "osmesa", as --context takes them.
ContextKind contextKind(const std::string& name);

// CPU rays for trace.method=exact; empty if the project is built without Embree. The scene must outlive it.
// `threads` 0: one per core.
TracerFactory exactFactory(const Scene& scene, int threads);

// Draws a picture of several samples per pixel, the one at the pixel's center last, so that the renderer's layers are
// those of an ordinary frame; of one sample, an ordinary frame. The report is the last frame's, with the times, the
// overflow and the lost fragments of all together.
FrameReport drawPicture(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                        int samples);

// Draws the first picture, repeatedly until its structure has found its size (at most four times), and fills `report`.
// Returns how many times it was drawn.
int drawFirstFrame(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                   FrameReport& report, int samples = 1);

}  // namespace halfsilver
