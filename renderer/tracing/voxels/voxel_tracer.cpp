#include "tracing/voxels/voxel_tracer.h"

#include <algorithm>
#include <utility>

#include "shared/bindings.h"
#include "shared/passes/voxelize.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace shared {

#include "shared/passes/voxels.h"

static_assert(sizeof(VoxelSurface) == 8);

}  // namespace shared

Method VoxelTracer::method() {
  return {{.name = "voxels",
           .help = "voxels alone, hit where a ray enters one (Hu et al. 2014, figure 9)",
           .settings = {"voxels.resolution", "voxels.raster", "abuffer.resolution", "trace.stage", "trace.count_work"},
           .fixedResolution = true},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<VoxelTracer>(api, settings); }};
}

VoxelTracer::VoxelTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      settings_(settings),
      voxelPass_(api, settings.voxels.raster, AxisRule::normal, true),
      settle_(gl::Program::compute(api, "tracing/voxels/settle.comp")),
      tracePass_(api, settings.trace, "tracing/voxels") {}

void VoxelTracer::update(const FrameView& view, const SceneChange& change) {
  if (built_ && !change.geometry() && !change.materials) return;
  built_ = false;  // until nothing has failed
  grid_ = makeGrid(view.scene.extents.bounds(), resolutionOf(settings_.voxels, settings_.abuffer),
                   settings_.abuffer.resolution);
  Voxels voxels;
  voxels.triangles = std::move(triangles_);
  voxelPass_.run(view.scene, view.profiler, grid_, voxels);
  transient_ = voxelPass_.transientBytes() + voxels.bytes() - voxels.triangles.bytes();

  const auto scope = view.profiler.section("build");
  const std::size_t bytes = grid_.voxelCount() * sizeof(shared::VoxelSurface);
  if (surfaces_.bytes() != bytes) {
    surfaces_ = gl::Buffer();  // the old one goes first: both at once might not fit
    surfaces_ = gl::Buffer(*api_, bytes, "surfaces of voxels");
  }
  grid_.apply(settle_);
  settle_.set("count", static_cast<GLuint>(grid_.voxelCount()));
  const glm::vec3 side = grid_.extent / glm::vec3(grid_.voxels);
  settle_.set("voxelSize", std::max({side.x, side.y, side.z}));
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  voxels.bind();
  surfaces_.bindStorage(SSBO_SETTLED);
  dispatchFor(*api_, settle_, grid_.voxelCount());
  // Surfaces (this dispatch) are read by the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  triangles_ = std::move(voxels.triangles);
  built_ = true;
}

void VoxelTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  grid_.apply(tracePass_.program());
  tracePass_.run(view, rays, hits, {[this] {
                   triangles_.bindStorage(SSBO_VOXEL_TRIANGLES);
                   surfaces_.bindStorage(SSBO_VOXEL_SURFACES);
                 }});
}

TracerMemory VoxelTracer::memory() const {
  TracerMemory memory;
  memory.grid = grid_.voxels;
  memory.voxels = triangles_.bytes() + surfaces_.bytes();
  memory.structureTotal = memory.voxels;
  memory.transient = std::max(transient_, tracePass_.bytes());
  return memory;
}

}  // namespace halfsilver
