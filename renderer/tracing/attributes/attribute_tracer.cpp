#include "tracing/attributes/attribute_tracer.h"

#include <algorithm>
#include <string>
#include <vector>

#include <halfsilver/error.h>
#include "shared/passes/attributes.h"
#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

constexpr std::uint64_t kEntryTexels = 2;
constexpr std::uint64_t kEntryBytes = 16 * kEntryTexels;
// The entry keeps the triangle's number as a float's value.
constexpr std::uint32_t kMaxTriangles = 1u << 24;

// A linked list is a list of pages of one entry.
int pageSize(const Settings& settings) {
  return settings.attributes.lists == Lists::linked ? 1 : settings.attributes.pageSize;
}

gl::Program buildProgram(const gl::Api& api, const Settings& settings) {
  const std::vector<gl::Define> defines = pageDefines(pageSize(settings));
  return gl::Program::raster(api, "tracing/attributes/build.vert", "tracing/attributes/build.frag", defines);
}

TracePass makeTracePass(const gl::Api& api, const Settings& settings) {
  std::vector<gl::Define> defines = pageDefines(pageSize(settings));
  defines.push_back({"LINEAR_STEPS", std::to_string(settings.attributes.steps)});
  if (settings.attributes.sorted) defines.push_back({"SORTED"});
  if (settings.attributes.test == InsideTest::depth) defines.push_back({"DEPTH_TEST"});
  return TracePass(api, settings.trace, "tracing/attributes", std::move(defines));
}

const Settings& checked(const Settings& settings) {
  if (settings.attributes.sorted && settings.attributes.lists != Lists::linked)
    throw Error(ErrorKind::badInput, "setting abuffer.sorted: only linked lists can be sorted (abuffer.lists=linked)");
  return settings;
}

}  // namespace

Method AttributeTracer::method() {
  return {
      {.name = "attributes",
       .help = "fragments with all surface attributes (Hu et al. 2014; Kastrati & Goswami 2017)",
       .settings = {"voxels.resolution", "voxels.raster", "voxels.axis", "abuffer.resolution", "abuffer.page_size",
                    "abuffer.buffers", "abuffer.lists", "abuffer.sorted", "search.steps", "search.refinements",
                    "search.any_hit_refinements", "search.test", "trace.stage", "trace.count_work"},
       .fixedResolution = true,
       .preset = "kastrati2017",
       .knobs = {{"search.steps", {"1", "3", "0"}},
                 {"voxels.resolution", {"64", "128", "256"}},
                 {"abuffer.resolution", {"256", "512", "1024", "2048"}}}},
      [](const gl::Api& api, const Settings& settings) { return std::make_unique<AttributeTracer>(api, settings); }};
}

AttributeTracer::AttributeTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      settings_(checked(settings)),
      voxelPass_(api, settings.voxels.raster, settings.voxels.axis),
      build_(buildProgram(api, settings)),
      tracePass_(makeTracePass(api, settings)),
      vertexArray_(api),
      pool_(api, pageSize(settings)) {
  if (settings.attributes.sorted) sort_ = gl::Program::compute(api, "tracing/attributes/sort.comp", pageDefines(1));
}

