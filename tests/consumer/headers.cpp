// Every public header compiles by itself, and macros of the shaders' structs stay out of what an engine includes.
#include <halfsilver/budget.h>
#include <halfsilver/builtin.h>
#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include <halfsilver/model.h>
#include <halfsilver/renderer.h>
#include <halfsilver/scene.h>
#include <halfsilver/settings.h>

#ifdef NO_TRIANGLE
#error "a public header of the renderer's users includes the shaders' structs"
#endif

#include <halfsilver/ray_reader.h>
#include <halfsilver/tracer.h>

// A tracer that finds nothing can be written with the public headers alone.
class Blind final : public halfsilver::Tracer {
 public:
  void update(const halfsilver::FrameView&, const halfsilver::SceneChange&) override {}
  void trace(const halfsilver::FrameView&, const halfsilver::RayQueue&, halfsilver::Hits&) override {}
  halfsilver::TracerMemory memory() const override { return {}; }
};

int main() { return Blind().memory().structureTotal == 0 ? 0 : 1; }
