#include "tracing/depth_cube/depth_cube.h"

#include <algorithm>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include "gl/draw_state.h"
#include "shared/passes/build_counters.h"
#include "shared/passes/depth_cube.h"
#include "shared/passes/gbuffer.h"
#include "shared/tracing.h"
#include "tracing/raster.h"
#include "tracing/resize.h"

namespace halfsilver {
namespace {

constexpr int kAxes = 3;
constexpr int kTile = 8;  // of store_surfaces.comp

std::size_t texelCount(int texels) {
  return kAxes * static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels);
}

int blocksAlong(int texels, int block) { return (texels + block - 1) / block; }

}  // namespace

DepthCube::DrawPrograms::DrawPrograms(const gl::Api& api, const std::string& fragment) {
  const gl::Define cutting[] = {{"CUT"}};
  const std::string folder = "tracing/depth_cube/";
  opaque = gl::Program::raster(api, folder + "draw.vert", folder + fragment);
  cut = gl::Program::raster(api, folder + "draw.vert", folder + fragment, cutting);
}

DepthCube::DepthCube(const gl::Api& api, const Settings& settings)
    : api_(&api),
      settings_(settings.depthCube),
      texels_(settings.abuffer.resolution),
      maxLayers_(std::min<int>(settings.depthCube.layers, api.limits.arrayLayers)),
      count_(api, "count.frag"),
      deepestCount_(gl::Program::compute(api, "tracing/depth_cube/deepest.comp")),
      peel_(api, "peel.frag"),
      storeSurfaces_(gl::Program::compute(api, "tracing/depth_cube/store_surfaces.comp")),
      boundBlocks_(gl::Program::compute(api, "tracing/depth_cube/bound_blocks.comp")),
      vertexArray_(api),
      counters_(api),
      read_(api) {}

gl::Texture DepthCube::makeImage(GLenum format, int layers, const char* label) const {
  return {*api_, {GL_TEXTURE_2D_ARRAY, format, kAxes * texels_, texels_, layers, 1}, label};
}

void DepthCube::apply(const gl::Program& program) const {
  program.set("blockSize", settings_.block);
  program.set("layerCount", layers_);
  program.set("samplesLost", lost() ? 1 : 0);
}

void DepthCube::bind() const {
  depths_.bind(UNIT_CUBE_DEPTHS);
  normals_.bind(UNIT_CUBE_NORMALS);
  triangles_.bind(UNIT_CUBE_TRIANGLES);
  colors_.bind(UNIT_CUBE_COLORS);
  blocks_.bindStorage(SSBO_CUBE_BLOCKS);
  sampleCounts_.bindStorage(SSBO_CUBE_COUNTS);
}

void DepthCube::build(const FrameView& view, const Grid& grid) {
  const int largest = std::min(api_->limits.framebufferSize, api_->limits.textureSize);
  if (kAxes * texels_ > largest)
    throw Error(ErrorKind::failed, "setting abuffer.resolution: three images of " + std::to_string(texels_) +
                                       " texels lie side by side, and the device's are at most " +
                                       std::to_string(largest) + " wide");
  const auto scope = view.profiler.section("build");
  count(view, grid);
  deepest_ = read_.read<GLuint>(counters_.buffer(), COUNTER_DEEPEST);
  allocate(std::clamp<int>(static_cast<int>(deepest_), 1, maxLayers_));
  peel(view, grid);
  storeSurfaces(view, grid);
  boundBlocks(grid);
}

void DepthCube::draw(const DrawPrograms& programs, const FrameView& view, const Grid& grid) const {
  const bool own = settings_.axes == CubeAxes::own;
  vertexArray_.bind();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  view.scene.drawList.bindStorage(SSBO_DRAW_LIST);
  for (const DrawRange& range : view.scene.drawRanges) {
    const gl::Program& program = range.cut ? programs.cut : programs.opaque;
    grid.apply(program);
    program.set("ownAxis", own ? 1 : 0);
    program.use();
    api_->DrawArraysInstanced(GL_TRIANGLES, static_cast<GLint>(3 * range.first), static_cast<GLsizei>(3 * range.count),
                              own ? 1 : kAxes);
  }
}

void DepthCube::count(const FrameView& view, const Grid& grid) {
  resize(*api_, sampleCounts_, texelCount(texels_) * sizeof(GLuint), "samples of texels");
  sampleCounts_.fill(0);
  counters_.clear();
  // Clears come before the fragments' atomics.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  const gl::Framebuffer framebuffer(*api_, kAxes * texels_, texels_);
  framebuffer.bind();
  gl::DrawState{.viewport = {0, 0, kAxes * texels_, texels_}}.apply(*api_);
  sampleCounts_.bindStorage(SSBO_CUBE_COUNTS);
  draw(count_, view, grid);
  // Counts (fragments) are read by the maximum, later by the bounds of blocks and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  grid.apply(deepestCount_);
  deepestCount_.set("maxLayers", static_cast<GLuint>(maxLayers_));
  sampleCounts_.bindStorage(SSBO_CUBE_COUNTS);
  counters_.bind();
  dispatchFor(*api_, deepestCount_, texelCount(texels_));
  // The maximum (compute) is copied for the host.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
}

