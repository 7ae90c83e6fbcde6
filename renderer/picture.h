#pragma once

#include <cstdint>
#include <optional>

#include <halfsilver/frame_view.h>
#include <halfsilver/renderer.h>
#include "frame_record.h"
#include "passes/accumulate.h"
#include "passes/composite.h"
#include "passes/display.h"
#include "passes/fxaa.h"
#include "passes/temporal.h"

namespace halfsilver {

// What becomes of the light of frames: a picture at once, one of many samples, or one that follows those before. Frames
// begin and finish in one order.
class Picture {
 public:
  explicit Picture(const gl::Api& api) : composite_(api), accumulate_(api), display_(api), fxaa_(api), temporal_(api) {}

  // What a frame is for, from what it is drawn with; a sample of Renderer::refine() if there is one. Says where the
  // samples of its pixels lie.
  PictureUse begin(const Camera& camera, const Settings& settings, const glm::ivec2& size,
                   const std::optional<std::uint32_t>& sample);
  // The scene has changed: a picture of several samples starts over, a history is followed.
  void changed();
  // Nothing that was drawn so far counts any more.
  void forget();

  // Draws a finished frame into the target. `previousPositions` of the scene's vertices: in the frame before.
  void show(const FrameView& view, const Frame& frame, const gl::Buffer& previousPositions, const Target& target);
  // The same picture as radiance. Only of the frame that was shown last.
  void readLinear(const FrameView& view, const Frame& frame, GLuint framebuffer);

  std::uint32_t samples() const { return samplesOf_ ? samples_.samples : 0; }
  std::size_t bytes() const { return samples_.bytes() + fxaa_.bytes() + temporal_.bytes(); }

 private:
  // What the frames of one picture have in common.
  struct Subject {
    Settings settings;
    glm::ivec2 size{0};
    bool operator==(const Subject&) const = default;
  };
  struct View {
    Subject subject;
    Camera camera;
    bool operator==(const View&) const = default;
  };
  // Frames that have begun.
  struct History {
    Subject subject;  // without the settings that choose among reflections: they only change their share
    View last;
    std::uint32_t frames = 0;
    glm::dvec2 moved{0};  // how far the picture has, see meanMotion(); pixels, but for whole ones
    int unsettled = 0;    // how many more frames of the same moment may still show what was before it
    bool changed = false;
  };

  // A picture of one frame after the other, of the passes of all (effect.progressive).
  struct Refined {
    View view;
    std::uint32_t passes = 0;
  };

  PictureUse beginTemporal(View view, std::uint32_t passes);
  DisplayPass::Source meanOfSamples() const { return {samples_.sum, 1.0f / static_cast<float>(samples_.samples)}; }

  CompositePass composite_;
  AccumulatePass accumulate_;
  DisplayPass display_;
  FxaaPass fxaa_;
  TemporalPass temporal_;
  Accumulation samples_;
  std::optional<View> samplesOf_;
  std::optional<History> history_;
  std::optional<Refined> refined_;
};

}  // namespace halfsilver
