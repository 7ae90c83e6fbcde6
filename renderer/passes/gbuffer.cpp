#include "passes/gbuffer.h"

#include <utility>
#include <vector>

#include "gl/draw_state.h"
#include "shared/passes/gbuffer.h"

namespace halfsilver {
namespace {

constexpr int kTile = 8;

GBuffer allocate(const gl::Api& api, int width, int height) {
  const auto texture = [&](GLenum format, const char* label) {
    return gl::Texture(api, {GL_TEXTURE_2D, format, width, height, 1, 1}, label);
  };
  GBuffer buffer;
  buffer.width = width;
  buffer.height = height;
  buffer.depth = texture(GL_DEPTH_COMPONENT32F, "depth");
  buffer.visibility = texture(GL_R32UI, "visibility");
  buffer.normal = texture(GL_RG32UI, "normal");
  buffer.material = texture(GL_RGBA16F, "material");
  buffer.shaded = texture(GL_RGBA32F, "shaded");
  buffer.reflection = texture(GL_RGBA32F, "reflection");
  buffer.signature = gl::Buffer(api, sizeof(buffer.number), "signature");
  return buffer;
}

// Whether a pixel may show anything else than what rasterization found there.
bool hasRules(const PrimarySettings& primary) { return primary.hits == PrimaryHits::tested || primary.every > 1; }

}  // namespace

GBufferPass::GBufferPass(const gl::Api& api)
    : api_(&api),
      opaque_(gl::Program::raster(api, "passes/visibility.vert", "passes/visibility.frag")),
      framebuffer_(api),
      vertexArray_(api) {
  const gl::Define cut[] = {{"ALPHA_TEST"}};
  resolve_[0].emplace(api, "passes/gbuffer.comp");
  cut_ = gl::Program::raster(api, "passes/visibility.vert", "passes/visibility.frag", cut);
}

void GBufferPass::run(const FrameView& view, GBuffer& out, const PrimarySettings& primary) {
  const auto width = static_cast<int>(view.frame.width), height = static_cast<int>(view.frame.height);
  if (out.width != width || out.height != height) {
    out = GBuffer{};  // the old memory goes before the new comes
    out = allocate(*api_, width, height);
  }
  const auto keepIf = [&](bool wanted, GLenum format, const char* label, gl::Texture& texture) {
    if (!wanted)
      texture = gl::Texture();
    else if (!texture)
      texture = gl::Texture(*api_, {GL_TEXTURE_2D, format, width, height, 1, 1}, label);
  };
  keepIf(view.scene.lobes, GL_RGBA32UI, "sheen and anisotropy", out.lobes);
  keepIf(view.frame.coats != 0, GL_RGBA32F, "coats", out.coat);
  keepIf(view.frame.glossySamples != 0, GL_RGBA32F, "seen by rough surfaces", out.seen);
  keepIf(view.frame.glossySamples != 0, GL_R16F, "occlusion", out.occlusion);
  const auto section = view.profiler.section("gbuffer");
  rasterize(view, out);
  resolve(view, out, primary);
}

void GBufferPass::rasterize(const FrameView& view, const GBuffer& out) const {
  const gl::Api& gl = *api_;
  framebuffer_.attach(GL_COLOR_ATTACHMENT0, out.visibility);
  framebuffer_.attach(GL_DEPTH_ATTACHMENT, out.depth);
  framebuffer_.bind();
  vertexArray_.bind();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  view.scene.drawList.bindStorage(SSBO_DRAW_LIST);
  // Reversed depth in 0..1 keeps a float's relative precision at every distance.
  gl::DrawState state{.viewport = {0, 0, out.width, out.height},
                      .depthTest = true,
                      .depthFunction = GL_GREATER,
                      .depthWrite = true,
                      .clipDepth = GL_ZERO_TO_ONE};
  state.apply(gl);
  const GLuint nothing[4] = {0, 0, 0, 0};
  const GLfloat farthest = 0;
  gl.ClearNamedFramebufferuiv(framebuffer_.name(), GL_COLOR, 0, nothing);
  gl.ClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
  for (const DrawRange& range : view.scene.drawRanges) {
    (range.cut ? cut_ : opaque_).use();
    state.cullFaces = view.frame.cullBackFaces && !range.doubleSided;
    state.apply(gl);
    gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.first), static_cast<GLsizei>(3 * range.count));
  }
}

const gl::Program& GBufferPass::resolving(const FrameView& view, const PrimarySettings& primary) {
  const bool ruled = hasRules(primary), tested = primary.hits == PrimaryHits::tested;
  const std::size_t rules = !ruled ? 0 : !tested ? 1 : 2 + static_cast<std::size_t>(primary.multisampling);
  std::optional<SurfacePrograms>& programs = resolve_[rules];
  if (!programs) {
    std::vector<gl::Define> defines;
    if (ruled) defines.push_back({"PRIMARY_RULES"});
    if (tested) defines.push_back({"TEST_HITS"});
    if (tested && primary.multisampling != Multisampling::none)
      defines.push_back({primary.multisampling == Multisampling::lazy ? "LAZY" : "FULL"});
    programs.emplace(*api_, "passes/gbuffer.comp", std::move(defines));
  }
  return programs->of(view);
}

// What the tests write, which leaves again with them.
void GBufferPass::beginTests(const gl::Program& program, const PrimarySettings& primary, GBuffer& out) const {
  if (!hasRules(primary)) {
    out.tested = gl::Texture();
    out.primaryCounts = gl::Buffer();
    return;
  }
  if (!out.tested) out.tested = gl::Texture(*api_, out.visibility.shape(), "tested triangles");
  if (!out.primaryCounts) out.primaryCounts = gl::Buffer(*api_, 2 * sizeof(std::uint32_t), "primary counts");
  out.primaryCounts.fill(0);
  program.set("reach", primary.neighborhood / 2);
  program.set("every", static_cast<unsigned>(primary.every));
  out.primaryCounts.bindStorage(SSBO_PRIMARY_COUNTS);
  out.tested.bindImage(IMAGE_TESTED, GL_WRITE_ONLY);
}

void GBufferPass::resolve(const FrameView& view, GBuffer& out, const PrimarySettings& primary) {
  const gl::Api& gl = *api_;
  const gl::Program& program = resolving(view, primary);
  program.use();
  beginTests(program, primary, out);
  out.number = ++frames_;
  program.set("number", out.number);
  out.signature.bindStorage(SSBO_SIGNATURE);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindSurfaces();
  out.visibility.bind(UNIT_VISIBILITY);
  out.normal.bindImage(IMAGE_NORMAL, GL_WRITE_ONLY);
  out.material.bindImage(IMAGE_MATERIAL, GL_WRITE_ONLY);
  out.shaded.bindImage(IMAGE_SHADED, GL_WRITE_ONLY);
  out.reflection.bindImage(IMAGE_REFLECTION, GL_WRITE_ONLY);
  if (out.lobes) out.lobes.bindImage(IMAGE_LOBES, GL_WRITE_ONLY);
  if (out.coat) out.coat.bindImage(IMAGE_COAT, GL_WRITE_ONLY);
  gl.DispatchCompute(static_cast<GLuint>((out.width + kTile - 1) / kTile),
                     static_cast<GLuint>((out.height + kTile - 1) / kTile), 1);
  // This dispatch writes the G-buffer's images; selection, shading and the layers' read-back fetch them. The signature
  // is copied when the frame ends, after a barrier.
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  if (!out.tested) return;
  std::swap(out.visibility, out.tested);
  gl.MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);  // the next frame draws over what was stored here
}

}  // namespace halfsilver
