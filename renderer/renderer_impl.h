#pragma once

#include <halfsilver/renderer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <halfsilver/ray_reader.h>
#include "effects/light_rays/light_rays.h"
#include "effects/ray_effect.h"
#include "frame/gpu_rig.h"
#include "frame/surface_reader.h"
#include "frame_record.h"
#include "passes/gbuffer.h"
#include "passes/interpolate.h"
#include "passes/motion.h"
#include "passes/pose.h"
#include "passes/shade.h"
#include "passes/shadow_marks.h"
#include "passes/shadows.h"
#include "picture.h"
#include "renderer_screen.h"

namespace halfsilver {

// All that a renderer owns. renderer.cpp draws frames, renderer_rays.cpp follows their rays, renderer_lights.cpp finds
// shadows, renderer_prepare.cpp makes ready for frames, renderer_reads.cpp reads back what they show.
struct Renderer::Impl {
  // Frames that may be under way, and frames whose figures may be: those, and one that has been reported.
  static constexpr std::size_t kFrames = 2, kRecords = kFrames + 1;

  Impl(const std::function<Proc(const char*)>& getProcAddress, std::vector<Method> brought)
      : api(gl::Api::load(getProcAddress)), methods(std::move(brought)) {}

  gl::Api api;
  std::vector<Method> methods;  // the caller's own
  PosePass posePass{api};
  ShadowPass shadowPass{api};
  GBufferPass gbufferPass{api};
  MotionPass motionPass{api};
  ShadowMarkPass shadowMarkPass{api};
  ShadePass shadePass{api};
  LightRays lightRays{api};
  InterpolatePass interpolatePass{api};
  RayTallyPass tallyPass{api};
  ScreenLook screenLook{api};
  Picture picture{api};
  std::unique_ptr<RayEffect> effect;
  std::optional<Effect> effectName;

  GpuScene scene;
  std::optional<GpuRig> rig;  // of setModel()
  std::vector<Light> lights;
  Sky sky;
  bool hasScene = false;
  SceneChange change;              // since the tracer was updated
  std::vector<VertexRange> moved;  // since the last frame

  ShadowMaps shadows;
  std::optional<ShadowSettings> shadowSettings;  // of the maps; none: they are out of date
  ShadowBoxes shadowsShow;                       // likewise
  ShadowChange shadowChange;                     // since they were drawn
  std::vector<std::string> shadowWarnings;
  std::unique_ptr<Tracer> tracer;
  std::optional<Settings> tracerSettings;  // of the tracer, which is null for "none"
  std::uint32_t tracedBlends = 0;          // FrameConstants::blends of its last frame

  // A frame under way, and its figures.
  struct Work {
    std::size_t frame, record;
  };
  std::array<Frame, kFrames> frames;
  std::array<FrameRecord, kRecords> records{FrameRecord(api), FrameRecord(api), FrameRecord(api)};
  std::deque<Work> underWay;            // the oldest first
  std::optional<std::size_t> shown;     // the frame that finished last, until another one takes its memory
  std::optional<std::size_t> reported;  // the record of the frame that finished last
  std::deque<std::size_t> unreported;   // records of finished frames, the oldest first

  std::optional<RayReader> rayReader;          // of readLayers()
  std::optional<SurfaceReader> surfaceReader;  // of that and of pick()

  FrameView viewOf(Frame& frame, gl::Profiler& profiler) const {
    return {scene, shadows, frame.constants, frame.host, profiler, frame.gbuffer};
  }
  void checkDevice() const;
  const SurfaceReader& surfaces();
  std::size_t takeRecord();
  bool keepsWork() const;
  std::vector<shared::RayWork> readWork();
  std::vector<std::vector<std::uint32_t>> readAnswers() const;
  void useTracer(const Settings& wanted);
  void useEffect(Effect wanted);
  bool blends(const Settings& wanted) const;
  bool lightsByRays(const Settings& wanted) const;
  bool marksShadows(const Settings& wanted) const;
  ShadowSettings shadowsOf(const Settings& wanted) const;
  void drawShadows(const Camera& camera, float aspect, const Settings& wanted, gl::Profiler& profiler);
  void markShadows(const FrameView& view, const Settings& wanted, GBuffer& gbuffer);
  std::uint32_t maxRays(const Settings& wanted, const shared::FrameConstants& frame) const;
  void submitBatch(const FrameView& view, Frame& frame, std::size_t number);
  void finishBatch(const FrameView& view, Frame& frame, std::size_t number);
  LightRays::Trace tracing(const FrameView& view, const Frame& frame);
  void seeThrough(const FrameView& view, Frame& frame);
  void runPass(const FrameView& view, Frame& frame, RayBatch& batch, RayStep step);
  void begin(const Camera& camera, const Settings& wanted, int width, int height,
             const std::optional<std::uint32_t>& sample = {});
  void start(const Work& work, const Camera& camera, const Settings& wanted, const glm::ivec2& size,
             const std::optional<std::uint32_t>& sample);
  void finish(const Target& target);
  void prepare(const Settings& wanted, DepthUse depth);
  void noteChange(const SceneChange& changed);
  void load(const Scene& wanted, std::vector<PosedPart> posed);
  void pose(const PoseState& state);
  void upload(const Scene& wanted, const SceneChange& changed);
};

}  // namespace halfsilver
