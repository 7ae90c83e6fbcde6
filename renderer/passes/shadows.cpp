#include "passes/shadows.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "gl/draw_state.h"
#include "passes/light_list.h"
#include "passes/view_culling.h"
#include "shared/passes/shadow.h"

namespace halfsilver {
namespace {

// Of all shadow maps together.
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

gl::Program makeProgram(const gl::Api& api, bool cut) {
  std::vector<gl::Define> defines;
  if (cut) defines.push_back({"CUT"});
  return gl::Program::raster(api, "passes/shadow.vert", "passes/shadow.frag", defines);
}

gl::Texture makeMaps(const gl::Api& api, int resolution, int layers) {
  gl::Texture maps(api,
                   {.target = GL_TEXTURE_2D_ARRAY,
                    .format = GL_DEPTH_COMPONENT32F,
                    .width = resolution,
                    .height = resolution,
                    .depth = layers},
                   "shadow maps");
  maps.parameter(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  maps.parameter(GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  maps.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  maps.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return maps;
}

bool mustDraw(const ShadowView& view, std::size_t number, const ShadowChange& change,
              std::span<const ShadowView> drawn) {
  if (change.everything || number >= drawn.size() || drawn[number] != view) return true;
  const Frustum frustum(view.worldToClip);
  return std::any_of(change.moved.begin(), change.moved.end(),
                     [&](const Bounds& bounds) { return frustum.mayTouch(bounds); });
}

}  // namespace

void ShadowChange::add(std::span<const Bounds> boxes) {
  moved.insert(moved.end(), boxes.begin(), boxes.end());
  if (moved.size() <= kMaxMoved) return;
  Bounds all;
  for (const Bounds& box : moved) {
    if (box.empty()) continue;
    all.add(box.low);
    all.add(box.high);
  }
  moved.assign(1, all);
}

ShadowPass::ShadowPass(const gl::Api& api)
    : api_(&api), opaque_(makeProgram(api, false)), cut_(makeProgram(api, true)), vertexArray_(api) {}

std::vector<std::string> ShadowPass::run(const GpuScene& scene, std::span<const Light> lights, const Sky& sky,
                                         const Settings& settings, const ShadowChange& change, ShadowMaps& out,
                                         gl::Profiler& profiler) const {
  const auto section = profiler.section("shadow");
  LightListLimits limits;
  limits.resolution = std::min<int>(settings.shadow.resolution, api_->limits.framebufferSize);
  limits.skyDirections = settings.shadow.skyDirections;
  const std::size_t layerBytes =
      sizeof(float) * static_cast<std::size_t>(limits.resolution) * static_cast<std::size_t>(limits.resolution);
  limits.layers = std::min<int>(api_->limits.arrayLayers, static_cast<int>(kMaxBytes / layerBytes));
  LightList list = makeLightList(scene.extents.bounds(), lights, sky, limits);
  if (limits.resolution < settings.shadow.resolution)
    list.warnings.push_back("shadow maps: the device draws at most " + std::to_string(limits.resolution) +
                            " texels along a side");

  out.lights = gl::makeTexelBuffer<shared::GpuLight>(*api_, list.lights, "lights");
  out.ranges = list.ranges;
  std::vector<ShadowView> drawn = std::exchange(out.views, {});  // until all are drawn, the maps hold none
  // Something must be bound, even if nothing casts a shadow.
  const int resolution = list.layers > 0 ? limits.resolution : 1;
  const int layers = std::max(list.layers, 1);
  const gl::Texture::Shape& shape = out.maps.shape();
  if (!out.maps || shape.width != resolution || shape.depth != layers) {
    out.maps = {};
    out.maps = makeMaps(*api_, resolution, layers);
    drawn.clear();
  }

  const gl::Framebuffer framebuffer(*api_);
  out.viewsDrawn = out.trianglesDrawn = 0;
  for (std::size_t i = 0; i < list.views.size(); ++i)
    if (mustDraw(list.views[i], i, change, drawn)) draw(scene, list.views[i], framebuffer, out);
  out.views = std::move(list.views);
  // The maps (depth) are fetched by shading; GL orders rendering before later fetches.
  return list.warnings;
}

void ShadowPass::draw(const GpuScene& scene, const ShadowView& view, const gl::Framebuffer& framebuffer,
                      ShadowMaps& out) const {
  framebuffer.attachLayer(GL_DEPTH_ATTACHMENT, out.maps, view.layer);
  framebuffer.bind();
  vertexArray_.bind();
  const gl::DrawState state{.viewport = view.rectangle, .depthTest = true, .depthWrite = true, .colorWrite = false};
  state.apply(*api_);
  // Other views share the layer.
  api_->Enable(GL_SCISSOR_TEST);
  api_->Scissor(view.rectangle.x, view.rectangle.y, view.rectangle.z, view.rectangle.w);
  const float farthest = 1;
  api_->ClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &farthest);
  api_->Disable(GL_SCISSOR_TEST);
  drawOpaque(scene, view, out);
  drawCut(scene, view, out);
  ++out.viewsDrawn;
}

// Vertices that triangles share are transformed once.
void ShadowPass::drawOpaque(const GpuScene& scene, const ShadowView& view, ShadowMaps& out) const {
  const VertexRuns runs = visibleRuns(scene.clusters.all(), Frustum(view.worldToClip), false);
  if (runs.firsts.empty()) return;
  std::vector<const void*> offsets;  // into the bound indices, as GL wants them
  for (const std::int32_t first : runs.firsts)
    offsets.push_back(static_cast<const char*>(nullptr) + sizeof(GLuint) * static_cast<std::size_t>(first));
  opaque_.use();
  opaque_.set("worldToClip", view.worldToClip);
  scene.bindTriangles();
  api_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, scene.indices.name());
  api_->MultiDrawElements(GL_TRIANGLES, runs.counts.data(), GL_UNSIGNED_INT, offsets.data(),
                          static_cast<GLsizei>(runs.counts.size()));
  out.trianglesDrawn += runs.triangles;
}

void ShadowPass::drawCut(const GpuScene& scene, const ShadowView& view, ShadowMaps& out) const {
  const VertexRuns runs = visibleRuns(scene.clusters.all(), Frustum(view.worldToClip), true);
  if (runs.firsts.empty()) return;
  cut_.use();
  cut_.set("worldToClip", view.worldToClip);
  scene.bindSurfaces();
  scene.drawList.bindStorage(SSBO_DRAW_LIST);
  api_->MultiDrawArrays(GL_TRIANGLES, runs.firsts.data(), runs.counts.data(), static_cast<GLsizei>(runs.counts.size()));
  out.trianglesDrawn += runs.triangles;
}

}  // namespace halfsilver
