#include "passes/shadows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "gl/draw_state.h"
#include "passes/changed_rectangles.h"
#include "passes/light_list.h"
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

void copy(const gl::Api& api, const gl::Texture& from, const gl::Texture& to, const glm::ivec4& rectangle, int layer,
          int layers) {
  api.CopyImageSubData(from.name(), GL_TEXTURE_2D_ARRAY, 0, rectangle.x, rectangle.y, layer, to.name(),
                       GL_TEXTURE_2D_ARRAY, 0, rectangle.x, rectangle.y, layer, rectangle.z, rectangle.w, layers);
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

int ShadowPass::resolutionOf(const ShadowSettings& settings) const {
  return std::min<int>(settings.resolution, api_->limits.framebufferSize);
}

std::vector<std::string> ShadowPass::run(const GpuScene& scene, std::span<const Light> lights, const Sky& sky,
                                         const ShadowSettings& settings, const ShadowBoxes& boxes,
                                         const ShadowChange& change, ShadowMaps& out, gl::Profiler& profiler) const {
  const auto section = profiler.section("shadow");
  LightListLimits limits;
  limits.resolution = resolutionOf(settings);
  limits.skyDirections = settings.skyDirections;
  limits.mapsOfLights = settings.method != ShadowMethod::rays;
  const std::size_t layerBytes =
      sizeof(float) * static_cast<std::size_t>(limits.resolution) * static_cast<std::size_t>(limits.resolution);
  limits.layers = std::min<int>(api_->limits.arrayLayers, static_cast<int>(kMaxBytes / layerBytes));
  LightList list = makeLightList(scene.extents.bounds(), lights, sky, limits, boxes);
  if (limits.resolution < settings.resolution)
    list.warnings.push_back("shadow maps: the device draws at most " + std::to_string(limits.resolution) +
                            " texels along a side");

  out.lights = gl::makeTexelBuffer<shared::GpuLight>(*api_, list.lights, "lights");
  out.ranges = list.ranges;
  std::vector<ShadowView> drawn = std::exchange(out.views, {});  // until all are drawn, the maps hold none
  if (out.casters != scene.casters) {
    drawn.clear();
    out.still = {};  // what is known of moves started over with the casters
    out.startsFollowed = 0;
  }
  out.casters = scene.casters;
  // Something must be bound, even if nothing casts a shadow.
  const int resolution = list.layers > 0 ? limits.resolution : 1;
  const int layers = std::max(list.layers, 1);
  const gl::Texture::Shape& shape = out.maps.shape();
  if (!out.maps || shape.width != resolution || shape.depth != layers) {
    out.maps = {};
    out.still = {};  // as many texels and layers
    out.maps = makeMaps(*api_, resolution, layers);
    drawn.clear();
  }

  follow(scene, list.views, change, drawn, out);
  out.views = std::move(list.views);
  // The maps (depth) are fetched by shading; GL orders rendering before later fetches.
  return list.warnings;
}

void ShadowPass::follow(const GpuScene& scene, std::span<const ShadowView> views, const ShadowChange& change,
                        std::span<const ShadowView> drawn, ShadowMaps& out) const {
  // The views with what is out of date once something has changed in the boxes.
  const auto outdated = [&](std::span<const Bounds> boxes) {
    std::vector<Outdated> parts;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const bool known = !change.everything && i < drawn.size() && drawn[i] == views[i];
      parts.push_back({&views[i], known ? changedRectangles(views[i], boxes) : std::vector{views[i].rectangle}});
    }
    std::erase_if(parts, [](const Outdated& part) { return part.rectangles.empty(); });
    return parts;
  };
  const std::vector<Outdated> parts = outdated(change.moved);
  out.viewsDrawn = parts.size();
  out.trianglesDrawn = 0;
  const gl::Framebuffer framebuffer(*api_);
  const std::span<const Bounds> started = scene.clusters.started();
  if (started.empty() || 2 * out.maps.bytes() > kMaxBytes) {
    out.still = {};
    for (const Outdated& part : parts) redraw(scene, part, Casters::all, framebuffer, out.maps, out);
    return;
  }
  const gl::Texture::Shape& shape = out.maps.shape();
  if (!out.still) {
    out.still = makeMaps(*api_, shape.width, shape.depth);
    copy(*api_, out.maps, out.still, {0, 0, shape.width, shape.height}, 0, shape.depth);
    out.startsFollowed = 0;
  }
  for (const Outdated& part : outdated(started.subspan(out.startsFollowed)))
    redraw(scene, part, Casters::still, framebuffer, out.still, out);
  out.startsFollowed = started.size();
  // All copies at once: a software rasterizer ends its drawing for each that comes between.
  for (const auto& [view, rectangles] : parts)
    for (const glm::ivec4& rectangle : rectangles) copy(*api_, out.still, out.maps, rectangle, view->layer, 1);
  for (const Outdated& part : parts) addMoving(scene, part, framebuffer, out);
}

