#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <halfsilver/builtin.h>
#include "apps/demo/game/follow_camera.h"
#include "apps/demo/game/level.h"
#include "apps/demo/game/world.h"
#include "builtin/random.h"
#include "game_level.h"

// How the ball of the game rolls, hits and is carried, and where its camera goes.
namespace halfsilver::demo {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kSecond = 240;

void quad(std::vector<Corners>& to, dvec3 corner, dvec3 a, dvec3 b) {
  to.push_back({corner, corner + a, corner + a + b});
  to.push_back({corner, corner + a + b, corner + b});
}

void box(std::vector<Corners>& to, dvec3 low, dvec3 high) {
  const dvec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  for (const dvec3& at : {low, low + y}) quad(to, at, x, z);
  for (const dvec3& at : {low, low + x}) quad(to, at, y, z);
  for (const dvec3& at : {low, low + z}) quad(to, at, x, y);
}

std::vector<Corners> floorOf(double half) {
  std::vector<Corners> triangles;
  for (double x = -half; x < half; x += 0.9)
    for (double z = -half; z < half; z += 0.9) quad(triangles, {x, 0, z}, {0.9, 0, 0}, {0, 0, 0.9});
  return triangles;
}

World worldOf(std::vector<Corners> triangles, dvec3 start = {0, 0.4, 0}) {
  return World(TriangleGrid(std::move(triangles), 0.6), BallTuning{}, start);
}

double speedOf(const World& world) { return glm::length(world.ball().velocity); }

void run(World& world, double seconds, dvec2 push = dvec2(0), const std::vector<MovingBody>& bodies = {}) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds * kSecond)); ++i) world.step(push, bodies, {});
}

TEST(GamePhysics, TheBallReachesSixMetersPerSecondInAboutASecondAndAHalfAndStopsInTwo) {
  World world = worldOf(floorOf(40));
  run(world, 1.0, {1, 0});
  EXPECT_LT(speedOf(world), 5.0);
  run(world, 0.7, {1, 0});
  EXPECT_GT(speedOf(world), 5.6);
  run(world, 1.5, {1, 0});
  EXPECT_NEAR(speedOf(world), 6.0, 0.2);
  run(world, 1.5);
  EXPECT_GT(speedOf(world), 0.5);
  run(world, 0.7);
  EXPECT_LT(speedOf(world), 0.01);
  EXPECT_NEAR(world.ball().position.y, 0.4, 1e-3);
}

TEST(GamePhysics, TheBallRollsWithoutSlipping) {
  World world = worldOf(floorOf(40));
  for (int second = 0; second < 4; ++second) {
    run(world, 1, {0.6, -0.8});
    const Ball& ball = world.ball();
    const dvec3 contact = ball.velocity + glm::cross(ball.spin, dvec3(0, -0.4, 0));
    EXPECT_LT(std::hypot(contact.x, contact.z), 0.05) << "at " << second + 1 << " s";
    EXPECT_GT(speedOf(world), 3);
  }
  // Over one turn of the ball it has come as far as its circumference.
  World turning = worldOf(floorOf(40));
  run(turning, 3, {1, 0});
  const Ball before = turning.ball();
  double turned = 0;
  while (turned < 6.283185307) {
    turning.step({1, 0}, {}, {});
    turned += glm::length(turning.ball().spin) * kSubstepSeconds;
  }
  EXPECT_NEAR(turning.ball().position.x - before.position.x, 2 * 3.14159265 * 0.4, 0.05);
  EXPECT_GT(std::abs(glm::dot(turning.ball().turn, before.turn)), 0.99) << "and looks as before";
}

TEST(GamePhysics, AWallStopsTheBall) {
  std::vector<Corners> level = floorOf(10);
  quad(level, {3, 0, -9}, {0, 3, 0}, {0, 0, 18});
  World world = worldOf(level);
  double farthest = 0;
  for (int i = 0; i < 4 * kSecond; ++i) {
    world.step({0.7, 0.7}, {}, {});
    farthest = std::max(farthest, world.ball().position.x);
  }
  EXPECT_NEAR(farthest, 2.6, 1e-3);
  EXPECT_GT(world.ball().position.z, 1.0) << "it slides along the wall";
  EXPECT_NEAR(world.ball().position.y, 0.4, 0.02) << "and does not climb it";
}

TEST(GamePhysics, AStepOfTenCentimetersNeedsSpeed) {
  std::vector<Corners> level = floorOf(10);
  box(level, {3, 0, -9}, {9, 0.1, 9});
  World slow = worldOf(level, {2.73, 0.4, 0});  // touches the edge
  run(slow, 3, {1, 0});
  EXPECT_LT(slow.ball().position.x, 2.9);
  World fast = worldOf(level);
  run(fast, 2, {1, 0});
  EXPECT_GT(fast.ball().position.x, 3.2);
  EXPECT_NEAR(fast.ball().position.y, 0.5, 0.02);
}

TEST(GamePhysics, SeamsBetweenTrianglesDoNotShakeTheBall) {
  World world = worldOf(floorOf(40));
  for (int i = 0; i < 5 * kSecond; ++i) {
    world.step({0.8, 0.6}, {}, {});
    ASSERT_NEAR(world.ball().position.y, 0.4, 1e-3) << "step " << i;
  }
}

