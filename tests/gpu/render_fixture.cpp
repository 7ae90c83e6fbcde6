#include "gpu/render_fixture.h"

#include <cmath>

namespace halfsilver::testing {

float Frame::at(int x, int y, const std::string& channel) const {
  const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(layers.width) + static_cast<std::size_t>(x);
  return layers.data[pixel * layers.channels.size() + static_cast<std::size_t>(layers.channel(channel))];
}

std::vector<float> Frame::plane(const std::string& channel) const {
  std::vector<float> values(layers.pixelCount());
  const auto offset = static_cast<std::size_t>(layers.channel(channel));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = layers.data[i * layers.channels.size() + offset];
  return values;
}

HitErrors compareHits(const Frame& frame, const Frame& exact, float diagonal) {
  const std::vector<float> t = frame.plane("hit.T"), truth = exact.plane("hit.T");
  const std::vector<float> id = frame.plane("hit.id"), trueId = exact.plane("hit.id");
  HitErrors errors;
  std::size_t wrong = 0, misses = 0, hits = 0, ids = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] == -2.0f && truth[i] == -2.0f) continue;
    ++errors.rays;
    const bool hit = t[i] >= 0, trulyHit = truth[i] >= 0;
    if (!hit && trulyHit) ++misses;
    if (hit && !trulyHit) ++hits;
    if (hit != trulyHit || (hit && std::abs(t[i] - truth[i]) > 1e-3f * diagonal)) ++wrong;
    if (hit && trulyHit && id[i] != trueId[i]) ++ids;
  }
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, errors.rays));
  };
  errors.hitError = share(wrong);
  errors.falseMiss = share(misses);
  errors.falseHit = share(hits);
  errors.wrongId = share(ids);
  return errors;
}

std::vector<Method> RenderTest::methods(const Scene& scene) const {
  return {{methodInfo("exact"), makeExactTracerFactory(scene, 2)}};
}

Renderer RenderTest::makeRenderer(const Scene& scene) {
  Renderer renderer([this](const char* name) { return context.getProcAddress()(name); }, methods(scene));
  renderer.setScene(scene);
  return renderer;
}

Frame RenderTest::drawWith(Renderer& renderer, const Camera& camera, const Settings& settings, int width, int height) {
  const gl::Texture color(api, {.format = GL_RGBA8, .width = width, .height = height}, "test picture");
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, color);
  renderer.render(camera, settings, {framebuffer.name(), 0, 0, width, height});
  return {renderer.readLayers(), renderer.report()};
}

Frame RenderTest::draw(const Scene& scene, const Camera& camera, const Settings& settings, int width, int height) {
  Renderer renderer = makeRenderer(scene);
  return drawWholeWith(renderer, camera, settings, width, height);
}

Frame RenderTest::drawWholeWith(Renderer& renderer, const Camera& camera, const Settings& settings, int width,
                                int height) {
  Frame frame;
  for (int i = 0; i < 4; ++i) {
    frame = drawWith(renderer, camera, settings, width, height);
    if (frame.report.lostFragments == 0) break;
  }
  return frame;
}

Frame RenderTest::drawOnce(const Scene& scene, const Camera& camera, const Settings& settings, int width, int height) {
  Renderer renderer = makeRenderer(scene);
  return drawWith(renderer, camera, settings, width, height);
}

Settings settingsWith(std::initializer_list<std::pair<const char*, const char*>> values) {
  Settings settings;
  set(settings, "shadow.sky_directions", "0");  // light is not what these tests are about
  set(settings, "shadow.resolution", "64");
  for (const auto& [name, value] : values) set(settings, name, value);
  return settings;
}

Camera lookAt(const glm::vec3& eye, const glm::vec3& target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.verticalFov = 1.0471976f;
  return camera;
}

}  // namespace halfsilver::testing
