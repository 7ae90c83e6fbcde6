#include <memory>

#include "apps/commands.h"
#include "apps/demo_module.h"

namespace halfsilver {
void addDemoCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("demo", "Play the game, or look around in a scene, in a window");
  const auto shared = std::make_shared<demo::Request>();
  demo::Request& request = *shared;
  addViewOptions(*command, request.view);
  command->get_option("SCENE")->required(false)->description(
      ".gltf or .glb file, or builtin:NAME, to look around in (default: the game)");
  command->add_option("--record", request.record, "Write the game's input to this file");
  command->add_option("--replay", request.replay, "Play the input of this file, with a fixed time step");
  command->add_option("--frames", request.frames, "Draw so many frames with a fixed time step and end; needs no window")
      ->check(CLI::Range(1, 10000000));
  command->add_option("--fps", request.fps, "Frames per second of the fixed time step (default: 30)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--screenshot", request.screenshot, "Write the last frame to this .png file");
  command->add_option("--stats", request.stats, "Write a line of JSON per frame to this file");
  command->add_option("--frame-time", request.frameTime,
                      "Milliseconds per frame to hold by resolution and by the share of reflections");
  command->add_option("--content-scale", request.contentScale, "Scale of the overlay (default: the display's)")
      ->check(CLI::Range(0.5, 4.0));
  command->add_option("--show", request.show, "What the picture shows at first: selection, error, ... (see F1)");
  command->add_option("--cells", request.cells, "Show the structure's cells: bricks or voxels, with the overlay");
  command->add_option("--split", request.split, "A preset or a method that draws the right half");
  command->add_flag("--window", request.window, "Open a window with --frames, too");
  command->add_flag("--overlay", request.overlay, "Draw the overlay into the frames of --frames, too");
  command->callback([shared, size = command->get_option("--size")] {
    shared->sized = size->count() > 0;
    runDemo(*shared);
  });
}

}  // namespace halfsilver
