#include "tracing/identity/identity_tracer.h"

#include <vector>

#include "shared/tracing.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::uint64_t kEntryBytes = 8;

gl::Program buildProgram(const gl::Api& api, const Settings& settings) {
  return gl::Program::raster(api, "tracing/identity_build.vert", "tracing/identity_build.frag",
                             pageDefines(settings.abuffer.pageSize));
}

TracePass makeTracePass(const gl::Api& api, const Settings& settings) {
  std::vector<gl::Define> defines = pageDefines(settings.abuffer.pageSize);
  defines.push_back({"METHOD_IDENTITY"});
  return TracePass(api, settings.trace.stage, defines);
}

}  // namespace

// Only conservative voxels hold every triangle, so the other rasters of VoxelRaster are not offered here.
IdentityTracer::IdentityTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      voxelResolution_(settings.voxels.resolution),
      bufferResolution_(settings.abuffer.resolution),
      slabs_(settings.abuffer.slabs),
      ownAxis_(settings.voxels.axis == AxisRule::own),
      voxelPass_(api, VoxelRaster::conservative, settings.voxels.axis),
      build_(buildProgram(api, settings)),
      tracePass_(makeTracePass(api, settings)),
      vertexArray_(api),
      pool_(api, settings.abuffer.pageSize) {}

void IdentityTracer::build(const GpuScene& scene, const RayQueue&, gl::Profiler& profiler) {
  grid_ = makeGrid(scene.bounds, voxelResolution_, bufferResolution_, slabs_);
  voxelPass_.run(scene, grid_, voxels_, profiler);

  const auto scope = profiler.section("build");
  const auto side = static_cast<std::size_t>(bufferResolution_);
  const auto mostEntries = static_cast<std::uint64_t>(api_->limits.storageBlockBytes) / kEntryBytes;
  pool_.begin(3 * side * side * static_cast<std::size_t>(slabs_), 4 * side * side + 8 * scene.triangleCount,
              mostEntries);
  if (entries_.bytes() != pool_.capacity() * kEntryBytes) {
    entries_ = gl::Buffer();  // the old one goes first: both at once might not fit
    entries_ = gl::Buffer(*api_, pool_.capacity() * kEntryBytes, "A-buffer entries");
  }
  // Clears of heads and counters come before the fragments' atomics.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  grid_.apply(build_);
  build_.set("ownAxis", ownAxis_ ? 1 : 0);
  build_.set("rasterResolution", bufferResolution_);
  pool_.bind(build_);
  voxels_.words.bindStorage(SSBO_VOXELS);
  entries_.bindStorage(SSBO_ENTRIES);
  rasterizeScene(*api_, build_, vertexArray_, scene,
                 {.resolution = bufferResolution_, .projections = ownAxis_ ? 1 : 3, .verticesPerTriangle = 6});
  // Entries, heads and links (fragments) are read by the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void IdentityTracer::trace(const GpuScene&, const RayQueue& rays, Hits& hits, gl::Profiler& profiler) {
  grid_.apply(tracePass_.program());
  pool_.bind(tracePass_.program());
  voxels_.words.bindStorage(SSBO_VOXELS);
  entries_.bindStorage(SSBO_ENTRIES);
  tracePass_.run(rays, hits, profiler);
}

TracerMemory IdentityTracer::memory() const {
  TracerMemory memory;
  memory.voxels = voxels_.bytes();
  pool_.report(memory, kEntryBytes);
  return memory;
}

std::uint64_t IdentityTracer::lostFragments() const { return pool_.count(COUNTER_LOST); }

}  // namespace halfsilver