void DepthCube::allocate(int layers) {
  if (layers == layers_ && depths_) return;
  for (gl::Texture* old : {&depths_, &normals_, &triangles_, &colors_}) *old = {};  // before the new memory comes
  layers_ = layers;
  depths_ = makeImage(settings_.depth == CubeDepth::half ? GL_R16F : GL_R32F, layers, "depths of layers");
  normals_ = makeImage(GL_R32UI, layers, "normals of layers");
  triangles_ = makeImage(GL_R32UI, layers, "triangles of layers");
  colors_ = makeImage(GL_RGBA8, layers, "colors of layers");
  const auto along = static_cast<std::size_t>(blocksAlong(texels_, settings_.block));
  resize(*api_, blocks_, kAxes * along * along * sizeof(glm::vec2), "blocks of layers");
}

void DepthCube::peel(const FrameView& view, const Grid& grid) {
  const gl::Texture::Shape shape{GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, kAxes * texels_, texels_, 1, 1};
  gl::Texture nearest(*api_, shape, "peeled depth"), previous(*api_, shape, "peeled depth before");
  transient_ = nearest.bytes() + previous.bytes();
  const gl::Framebuffer framebuffer(*api_);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  api_->NamedFramebufferDrawBuffers(framebuffer.name(), 2, buffers);
  gl::DrawState{.viewport = {0, 0, kAxes * texels_, texels_}, .depthTest = true, .depthWrite = true}.apply(*api_);
  const GLfloat before = 0, farthest = 1, empty[4] = {CUBE_NO_SAMPLE, 0, 0, 0};
  // Every surface lies behind a first layer before it: the grid is padded.
  framebuffer.attach(GL_DEPTH_ATTACHMENT, previous);
  api_->ClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &before);
  for (int layer = 0; layer < layers_; ++layer) {
    framebuffer.attachLayer(GL_COLOR_ATTACHMENT0, depths_, layer);
    framebuffer.attachLayer(GL_COLOR_ATTACHMENT1, triangles_, layer);
    framebuffer.attach(GL_DEPTH_ATTACHMENT, nearest);
    framebuffer.bind();
    api_->ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, empty);
    api_->ClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &farthest);
    previous.bind(UNIT_CUBE_PREVIOUS);
    draw(peel_, view, grid);
    std::swap(nearest, previous);
  }
  // GL orders this rendering before later fetches.
}

void DepthCube::storeSurfaces(const FrameView& view, const Grid& grid) {
  grid.apply(storeSurfaces_);
  apply(storeSurfaces_);
  storeSurfaces_.set("texelSize", grid.texelSize());
  storeSurfaces_.use();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  depths_.bind(UNIT_CUBE_DEPTHS);
  triangles_.bind(UNIT_CUBE_TRIANGLES);
  normals_.bindImage(IMAGE_CUBE_NORMALS, GL_WRITE_ONLY);
  colors_.bindImage(IMAGE_CUBE_COLORS, GL_WRITE_ONLY);
  const auto groups = [](int texels) { return static_cast<GLuint>((texels + kTile - 1) / kTile); };
  api_->DispatchCompute(groups(kAxes * texels_), groups(texels_), 1);
  // Normals and colors (images) are fetched by the trace.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void DepthCube::boundBlocks(const Grid& grid) {
  grid.apply(boundBlocks_);
  apply(boundBlocks_);
  for (int layer = 0; layer < layers_; ++layer) {
    boundBlocks_.set("layer", layer);
    depths_.bind(UNIT_CUBE_DEPTHS);
    blocks_.bindStorage(SSBO_CUBE_BLOCKS);
    sampleCounts_.bindStorage(SSBO_CUBE_COUNTS);
    dispatchFor(*api_, boundBlocks_, blocks_.bytes() / sizeof(glm::vec2));
    // Ranges (this layer) are widened by the next and read by the trace.
    api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

void DepthCube::report(TracerMemory& memory) const {
  memory.voxels = blocks_.bytes();
  memory.heads = sampleCounts_.bytes();
  memory.poolReserved = depths_.bytes() + normals_.bytes() + triangles_.bytes() + colors_.bytes();
  memory.bytesPerFragment = settings_.depth == CubeDepth::half ? 14 : 16;
  memory.structureTotal = memory.voxels + memory.heads + memory.poolReserved + counters_.bytes();
  memory.transient = transient_;
}

void DepthCube::addCounts(std::span<const std::uint32_t> counters, TracerMemory& memory) {
  addFragmentCounts(counters, memory);
  memory.fragmentsStored = memory.perAxis[0] + memory.perAxis[1] + memory.perAxis[2];
  memory.poolUsed = memory.fragmentsStored * static_cast<std::uint64_t>(memory.bytesPerFragment);
}

}  // namespace halfsilver
