#include <halfsilver/frame_view.h>

namespace halfsilver {

void FrameView::bindRays(const RayQueue& queue) const {
  constants.bindUniform(UBO_FRAME);
  queue.rays.bindStorage(SSBO_RAYS);
  queue.count.bindStorage(SSBO_RAY_COUNT);
  if (!gbuffer.visibility) return;  // then no ray starts there
  scene.bindTriangles();
  gbuffer.normal.bind(UNIT_NORMAL);
  gbuffer.visibility.bind(UNIT_VISIBILITY);
}

void FrameView::bindCoat() const { (gbuffer.coat ? gbuffer.coat : gbuffer.material).bind(UNIT_COAT); }

void FrameView::bindPixelLight() const {
  constants.bindUniform(UBO_FRAME);
  gbuffer.shaded.bind(UNIT_SHADED);
  gbuffer.reflection.bind(UNIT_REFLECTION);
  (gbuffer.seen ? gbuffer.seen : gbuffer.reflection).bind(UNIT_SEEN);
  scene.sky.bind(UNIT_SKY);
  gbuffer.depth.bind(UNIT_DEPTH);
  gbuffer.normal.bind(UNIT_NORMAL);
  gbuffer.material.bind(UNIT_MATERIAL);
  bindCoat();
}

}  // namespace halfsilver
