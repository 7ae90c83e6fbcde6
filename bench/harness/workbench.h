#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/context.h>
#include <halfsilver/gl/api.h>
#include <halfsilver/model.h>
#include <halfsilver/renderer.h>
#include "apps/offscreen.h"
#include "apps/statistics.h"
#include "bench/harness/bench_scene.h"
#include "bench/harness/gl_work.h"
#include "bench/harness/request.h"
#include "gl/debug.h"

namespace halfsilver::bench {

// A device that holds one scene at a time.
class Workbench {
 public:
  // Throws Error (noContext).
  explicit Workbench(const Request& request);

  // Device, scene, size and settings of a run; nothing is drawn.
  RunStatistics describe(const BenchScene& scene, const Settings& settings) const;

  // Draws whole frames after one or more warm-up frames, in the size that `run` names; `run` gets their times and the
  // report of the last. The scene must live until the next one, or forget(). Throws Error (failed) on a GL error.
  void draw(const BenchScene& scene, RunStatistics& run, int frames = 1);
  // Uploads a scene in place of the previous one, unless it is there already; draw() does so, too.
  void load(const BenchScene& scene);
  // Frees the current scene and all its memory, also after an error.
  void forget();

  // Draws one more frame of the current scene; its structures keep the capacity that they have.
  void drawNext(const BenchScene& scene, RunStatistics& run);
  // The same for a picture of several samples per pixel.
  void drawSamples(const BenchScene& scene, RunStatistics& run, int samples);
  // What the renderer asked of GL in the frame that was drawn last, its report not counted.
  const GlWork& lastWork() const { return work_; }
  // The next frame builds its structure and draws its shadow maps as the first one does; programs are compiled.
  void startOver(const BenchScene& scene);
  // Of the current scene.
  void moveVertices(const BenchScene& scene, std::span<const VertexRange> ranges);

  // Of the last frame, see Renderer::readRayWork(); empty if its rays came in several batches.
  std::vector<RayWork> rayWork();

  // Of the last frame.
  Image layers() const { return renderer_->readLayers(); }
  // Channels R, G and B as displayed, 0..1; rows from the top.
  Image picture() const;
  // A PNG of at most 480 pixels along an edge.
  std::vector<std::byte> thumbnail() const;

 private:
  void failOnErrors();

  Size size_, targetSize_;
  Context context_;
  GlWatch watch_;
  GlWork work_;
  gl::Api api_;
  gl::DebugLog log_;
  OffscreenTarget target_;
  DeviceInfo device_;
  const BenchScene* scene_ = nullptr;
  std::optional<Renderer> renderer_;
};

}  // namespace halfsilver::bench
