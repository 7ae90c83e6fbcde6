#pragma once

#include <functional>
#include <string>
#include <vector>

#include <halfsilver/context.h>
#include <halfsilver/gl/api.h>
#include <halfsilver/renderer.h>

// What all programs that draw have in common.
namespace halfsilver {

inline constexpr int kMaxSamples = 4096;  // per pixel

// Software rasterizers free tens of megabytes behind each frame and take them again in the next. If the C library gives
// them back to the system meanwhile, new pages cost such a frame more than half of its time. For whoever is about to
// draw; the whole process keeps what it frees from then on.
void keepFreedMemory();

// Throws Error (failed) if OpenGL has noted an error since the last call: what was drawn may be wrong.
void checkErrors(const gl::Api& api);

// "auto", "egl" or "osmesa", as --context takes them.
ContextKind contextKind(const std::string& name);
// A context for the options; `warnings` takes that devices before it, which may be hardware, could not be used.
Context openContext(const std::string& kind, const std::string& device, std::vector<std::string>& warnings);

// CPU rays for trace.method=exact; empty if the project is built without Embree. The scene must outlive it.
// `threads` 0: one per core.
TracerFactory exactFactory(const Scene& scene, int threads);

// Adds those that are not there yet.
void addWarnings(const std::vector<std::string>& from, std::vector<std::string>& to);

// The reports of a picture's samples as one: the last frame's, with the times, the overflow and the lost fragments of
// all together and each warning once. Times that were rejected count as the mean of their stage's others.
class SampleReports {
 public:
  void add(FrameReport report);
  FrameReport joined() const;

 private:
  struct Sum {
    std::string stage;
    double milliseconds = 0;
    int runs = 0, accepted = 0;
  };
  std::vector<Sum> sums_;
  FrameReport joined_;  // but for the times
};

// How the passes of an effect (effect.passes) are drawn: so many per frame, and what is called after each frame but the
// last, with the passes that the picture holds. every 0: all in one frame.
struct PassSteps {
  int every = 0;
  std::function<void(int passes)> shown = {};
};

// Draws a picture of several samples per pixel, the one at the pixel's center last, so that the renderer's layers are
// those of an ordinary frame; of one sample, an ordinary frame, or several that refine it. Returns the report of all.
FrameReport drawPicture(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                        int samples, const PassSteps& steps = {});

// Draws the first picture, repeatedly until its structure has found its size (at most four times), and fills `report`.
// Returns how many times it was drawn.
int drawFirstFrame(Renderer& renderer, const Camera& camera, const Settings& settings, const Target& target,
                   FrameReport& report, int samples = 1, const PassSteps& steps = {});

}  // namespace halfsilver
