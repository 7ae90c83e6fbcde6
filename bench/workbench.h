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
#include "bench/request.h"
#include "gl/debug.h"

namespace halfsilver::bench {

struct BenchScene {
  std::string name;
  Model model;
  Camera camera;
  std::vector<std::string> mirrors;  // MATERIAL=REFLECTIVITY
  double diagonal = 0;               // metres
};

// All scenes of a request, with its mirrors and camera: a bad one must not show after an hour's work. Warnings about
// them go to stderr.
std::vector<BenchScene> loadScenes(const Request& request);

// A preset's settings for a scene of so many triangles. The papers' methods get the papers' voxels: 64^3, large scenes
// 256^3 (Kastrati & Goswami 2017, section 4.1), quick ones fewer. Throws Error (usage) for an unknown preset.
Settings presetSettings(const std::string& preset, bool quick, std::size_t triangles);

// A device with one scene at a time on it.
class Workbench {
 public:
  // Throws Error (noContext).
  explicit Workbench(const Request& request);

  // What identifies the device, the scene, the size and the settings of a run; nothing is drawn.
  RunStatistics describe(const BenchScene& scene, const Settings& settings) const;

  // Draws whole frames after one or more to warm up, of the size that `run` tells; it gets their times and the report
  // of the last. The scene must live until the next one, or forget(). Throws Error (failed) where GL complains.
  void draw(const BenchScene& scene, RunStatistics& run, int frames = 1);
  // Puts a scene on the device, in place of the one before, where it is not there yet; draw() does so, too.
  void load(const BenchScene& scene);
  // Gives up the scene that was drawn last and all its memory, also after an error.
  void forget();

  // Draws one more frame of the scene that was drawn last, with whatever room its structures have.
  void drawNext(const BenchScene& scene, RunStatistics& run);
  // Of the scene that was drawn last.
  void moveVertices(const BenchScene& scene, std::span<const VertexRange> ranges);

  // Of the last frame.
  Image layers() const { return renderer_->readLayers(); }
  // Channels R, G and B as they are displayed, 0..1; rows from the top.
  Image picture() const;
  // PNG of at most 480 pixels along an edge.
  std::vector<std::byte> thumbnail() const;

 private:
  void failOnErrors();

  Size size_, targetSize_;
  Context context_;
  gl::Api api_;
  gl::DebugLog log_;
  OffscreenTarget target_;
  DeviceInfo device_;
  const BenchScene* scene_ = nullptr;
  std::optional<Renderer> renderer_;
};

}  // namespace halfsilver::bench
