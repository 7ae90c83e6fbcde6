#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include <halfsilver/frame_view.h>
#include <halfsilver/methods.h>
#include <halfsilver/scene_change.h>
#include <halfsilver/settings.h>
#include <halfsilver/structure_cells.h>

namespace halfsilver {

// What a tracer's structure holds after a build. Bytes unless said otherwise.
struct TracerMemory {
  glm::ivec3 grid{0};  // count: voxels along each axis; 0 without a grid
  std::uint64_t voxels = 0;
  std::uint64_t heads = 0;
  std::uint64_t poolReserved = 0;
  std::uint64_t poolUsed = 0;            // by stored entries
  std::uint64_t fragments = 0;           // count: made by rasterization
  std::uint64_t fragmentsStored = 0;     // count
  std::uint64_t perAxis[3] = {0, 0, 0};  // count: stored in the A-buffer of x, y, z
  double bytesPerFragment = 0;
  std::uint64_t lostFragments = 0;   // count: not stored for lack of room; 0 when complete
  std::uint64_t structureTotal = 0;  // everything that is kept
  std::uint64_t transient = 0;       // beside it, the most at once during the last frame
};

// Counts of a build on the GPU, and what a copy of them says; `add` outlives the tracer.
struct TracerCounts {
  const gl::Buffer* buffer = nullptr;  // words; null: nothing is counted there
  void (*add)(std::span<const std::uint32_t> counts, TracerMemory& memory) = nullptr;
};

// A method of tracing rays: one folder under tracing/ each, see README.md there. The interface is all that the rest of
// the frame knows.
//
// Each frame calls update() once, then trace(), occluded() or submit() and collect() as often as there are queues.
// Every call binds what it reads (see FrameView) and leaves nothing bound that others rely on.
class Tracer {
 public:
  virtual ~Tracer() = default;

  // Follows the scene: `change` is what happened since the last update(), SceneChange::everything() before the first.
  // Sections "voxelize" and "build" of the profiler.
  virtual void update(const FrameView& view, const SceneChange& change) = 0;

  // Drops what is kept from frame to frame, so that the next frame builds what its own rays need.
  virtual void forget() {}

  // Traces every ray of the queue and writes one hit each, the nearest within Ray::maxDistance; section "trace". The
  // count stays on the GPU. Rays given up get t = HIT_OVERFLOW and are counted in RayCount::overflow.
  virtual void trace(const FrameView& view, const RayQueue& rays, Hits& hits) = 0;

  // Whether anything lies within maxDistance: t >= 0 if so, and then any hit, not the nearest, will do. HIT_MISS and
  // HIT_OVERFLOW as in trace().
  virtual void occluded(const FrameView& view, const RayQueue& rays, Hits& hits) { trace(view, rays, hits); }

  // trace() in two halves, for tracers that work beside the GPU: submit() starts, collect() ends with the hits written.
  // Between them the frame does what needs no hits. One queue can be under way per frame; `view`, `rays` and `hits` are
  // the same in both calls.
  virtual void submit(const FrameView& view, const RayQueue& rays, Hits& hits) { trace(view, rays, hits); }
  virtual void collect(const FrameView&, const RayQueue&, Hits&) {}

  // Whether its hits know the alpha of surfaces that blend and what is behind them; if not, these are cut at a half.
  virtual bool seesBehind() const { return !storesAttributes(); }

  // Whether trace() writes Hits::surfaces.
  virtual bool storesAttributes() const { return false; }

  // What the host knows of the structure; asks the GPU for nothing.
  virtual TracerMemory memory() const = 0;
  // What memory() lacks because it is on the GPU. A report copies it when a frame ends.
  virtual TracerCounts counts() const { return {}; }

  // What the structure holds, for pictures of it. Waits for the GPU.
  virtual StructureCells cells() const { return {}; }

  // ANSWER_... per ray of a queue of pixels that was traced in one of the two latest frames, of a method that has two
  // ways to answer; else null.
  virtual const gl::Buffer* answers(const RayQueue&) const { return nullptr; }

  // RayWork per ray of the queue that was traced last, if trace.count_work is set and the method counts.
  virtual const gl::Buffer* rayWork() const { return nullptr; }
};

// The tracer that the settings name; null for "none". Methods that the caller brings (see Renderer) come before those
// of the table. Throws Error (usage) for a method that needs the caller's tracer but was not brought, such as "exact".
// "auto" is "exact" on a software rasterizer if that is brought, else "identity"; <halfsilver/calibration.h> measures.
std::unique_ptr<Tracer> makeTracer(const gl::Api& api, const Settings& settings, std::span<const Method> brought);

// Whether makeTracer() knows how to make a tracer of that method.
bool hasTracer(std::string_view method, std::span<const Method> brought);

// Whether makeTracer() makes the same of both settings, so that a tracer and its structure can stay.
bool sameTracer(const gl::Api& api, const Settings& a, const Settings& b, std::span<const Method> brought);

}  // namespace halfsilver
