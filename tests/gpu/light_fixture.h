#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "effects/reflection/reflection_effect.h"
#include "frame/frame_constants.h"
#include "frame/gpu_scene.h"
#include "gpu/context_fixture.h"
#include "passes/composite.h"
#include "passes/gbuffer.h"
#include "passes/shade.h"
#include "passes/shadows.h"

namespace halfsilver::testing {

// Small scenes made by hand.
std::uint32_t addMaterial(Scene& scene, const Material& material);
Material diffuse(const glm::vec3& color);  // Lambert alone: no specular reflection
Material mirror(float reflectance, const glm::vec3& color = glm::vec3(0));
// A parallelogram with its front towards cross(u, v); uv 0..1 along u and v.
void addQuad(Scene& scene, const glm::vec3& center, const glm::vec3& halfU, const glm::vec3& halfV,
             std::uint32_t material);
// Fronts outwards; inwards where `inside`.
void addBox(Scene& scene, const glm::vec3& low, const glm::vec3& high, std::uint32_t material, bool inside = false);
Light sun(const glm::vec3& direction, float lux);
Light bulb(const glm::vec3& position, float candela);
Sky blackSky();
Sky evenSky(const glm::vec3& radiance);

// Runs the passes around lighting on a scene. Pixels are row by row from the bottom.
class LightTest : public ContextTest {
 protected:
  // Shadows, G-buffer and deferred shading of one frame.
  void draw(const Scene& scene, const Camera& camera, int width, int height);
  // Radiance and sky visibility of the point `target` as seen from `eye`. The scene must not hide it.
  glm::vec4 shadeAt(const Scene& scene, const glm::vec3& eye, const glm::vec3& target);
  std::vector<glm::vec4> composite(CompositePass::Output output);
  // What the passes after draw() read.
  FrameView view();
  std::vector<glm::vec4> pixels(const gl::Texture& texture) const;
  glm::vec4 middle(const std::vector<glm::vec4>& image) const;

  Settings settings;
  GpuScene gpu;
  ShadowMaps shadows;
  GBuffer gbuffer;
  gl::Buffer constants;
  shared::FrameConstants frame{};
  std::vector<std::string> warnings;  // of the shadow maps
  gl::Profiler profiler{api};
  ShadowPass shadowPass{api};
  GBufferPass gbufferPass{api};
  ShadePass shadePass{api};
  ReflectionEffect reflectionEffect{api};
  CompositePass compositePass{api};
};

}  // namespace halfsilver::testing