TEST(GamePhysics, APlatformCarriesTheBall) {
  MovingBody platform;
  box(platform.triangles, {-1, -0.1, -1}, {1, 0, 1});
  World world = worldOf(floorOf(20), {0, 1.4, 0});
  double x = 0;
  platform.place[3] = platform.before[3] = {0, 1, 0, 1};
  std::vector<MovingBody> bodies{platform};
  for (int i = 0; i < 4 * kSecond; ++i) {
    bodies[0].before = bodies[0].place;
    const double t = i * kSubstepSeconds;
    x += 1.2 * std::min(t, 1.0) * kSubstepSeconds;
    bodies[0].place[3] = {x, 1 + 0.2 * t, 0, 1};
    world.step(dvec2(0), bodies, {});
  }
  EXPECT_GT(x, 3.5);
  EXPECT_NEAR(world.ball().position.x, x, 0.4);
  EXPECT_NEAR(world.ball().position.y, bodies[0].place[3].y + 0.4, 0.01);
  EXPECT_NEAR(world.ball().velocity.x, 1.2, 0.05);
}

TEST(GamePhysics, AFigureThatWalksPushesTheBall) {
  World world = worldOf(floorOf(20));
  std::vector<Pillar> figures(1);
  double x = -2;
  for (int i = 0; i < 4 * kSecond; ++i) {
    figures[0].before = {x, 0, 0.05};
    x += 1.0 * kSubstepSeconds;
    figures[0].foot = {x, 0, 0.05};
    world.step(dvec2(0), {}, figures);
    const dvec3& at = world.ball().position;
    ASSERT_GT(std::hypot(at.x - x, at.z - 0.05), 0.4 + figures[0].radius - 0.01);
  }
  EXPECT_GT(glm::length(world.ball().position), 0.5);
}

TEST(GamePhysics, FallingOutPutsTheBallBackToTheLastSafePlace) {
  World world = worldOf(floorOf(4));
  run(world, 1);
  run(world, 4, {1, 0});
  EXPECT_GE(world.returns(), 1u);
  run(world, 1);
  EXPECT_LT(std::abs(world.ball().position.x), 4.5);
  EXPECT_NEAR(world.ball().position.y, 0.4, 0.01);
}

const TriangleGrid& ground() {
  static const TriangleGrid grid = Level::ground(level());
  return grid;
}

bool inHall(const dvec3& p) { return std::abs(p.x) < 6.75 && p.y > 0 && p.y < 14 && std::abs(p.z) < 14.9; }

TEST(GamePhysics, NothingIsTunneledThroughInAThousandThrows) {
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    World world(ground(), BallTuning{}, {0, 0.4, 10.5});
    const double turn = random.between(0, 6.2831853), rise = random.between(-0.3, 0.4);
    const dvec3 way(std::cos(turn) * std::cos(rise), std::sin(rise), std::sin(turn) * std::cos(rise));
    world.ball().position = {random.between(-2.5, 2.5), random.between(0.5, 3.0), random.between(9.5, 13)};
    world.ball().velocity = way * random.between(5, 20);
    world.ball().spin = dvec3(random.between(-30, 30), random.between(-30, 30), random.between(-30, 30));
    const double before = glm::length(world.ball().velocity);
    for (int k = 0; k < 2 * kSecond; ++k) {
      world.step({way.x, way.z}, {}, {});
      ASSERT_TRUE(inHall(world.ball().position)) << "throw " << i << ", step " << k << ": " << world.ball().position.x
                                                 << ' ' << world.ball().position.y << ' ' << world.ball().position.z;
    }
    hits += glm::length(world.ball().velocity) < 0.7 * before;
    ASSERT_EQ(world.returns(), 0u) << "throw " << i;
  }
  EXPECT_GT(hits, 500) << "most throws must have hit something";
}

TEST(GameCamera, IsNeverInAWallAndNoWallIsBetweenItAndItsAim) {
  World world(ground(), BallTuning{}, {0, 0.4, 10.5});
  FollowCamera camera(world.ball().position, 0);
  Random random(9);
  double closest = 10;
  dvec2 push(0), look(0);
  for (int step = 0; step < 60 * 120; ++step) {
    if (step % 45 == 0) {
      const double turn = random.between(0, 6.2831853);
      push = {std::cos(turn), std::sin(turn)};
      look = {random.between(-0.06, 0.06), random.between(-0.02, 0.02)};
      if (step % 90 == 0) look = dvec2(0);
    }
    for (int k = 0; k < kSubsteps; ++k) world.step(push, {}, {});
    camera.step(ground(), world.ball().position, world.ball().velocity, look);
    ASSERT_FALSE(ground().nearest(camera.eye(), FollowCamera::kRadius - 0.01)) << "step " << step;
    const dvec3 way = dvec3(camera.camera().target) - camera.eye();
    ASSERT_GE(ground().cast(camera.eye(), way, 0.02), 0.999) << "step " << step;
    ASSERT_LT(glm::distance(dvec3(camera.camera().target), world.ball().position), 1.2) << "step " << step;
    closest = std::min(closest, glm::length(way));
  }
  EXPECT_LT(closest, 2.5) << "walls must have come into its way";
  EXPECT_GT(glm::length(world.ball().position - dvec3(0, 0.4, 10.5)), 2.0);
}

TEST(GameCamera, SettlesWithoutSwinging) {
  Spring spring;
  double farthest = 0;
  for (int i = 0; i < 120; ++i) {
    spring.follow({1, 0, 0}, 0.12, 1.0 / 60);
    farthest = std::max(farthest, spring.value.x);
  }
  EXPECT_LE(farthest, 1.0 + 1e-9);
  EXPECT_NEAR(spring.value.x, 1, 1e-6);
}

}  // namespace
}  // namespace halfsilver::demo
