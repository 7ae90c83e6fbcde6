#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <halfsilver/frame_report.h>
#include <halfsilver/image.h>
#include <halfsilver/methods.h>
#include <halfsilver/model.h>
#include <halfsilver/pose.h>
#include <halfsilver/scene.h>
#include <halfsilver/scene_change.h>
#include <halfsilver/settings.h>
#include <halfsilver/structure_cells.h>
#include <halfsilver/target.h>

// The public class. Everything here throws halfsilver::Error and nothing else on purpose.
namespace halfsilver {

// A surface of a picture.
struct Picked {
  std::uint32_t triangle = 0;  // its number in the scene
  glm::vec3 position{0};       // relative to Scene::origin
};

struct DeviceInfo {
  std::string vendor, renderer, version;
  bool software = false;
  // Programs that a Renderer has made so far: from their sources, and from what an earlier start has kept on disk.
  std::uint64_t programsCompiled = 0, programsCached = 0;
};

// Draws scenes with selective ray-traced reflections. Use with one current GL 4.5 core context, the same from
// construction to destruction. Each call leaves the GL state that it touches as it found it, see restoreState().
//
// Programs are kept on disk where the driver gives them out, in the folder that the environment names in
// HALFSILVER_CACHE (empty: not kept) or in halfsilver/ of the user's cache folder ($XDG_CACHE_HOME, otherwise
// ~/.cache); a later start takes them from there.
class Renderer {
 public:
  using Proc = void (*)();
  // `getProcAddress` is the context's. `exact` makes the tracer of trace.method=exact (see halfsilver::exact).
  // Throws Error (noContext) naming what the context lacks.
  explicit Renderer(const std::function<Proc(const char*)>& getProcAddress, TracerFactory exact = {});
  // With methods of the caller's own; one with the name of a method of the library takes its place.
  Renderer(const std::function<Proc(const char*)>& getProcAddress, std::vector<Method> methods);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  DeviceInfo device() const;

  // Whether calls leave the GL state that they touch as they found it: they do unless told otherwise, and ask the
  // driver for some 700 values each time, every answer of which is a wait. A caller that sets all that it needs after
  // each call can spare that: calls then leave all state as it happens to be.
  void restoreState(bool restores);

  // Whether it has a tracer of that method: its own, or one that was brought.
  bool traces(std::string_view method) const;

  // Uploads the whole scene; the caller's copy is not kept.
  void setScene(const Scene& scene);
  // Uploads what changed since setScene(): moved vertices, lights, the sky or the values of materials. Triangles, the
  // number of vertices, materials and textures stay as they were. Throws Error (usage) if they do not, if
  // `change.topology` is set or while a frame is under way.
  void update(const Scene& scene, const SceneChange& change);
  // The same for moved vertices, and for lights that moved with them.
  void updateVertices(const Scene& scene, std::span<const VertexRange> ranges);

  // setScene() of the model's scene, and what poses it on the GPU. Keeps a copy of the rig. The scene's bounds, and
  // with them grids and shadow maps, are those of all that the model's animations do, so that they stay while it moves.
  // `bounds`: those of the model, if the caller has them. Throws Error (usage), naming it, if an index of the rig
  // points nowhere or lists that belong together differ in length; nothing has changed then.
  void setModel(const Model& model);
  void setModel(const Model& model, const AnimatedBounds& bounds);
  // Moves what setModel() uploaded: vertices, winding and attached lights, as pose() of pose.h does, within 1e-5 of the
  // scene's diagonal; the caller's model is neither read nor changed. See posedCamera() for cameras. A compute pass
  // places the vertices in the next frame (stage "pose"), or with scene.posing = cpu the CPU does, in double precision.
  // Only instances that the pose places elsewhere count as moved, and only lights whose node it moves follow.
  // Those that floats cannot place so exactly are placed on the CPU, in double precision; a pose that mirrors an
  // instance waits for the GPU, and so does each frame of a pose whose rays the CPU traces (it reads the vertices
  // back). update() still brings the rest up to date: materials, lights, vertices of what cannot move. Lights whose
  // node has moved stay where it is.
  // Throws Error: usage for a pose of another rig, without a model and while a frame is under way; badInput if vertices
  // leave the range of floats. Nothing has moved then.
  void pose(const PoseState& state);

  // Makes ready what frames by these settings need: compiles all programs (seconds on some drivers), and draws small
  // pictures of the scene so that drivers which compile at the first draw do that, too. Afterwards no frame of render()
  // or refine() by them into a target with that use of depth compiles anything, whatever moves. For a loading screen;
  // settings that a frame may change to want a call of their own, the ones that come first the last. What methods keep
  // from frame to frame is dropped if the settings need another tracer. Temporal antialiasing and refine() start over,
  // reports of earlier frames are gone. Waits for the GPU. Throws Error: usage without a scene and while a frame is
  // under way, otherwise as render().
  void prepare(const Settings& settings, DepthUse depth = DepthUse::none);

