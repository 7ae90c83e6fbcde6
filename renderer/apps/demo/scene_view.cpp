#include "apps/demo/scene_view.h"

#include "apps/drawing.h"

namespace halfsilver::demo {

SceneView::SceneView(const gl::Api& api, const std::function<Renderer::Proc(const char*)>& getProcAddress,
                     const Model& model, const AnimatedBounds& bounds, int threads)
    : api_(&api), renderer_(getProcAddress, exactFactory(model.scene, threads)) {
  renderer_.setModel(model, bounds);
}

void SceneView::pose(const PoseState& state) {
  if (state.world == state_.world && state.weights == state_.weights) return;
  renderer_.pose(state);
  state_ = state;
  drawn_.reset();
}

void SceneView::update(const Scene& scene, const SceneChange& change) {
  renderer_.update(scene, change);
  drawn_.reset();
}

bool SceneView::draw(const Camera& camera, const Settings& settings, const Size& size, int samples) {
  if (!picture_ || size.width != size_.width || size.height != size_.height) {
    picture_.reset();  // its memory goes before the new one's comes
    picture_.emplace(*api_, size);
    size_ = size;
    drawn_.reset();
  }
  const std::pair wanted(camera, settings);
  const bool still = drawn_ == wanted;
  if (still && samples > 1 && samples_ >= samples) return false;
  drawn_.reset();  // until it is drawn
  if (!still || samples <= 1) {
    renderer_.render(camera, settings, picture_->target());
    samples_ = 0;
  } else {
    if (samples_ == 0) renderer_.forgetHistory();
    renderer_.refine(camera, settings, picture_->target(), static_cast<std::uint32_t>(samples_));
    ++samples_;
  }
  drawn_ = wanted;
  return true;
}

unsigned SceneView::texture() const { return picture_ ? picture_->texture() : 0; }

std::vector<std::uint8_t> SceneView::read() const { return picture_ ? picture_->read() : std::vector<std::uint8_t>(); }

}  // namespace halfsilver::demo