// Clears and draws the rectangles alone: their texels become what they are when all of the view is drawn.
void ShadowPass::redraw(const GpuScene& scene, const Outdated& part, Casters casters,
                        const gl::Framebuffer& framebuffer, const gl::Texture& maps, ShadowMaps& out) const {
  begin(*part.view, framebuffer, maps);
  api_->Enable(GL_SCISSOR_TEST);
  for (const glm::ivec4& rectangle : part.rectangles) {
    api_->Scissor(rectangle.x, rectangle.y, rectangle.z, rectangle.w);
    const float farthest = 1;
    api_->ClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &farthest);
    const Frustum frustum(clipTo(*part.view, rectangle));
    draw(scene, *part.view, visibleRuns(scene.clusters.all(), casters, {&frustum, 1}), out);
  }
  api_->Disable(GL_SCISSOR_TEST);
}

// The rest of the casters, into rectangles that hold what is still. What they cover beside them is there already, and
// stays: depth knows no order.
void ShadowPass::addMoving(const GpuScene& scene, const Outdated& part, const gl::Framebuffer& framebuffer,
                           ShadowMaps& out) const {
  std::vector<Frustum> frusta;
  for (const glm::ivec4& rectangle : part.rectangles) frusta.emplace_back(clipTo(*part.view, rectangle));
  const VisibleRuns runs = visibleRuns(scene.clusters.all(), Casters::moving, frusta);
  if (runs.opaque.firsts.empty() && runs.cut.firsts.empty()) return;
  begin(*part.view, framebuffer, out.maps);
  draw(scene, *part.view, runs, out);
}

void ShadowPass::begin(const ShadowView& view, const gl::Framebuffer& framebuffer, const gl::Texture& maps) const {
  framebuffer.attachLayer(GL_DEPTH_ATTACHMENT, maps, view.layer);
  framebuffer.bind();
  vertexArray_.bind();
  const gl::DrawState state{.viewport = view.rectangle, .depthTest = true, .depthWrite = true, .colorWrite = false};
  state.apply(*api_);
}

void ShadowPass::draw(const GpuScene& scene, const ShadowView& view, const VisibleRuns& runs, ShadowMaps& out) const {
  drawOpaque(scene, view, runs.opaque);
  drawCut(scene, view, runs.cut);
  out.trianglesDrawn += runs.opaque.triangles + runs.cut.triangles;
}

// Vertices that triangles share are transformed once.
void ShadowPass::drawOpaque(const GpuScene& scene, const ShadowView& view, const VertexRuns& runs) const {
  if (runs.firsts.empty()) return;
  std::vector<const void*> offsets;  // into the bound indices, as GL wants them
  for (const std::int32_t first : runs.firsts)
    // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset
    offsets.push_back(reinterpret_cast<const void*>(sizeof(GLuint) * static_cast<std::uintptr_t>(first)));
  opaque_.use();
  opaque_.set("worldToClip", view.worldToClip);
  scene.bindTriangles();
  api_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, scene.indices.name());
  api_->MultiDrawElements(GL_TRIANGLES, runs.counts.data(), GL_UNSIGNED_INT, offsets.data(),
                          static_cast<GLsizei>(runs.counts.size()));
}

void ShadowPass::drawCut(const GpuScene& scene, const ShadowView& view, const VertexRuns& runs) const {
  if (runs.firsts.empty()) return;
  cut_.use();
  cut_.set("worldToClip", view.worldToClip);
  scene.bindSurfaces();
  scene.drawList.bindStorage(SSBO_DRAW_LIST);
  api_->MultiDrawArrays(GL_TRIANGLES, runs.firsts.data(), runs.counts.data(), static_cast<GLsizei>(runs.counts.size()));
}

}  // namespace halfsilver
