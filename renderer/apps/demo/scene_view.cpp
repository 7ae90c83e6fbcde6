#include "apps/demo/scene_view.h"

#include "apps/drawing.h"

namespace halfsilver::demo {

SceneView::SceneView(const gl::Api& api, const std::function<Renderer::Proc(const char*)>& getProcAddress,
                     const Scene& scene, int threads)
    : api_(&api), renderer_(getProcAddress, exactFactory(scene, threads)) {
  renderer_.setScene(scene);
}

void SceneView::draw(const Camera& camera, const Settings& settings, const Size& size) {
  if (!picture_ || size.width != size_.width || size.height != size_.height) {
    picture_.reset();  // its memory goes before the new one's comes
    picture_.emplace(*api_, size);
    size_ = size;
  }
  renderer_.render(camera, settings, picture_->target());
}

unsigned SceneView::texture() const { return picture_ ? picture_->texture() : 0; }

std::vector<std::uint8_t> SceneView::read() const { return picture_ ? picture_->read() : std::vector<std::uint8_t>(); }

}  // namespace halfsilver::demo
