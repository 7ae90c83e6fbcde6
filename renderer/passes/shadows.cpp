#include "passes/shadows.h"

#include <algorithm>
#include <cstddef>

#include "gl/draw_state.h"
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

}  // namespace

ShadowPass::ShadowPass(const gl::Api& api)
    : api_(&api), opaque_(makeProgram(api, false)), cut_(makeProgram(api, true)), vertexArray_(api) {}

std::vector<std::string> ShadowPass::run(const GpuScene& scene, std::span<const Light> lights, const Sky& sky,
                                         const Settings& settings, ShadowMaps& out, gl::Profiler& profiler) const {
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
  // Something must be bound, even if nothing casts a shadow.
  const int resolution = list.layers > 0 ? limits.resolution : 1;
  const int layers = std::max(list.layers, 1);
  const gl::Texture::Shape& shape = out.maps.shape();
  if (!out.maps || shape.width != resolution || shape.depth != layers) {
    out.maps = {};
    out.maps = makeMaps(*api_, resolution, layers);
  }

  const gl::Framebuffer framebuffer(*api_);
  gl::DrawState state{
      .viewport = {0, 0, resolution, resolution}, .depthTest = true, .depthWrite = true, .colorWrite = false};
  state.apply(*api_);
  for (int layer = 0; layer < layers; ++layer) {
    framebuffer.attachLayer(GL_DEPTH_ATTACHMENT, out.maps, layer);
    const float farthest = 1;
    api_->ClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &farthest);
  }
  framebuffer.bind();
  vertexArray_.bind();
  scene.bindSurfaces();
  scene.drawList.bindStorage(SSBO_DRAW_LIST);
  for (const bool cut : {false, true}) {
    const gl::Program& program = cut ? cut_ : opaque_;
    program.use();
    for (const ShadowView& view : list.views) {
      framebuffer.attachLayer(GL_DEPTH_ATTACHMENT, out.maps, view.layer);
      state.viewport = view.rectangle;
      state.apply(*api_);
      program.set("worldToClip", view.worldToClip);
      for (const DrawRange& range : scene.drawRanges)
        if (range.cut == cut && range.count > 0)
          api_->DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.first), static_cast<GLsizei>(3 * range.count));
    }
  }
  // The maps (depth) are fetched by shading; GL orders rendering before later fetches.
  return list.warnings;
}

}  // namespace halfsilver