void AttributeTracer::update(const FrameView& view, const SceneChange&) {
  const GpuScene& scene = view.scene;
  if (scene.triangleCount > kMaxTriangles)
    throw Error(ErrorKind::failed, "the scene has " + std::to_string(scene.triangleCount) +
                                       " triangles; fragments with attributes can name " +
                                       std::to_string(kMaxTriangles));
  grid_ =
      makeGrid(scene.extents.bounds(), resolutionOf(settings_.voxels, settings_.abuffer), settings_.abuffer.resolution);
  voxelPass_.run(scene, view.profiler, grid_, voxels_);

  const auto scope = view.profiler.section("build");
  const bool three = settings_.attributes.buffers == Buffers::three;
  const auto side = static_cast<std::size_t>(grid_.texels);
  const auto maxEntries = static_cast<std::uint64_t>(api_->limits.bufferTexels) / kEntryTexels;
  pool_.begin(3 * side * side, (three ? 4 : 2) * side * side, maxEntries);
  if (entries_.bytes() != pool_.capacity() * kEntryBytes) {
    entries_ = gl::TexelBuffer();  // the old one goes first: both at once might not fit
    entries_ = gl::TexelBuffer(*api_, pool_.capacity() * kEntryTexels, "A-buffer entries");
  }
  // Clears of heads and counters come before the fragments' atomics.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  // Masks of own axes need only the own projection; a dominant axis of the voxel may be any of the three.
  const bool own = !three && settings_.voxels.axis == AxisRule::own;
  grid_.apply(build_);
  build_.set("ownAxis", own ? 1 : 0);
  build_.set("rasterResolution", grid_.texels);
  build_.set("storeAll", three ? 1 : 0);
  build_.set("texelSize", grid_.texelSize());
  build_.set("pageCapacity", pool_.pages());
  view.constants.bindUniform(UBO_FRAME);
  scene.bindSurfaces();
  pool_.counters().bind();
  voxels_.words.bindStorage(SSBO_VOXELS);
  pool_.bind();
  entries_.bindImage(IMAGE_ENTRIES, GL_WRITE_ONLY);
  rasterizeScene(*api_, build_, vertexArray_, scene, {.resolution = grid_.texels, .projections = own ? 1 : 3});
  // Entries (image stores), heads and links (fragments) are read by the sort and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  if (sort_) sortLists();
}

void AttributeTracer::sortLists() {
  const auto heads = static_cast<std::size_t>(pool_.headBytes() / sizeof(GLuint));
  sort_.set("headCount", static_cast<GLuint>(heads));
  for (GLuint run = 1; run < (1u << 24); run *= 2) {
    pool_.counters().clear(COUNTER_UNSORTED);
    sort_.set("runLength", run);
    pool_.counters().bind();
    pool_.bind();
    entries_.bindImage(IMAGE_ENTRIES, GL_READ_ONLY);
    dispatchFor(*api_, sort_, heads);
    // Links (this step) are read by the next step and the trace.
    api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    if (pool_.counters().sum(COUNTER_UNSORTED) == 0) break;
  }
}

void AttributeTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  search(view, rays, hits, settings_.attributes.refinements);
}

void AttributeTracer::occluded(const FrameView& view, const RayQueue& rays, Hits& hits) {
  search(view, rays, hits, settings_.attributes.anyHitRefinements);
}

void AttributeTracer::search(const FrameView& view, const RayQueue& rays, const Hits& hits, int refinements) {
  grid_.apply(tracePass_.program());
  tracePass_.program().set("refinements", refinements);
  tracePass_.run(view, rays, hits, {[this] {
                   voxels_.words.bindStorage(SSBO_VOXELS);
                   pool_.bind();
                   entries_.bindImage(IMAGE_ENTRIES, GL_READ_ONLY);
                 }});
}

TracerMemory AttributeTracer::memory() const {
  TracerMemory memory;
  memory.voxels = voxels_.bytes();
  memory.grid = grid_.voxels;
  memory.transient = std::max<std::uint64_t>(tracePass_.bytes(), voxelPass_.transientBytes());
  pool_.report(memory, kEntryBytes);
  return memory;
}

StructureCells AttributeTracer::cells() const {
  StructureCells cells;
  if (!voxels_.words) return cells;
  const std::vector<GLuint> words = voxels_.words.read<GLuint>(voxels_.words.bytes() / sizeof(GLuint));
  for (std::size_t i = 0; i < grid_.voxelCount(); ++i)
    if ((words[i / VOXELS_PER_WORD] >> (VOXEL_BITS * (i % VOXELS_PER_WORD)) & 7u) != 0)
      cells.voxels.push_back({grid_.boundsOf(grid_.voxelAt(i)), 0});
  return cells;
}

}  // namespace halfsilver
