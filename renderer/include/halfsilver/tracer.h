#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>
#include <halfsilver/settings.h>

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
  std::uint64_t structureTotal = 0;  // everything that is kept
  std::uint64_t transient = 0;       // beside it, the most at once during the last frame
};

// A method of tracing rays: one folder under tracing/ each. The interface is all that the rest of the frame knows.
class Tracer {
 public:
  virtual ~Tracer() = default;

  // Makes the structure for this scene; sections "voxelize" and "build" of the profiler. `rays` are those of the
  // first bounce. GpuScene is bound.
  virtual void build(const GpuScene& scene, const RayQueue& rays, gl::Profiler& profiler) = 0;

  // Traces every ray of the queue and writes one hit each; section "trace". The count stays on the GPU. Rays given up
  // get t = HIT_OVERFLOW and are counted in RayCount::overflow. GpuScene and UBO_FRAME are bound.
  virtual void trace(const GpuScene& scene, const RayQueue& rays, Hits& hits, gl::Profiler& profiler) = 0;

  // Whether trace() writes Hits::surfaces.
  virtual bool storesAttributes() const { return false; }

  // Of the last build; waits for the GPU.
  virtual TracerMemory memory() const = 0;
  // Fragments that did not fit into the structure in the last build (0 when complete); waits for the GPU.
  virtual std::uint64_t lostFragments() const { return 0; }
};

using TracerFactory = std::function<std::unique_ptr<Tracer>(const gl::Api&, const Settings&)>;

// The only switch over methods. Null for Method::none. `exact` makes the tracer of Method::exact and may be empty:
// then asking for that method throws Error (usage), and Method::automatic is identity.
std::unique_ptr<Tracer> makeTracer(const gl::Api& api, const Settings& settings, const TracerFactory& exact);

}  // namespace halfsilver
