#include "tracing/listed_triangles.h"

#include <algorithm>
#include <cstddef>

#include <halfsilver/shared_structs.h>
#include "tracing/raster.h"

namespace halfsilver {
namespace shared {

#include "shared/passes/listed_triangles.h"

static_assert(offsetof(ListedTriangles, largeVertices) == 0);  // an indirect draw begins here
static_assert(offsetof(ListedTriangles, projections) == 4);
static_assert(offsetof(ListedTriangles, firstVertex) == 8);
static_assert(offsetof(ListedTriangles, firstInstance) == 12);
static_assert(offsetof(ListedTriangles, smallGroupsX) == 16);  // an indirect dispatch begins here
static_assert(offsetof(ListedTriangles, smallGroupsY) == 20);
static_assert(offsetof(ListedTriangles, smallGroupsZ) == 24);
static_assert(offsetof(ListedTriangles, smallCount) == 28);
static_assert(offsetof(ListedTriangles, pairedCount) == 32);
static_assert(sizeof(ListedTriangles) == 36);

}  // namespace shared

void ListedTriangles::begin(const GpuScene& scene, bool ownAxis) {
  const std::size_t bytes = sizeof(shared::ListedTriangles) + std::max(1u, scene.triangleCount) * sizeof(GLuint);
  if (list_.bytes() != bytes) {
    list_ = gl::Buffer();  // the old one goes first: both at once might not fit
    list_ = gl::Buffer(*api_, bytes, "listed triangles");
  }
  // The list before (shaders) comes before this one's header.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  shared::ListedTriangles none{};
  none.projections = ownAxis ? 1 : 3;
  none.smallGroupsY = none.smallGroupsZ = 1;
  list_.write(0, &none, sizeof(none));
}

void ListedTriangles::bind() const { list_.bindStorage(SSBO_LISTED_TRIANGLES); }

void ListedTriangles::choose(const gl::Program& program, const GpuScene& scene, std::size_t invocations) const {
  program.set("triangleCount", scene.triangleCount);
  bind();
  scene.bindTriangles();
  dispatchFor(*api_, program, invocations);
  // The list and its arguments (this dispatch) are read by what goes over it.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void ListedTriangles::visit(const gl::Program& small, const gl::Program& large, int resolution) const {
  bind();
  small.use();
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list_.name());
  api_->DispatchComputeIndirect(offsetof(shared::ListedTriangles, smallGroupsX));
  rasterizeLarge(large, resolution);
}

void ListedTriangles::rasterizeLarge(const gl::Program& large, int resolution) const {
  bind();
  large.set("rasterResolution", resolution);
  rasterizeListed(*api_, large, vertexArray_, resolution, list_);
}

}  // namespace halfsilver