  // Drops what methods keep from frame to frame (abuffer.keep): the next frame builds what its own rays need.
  void forgetStructures();

  // Draws one frame into the target at the target's size: begin() and finish(). Camera is relative to Scene::origin.
  // Waits for the GPU's counts of what a method has to build (see tracing/README.md).
  void render(const Camera& camera, const Settings& settings, const Target& target);

  // A frame in two halves. begin() draws all that needs no hits and starts the rays; finish() ends the oldest frame
  // that was begun. Up to two may be under way, so that a tracer on the CPU can work beside the GPU; each has memory of
  // its own. The scene must not change between the two, and the target has the size that begin() was given. Settings
  // that make another tracer (its method or what that reads), effect or shadow maps wait until no frame is under way.
  // Throw Error (usage) otherwise.
  // A frame whose finish() throws is dropped. With two under way, figures of structures are those of the latest build.
  void begin(const Camera& camera, const Settings& settings, int width, int height);
  void finish(const Target& target);

  // A still picture with smooth edges, sample by sample: draws one frame whose pixels are sampled at place number
  // `sample` of a fixed sequence, adds its linear light to that of the calls before and shows their mean. Place 0 is
  // the pixel's center, and any first n places are spread evenly over the pixel: the mean is a box filter one pixel
  // wide. A new picture begins if anything but image.* is not as it was in the call before: camera, settings, size,
  // scene; or after forgetHistory(). The same places in the same order give the same picture to the bit.
  // image.antialiasing does not count here. A target with a depth test (Target::depth) needs the caller's own depth
  // again before each call: the depth that a sample leaves hides the pixels of the next that lie behind it, which go
  // on showing an earlier mean (their sum is right, and so is readLayers()). Throws Error (usage) as render().
  void refine(const Camera& camera, const Settings& settings, const Target& target, std::uint32_t sample);
  // How many samples that picture has by now.
  std::uint32_t samples() const;
  // What was drawn so far goes into no later picture: the camera has cut, or another picture of the same view begins.
  // Temporal antialiasing forgets by itself after setScene(), and if the size or settings other than image.* and the
  // share of reflections that are traced (select.fraction, select.min_contribution) are not those of the frame before.
  void forgetHistory();

  // What brings objects of the caller's (relative to Scene::origin) to where the camera shows them in the target, at
  // depths that compare with those that a frame leaves there (see DepthUse; none is as standard). Planes that the
  // camera leaves at 0 are those of a frame of the scene as it is now and may cut off what lies outside its bounds:
  // name them if there is such. Samples of refine() and of temporal antialiasing lie up to half a pixel from the
  // pixels' centers, and so does the depth that they leave, which is the newest one's. Throws Error (usage) for a size
  // below 1, a camera without a direction or a field of view and without a scene.
  CameraMatrices matrices(const Camera& camera, const Target& target) const;

  // What the frame that finish() ended last took and held. Waits for the GPU.
  FrameReport report();
  // The same of the newest finished frame whose figures have arrived, if there is one; never waits. Reports come in the
  // order of the frames; each is given once.
  std::optional<FrameReport> arrivedReport();

  // Compiles the shaders again, from the folder that the environment names in HALFSILVER_SHADERS if it names one. A
  // program whose new source has errors stays as it was; returns the errors, one line each. Structures stay too: a
  // change of how they are built needs forgetStructures(). Throws Error (usage) while a frame is under way.
  std::vector<std::string> reloadShaders();

  // The frame that finish() ended last as the layers of the contract (R G B A, depth.Z, normal.X/Y/Z, reflectivity.Y,
  // selected.Y, hit.T, hit.id, hit.nx/ny/nz, reflection.R/G/B; with image.motion also motion.X/Y, pixels to the right
  // and down since the frame before; with shadow.method = refined also shadow.marked and shadow.lit, how many direct
  // lights' shadows rays decide at a pixel and how many light it by their maps; if readRayWork() is possible also
  // work.steps and work.tests), rows from the top.
  // After refine(), R G B A are the mean of all samples and the other layers those of the last one; with
  // image.antialiasing = temporal likewise of the frames joined. R G B are radiance, so fxaa does not show in them.
  // Waits for the GPU. With frames under way, only until a begin() takes the memory of that frame.
  Image readLayers() const;

  // What that frame shows at a pixel, whose row 0 is the bottom; nothing if that is the sky or outside. Waits for the
  // GPU.
  std::optional<Picked> pick(int x, int y) const;

  // The cells of the structure as it is now; empty if the method has none. Waits for the GPU.
  StructureCells readStructure() const;

  // The work of each ray of that frame, in the order in which they were traced. Empty unless trace.count_work was set
  // and the method counts. Only of a frame of one bounce whose rays fit one batch (a storage block holds what belongs
  // to them), with no other under way and the scene unchanged since: throws Error (usage) otherwise. Waits for the GPU.
  std::vector<RayWork> readRayWork();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace halfsilver
