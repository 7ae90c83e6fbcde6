#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <halfsilver/builtin.h>
#include <halfsilver/error.h>
#include "apps/demo/game/autopilot.h"
#include "apps/demo/game/frame_controller.h"
#include "apps/demo/game/game.h"
#include "apps/demo/game/recording.h"
#include "builtin/random.h"
#include "game_level.h"
#include "temporary_folder.h"

// Whole rounds of the game, recordings of them, and the controller that holds a frame time.
namespace halfsilver::demo {
namespace {

struct Round {
  Recording recording;
  std::vector<Ball> balls;  // after each step
  std::vector<Event> events;
  Hud end;
};

// The driver plays until the round ends.
const Round& round() {
  static const Round played = [] {
    Round made;
    Game game(level());
    Autopilot pilot;
    for (int step = 0; step < 300 * kStepsPerSecond && game.hud().phase != Phase::finished; ++step) {
      const Input input = pilot.next(game);
      made.recording.inputs.push_back(input);
      game.step(input);
      made.balls.push_back(game.world().ball());
      made.events.insert(made.events.end(), game.events().begin(), game.events().end());
    }
    made.end = game.hud();
    return made;
  }();
  return played;
}

TEST(Game, TheDriverStartsCollectsEverythingAndReachesTheGoal) {
  EXPECT_EQ(round().end.phase, Phase::finished);
  EXPECT_EQ(round().end.collected, 12);
  EXPECT_EQ(round().end.total, 12);
  EXPECT_TRUE(round().end.goalOpen);
  EXPECT_GT(round().end.seconds, 20);
  EXPECT_LT(round().end.seconds, 240);
  RecordProperty("seconds", std::to_string(round().end.seconds));
  const auto count = [&](Event event) { return std::count(round().events.begin(), round().events.end(), event); };
  EXPECT_EQ(count(Event::started), 1);
  EXPECT_EQ(count(Event::collected), 12);
  EXPECT_EQ(count(Event::goalOpened), 1);
  EXPECT_EQ(count(Event::finished), 1);
  EXPECT_EQ(round().events.back(), Event::finished);
}

TEST(Game, AReplayOfTheRecordingGivesTheSameStateAfterEveryStep) {
  const TemporaryFolder folder;
  writeRecording(folder.path() / "round.txt", round().recording);
  const Recording read = readRecording(folder.path() / "round.txt");
  ASSERT_EQ(read, round().recording);
  Game game(level());
  for (std::size_t step = 0; step < read.inputs.size(); ++step) {
    game.step(read.inputs[step]);
    ASSERT_EQ(game.world().ball(), round().balls[step]) << "step " << step;
  }
  EXPECT_EQ(game.hud().phase, Phase::finished);
  EXPECT_EQ(game.hud().seconds, round().end.seconds);
}

TEST(Game, TheSecondRoundOfAGameIsTheSameAsTheFirst) {
  Game game(level());
  for (int step = 0; step < 300; ++step) game.step(Input::of(0.3, 1));
  const Ball first = game.world().ball();
  game.step(Input::of(0, 0, 0, 0, kButtonRestart));
  EXPECT_NEAR(game.world().ball().position.z,
              level().rig.nodes[static_cast<std::size_t>(game.level().ball)].translation.z, 1e-2);
  EXPECT_EQ(game.hud().collected, 0);
  Game fresh(level());
  fresh.step(Input::of(0, 0, 0, 0, kButtonRestart));
  for (int step = 0; step < 300; ++step) {
    game.step(Input::of(0.3, 1));
    fresh.step(Input::of(0.3, 1));
  }
  EXPECT_EQ(game.world().ball(), fresh.world().ball());
  EXPECT_GT(glm::distance(first.position, glm::dvec3(0, 0.4, 10.5)), 1.0);
}

TEST(Game, CollectedItemsVanishAndTheGateSinks) {
  Game game(level());
  const auto gate = static_cast<std::size_t>(game.level().gate), item = static_cast<std::size_t>(game.level().items[0]);
  const double before = game.poseState().world[gate][3].y;
  for (const Input& input : round().recording.inputs) game.step(input);
  for (int step = 0; step < 120; ++step) game.step({});
  EXPECT_LT(game.poseState().world[gate][3].y, before - 1.2);
  EXPECT_EQ(glm::length(glm::dvec3(game.poseState().world[item][0])), 0);
  Model posed = level();
  EXPECT_FALSE(pose(posed, game.poseState()).moved.empty());
}

TEST(Game, FiguresAreSkinnedSmoothlyAndMoveByThemselves) {
  int skinned = 0;
  for (const Instance& instance : level().rig.instances) {
    if (instance.skin < 0) continue;
    ++skinned;
    int blended = 0;
    for (const glm::vec4& weights : instance.weights) {
      EXPECT_NEAR(weights.x + weights.y + weights.z + weights.w, 1, 1e-5);
      blended += std::max({weights.x, weights.y, weights.z, weights.w}) < 0.95f;
    }
    EXPECT_GT(blended, static_cast<int>(instance.weights.size() / 20));
  }
  EXPECT_GE(skinned, 3);
  Game game(level());
  const PoseState before = game.poseState();
  for (int step = 0; step < 20; ++step) game.step({});
  for (const int figure : game.level().figures) {
    double moved = 0;
    for (std::size_t node = 0; node < before.world.size(); ++node) {
      int above = static_cast<int>(node);
      while (above >= 0 && above != figure) above = level().rig.nodes[static_cast<std::size_t>(above)].parent;
      if (above != figure) continue;
      for (int column = 0; column < 4; ++column)
        moved = std::max(moved, glm::distance(before.world[node][column], game.poseState().world[node][column]));
    }
    EXPECT_GT(moved, 0.05) << "figure node " << figure;
  }
}

TEST(Game, LanternsAndDaylightAreSwitchedByKeysAndPlates) {
  Game game(level());
  EXPECT_FALSE(game.takeChange().any());
  game.step(Input::of(0, 0, 0, 0, kButtonLantern1 | kButtonDaylight));
  game.step(Input::of(0, 0, 0, 0, kButtonLantern1 | kButtonDaylight));  // still held: nothing more
  const SceneChange change = game.takeChange();
  EXPECT_TRUE(change.lights && change.materials && change.sky);
  EXPECT_FALSE(change.geometry());
  EXPECT_FALSE(game.hud().lanterns[0]);
  EXPECT_TRUE(game.hud().lanterns[1]);
  EXPECT_FALSE(game.hud().daylight);
  const auto light = static_cast<std::size_t>(game.level().lanternLights[0]);
  EXPECT_EQ(game.model().scene.lights[light].intensity, 0);
  EXPECT_LT(game.model().scene.sky.intensity, 0.1f * level().scene.sky.intensity);
  EXPECT_GT(std::count(round().events.begin(), round().events.end(), Event::switchedLantern), 0)
      << "the round leads over a plate";
}

TEST(Game, AModelThatIsNoLevelIsRefusedInOneLine) {
  try {
    Game game(makeBuiltin("sphere"));
    FAIL() << "must be refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    EXPECT_NE(std::string(error.what()).find("ball"), std::string::npos);
  }
}

TEST(GameRecording, RefusesWhatIsNoRecordingWithTheLine) {
  const std::string head = "halfsilver-recording 1\nsteps-per-second 60\nseed 0\n";
  EXPECT_EQ(parseRecording(head + "# a comment\n\n3 1 -2 30 -40 5\r\n", "x").inputs,
            std::vector<Input>(3, Input{1, -2, 30, -40, 5}));
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "not a recording"},
           {"glTF", "line 1"},
           {"halfsilver-recording 2\n", "version 2"},
           {"halfsilver-recording 1\nsteps-per-second 30\n", "line 2"},
           {"halfsilver-recording 1\nsteps-per-second 60\n", "cut off"},
           {"halfsilver-recording 1\nsteps-per-second 60\nseed -1\n", "line 3"},
           {head + "1 2 3\n", "line 4"},
           {head + "0 0 0 0 0 0\n", "line 4"},
           {head + "1 0 0 0 0 0\n1 128 0 0 0 0\n", "line 5"},
           {head + "1 x 0 0 0 0\n", "line 4"},
           {head + "4000000000 0 0 0 0 0\n", "more than a day"},
           {head + "99999999999999999999 0 0 0 0 0\n", "line 4"}}) {
    try {
      parseRecording(text, "x");
      ADD_FAILURE() << "must be refused: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::badInput);
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_THROW(readRecording("/nonexistent/x"), Error);
  EXPECT_THROW(writeRecording("/nonexistent/x", {}), Error);
}

TEST(GameInput, IsExactInWholeNumbers) {
  EXPECT_EQ(Input::of(1, -1, 1.5, -0.25, 3), (Input{127, -127, 150, -25, 3}));
  EXPECT_EQ(Input::of(7, -7, 1e9, -1e9), (Input{127, -127, 32767, -32767, 0}));
  EXPECT_EQ(Input::of(std::nan(""), 0), Input{});
}

// A device: what a frame takes at a quality, in milliseconds, with noise.
struct Device {
  double fixed, perPixel, perRay;
  Random random{3};
  double frame(const FrameQuality& quality) {
    const double area = quality.scale * quality.scale;
    const double time = fixed + area * (perPixel + perRay * quality.share);
    const double spike = random.unit() < 0.01 ? 1.6 : 1.0;
    return time * random.between(0.92, 1.08) * spike;
  }
};

struct Held {
  int within = 0;  // of the last 300 frames, those within 1.2 times the target
  int changes = 0;
  FrameQuality quality;
};

Held hold(Device device, const std::function<void(Device&, int)>& change = {}) {
  FrameController controller(100);
  Held held;
  for (int frame = 0; frame < 400; ++frame) {
    if (change) change(device, frame);
    const FrameQuality before = controller.quality();
    const double time = device.frame(before);
    controller.learn(time);
    if (frame < 100) continue;
    held.within += time <= 120;
    held.changes += !(controller.quality() == before);
  }
  held.quality = controller.quality();
  return held;
}

TEST(FrameController, HoldsAHundredMillisecondsOnDevicesOfAllKinds) {
  for (const Device& device : {Device{20, 200, 150}, Device{40, 300, 100}, Device{5, 100, 600}, Device{60, 40, 40},
                               Device{10, 60, 50}, Device{30, 900, 300}, Device{70, 500, 300}}) {
    const Held held = hold(device);
    EXPECT_GE(held.within, 285) << device.fixed << ' ' << device.perPixel << ' ' << device.perRay;
    EXPECT_LE(held.changes, 12) << "it must come to rest";
    const double left =
        device.fixed + held.quality.scale * held.quality.scale * (device.perPixel + device.perRay * held.quality.share);
    EXPECT_TRUE(left > 55 || held.quality == FrameQuality{}) << "and use the time that there is: " << left;
  }
}

TEST(FrameController, FollowsADeviceThatBecomesSlowerAndFaster) {
  const Held held =
      hold({20, 100, 60}, [](Device& device, int frame) { device.perPixel = frame >= 200 && frame < 300 ? 260 : 100; });
  EXPECT_GE(held.within, 285);
}

TEST(FrameController, GivesFullQualityWhereThereIsTime) {
  const Held held = hold({5, 20, 20});
  EXPECT_EQ(held.quality, FrameQuality{});
  EXPECT_EQ(held.within, 300 - 0);
}

TEST(FrameController, SaysWhatItDoes) {
  FrameController controller(100);
  Device slow{20, 300, 200};
  for (int frame = 0; frame < 60; ++frame) controller.learn(slow.frame(controller.quality()));
  EXPECT_LT(controller.quality().scale, 0.7);
  EXPECT_NE(controller.say().find("scale 0."), std::string::npos) << controller.say();
  EXPECT_NE(controller.say().find("% of the reflections"), std::string::npos);
  controller.learn(std::nan(""));
  controller.learn(-1);
}

}  // namespace
}  // namespace halfsilver::demo
