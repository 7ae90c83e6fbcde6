// What a move of the camera or of triangles builds of the identity structure: the same as a build of everything, by
// other steps.
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <halfsilver/renderer.h>
#include "gpu/tracing_scenes.h"
#include "tracing/identity/brick_work.h"

namespace halfsilver::testing {
namespace {

using Move = glm::vec3;

class Moves : public TracingTest {
 protected:
  // Some triangles of all sizes that will move, and corners that keep the bounds as they are.
  Moves() : scene_(soup(2500)) {
    addTriangle(scene_, {-2.2f, -0.2f, -2.2f}, {-2.2f, -0.19f, -2.2f}, {-2.19f, -0.2f, -2.2f}, 1);
    addTriangle(scene_, {2.2f, 3.2f, 2.2f}, {2.2f, 3.19f, 2.2f}, {2.19f, 3.2f, 2.2f}, 1);
    moving_.first = static_cast<std::uint32_t>(scene_.vertices.size());
    for (int i = 0; i < 60; ++i) {
      const float x = -0.6f + 0.02f * static_cast<float>(i), size = i % 10 == 0 ? 0.9f : 0.05f;
      addTriangle(scene_, {x, 0.3f, 0}, {x + size, 0.3f, 0.1f}, {x, 0.3f + size, 0.2f}, 1);
    }
    moving_.count = static_cast<std::uint32_t>(scene_.vertices.size()) - moving_.first;
  }

  void move(Scene& scene, const Move& by) const {
    for (std::uint32_t v = moving_.first; v < moving_.first + moving_.count; ++v) scene.vertices[v].position += by;
  }

  // A first frame, then the camera's moves, then those of the triangles.
  std::vector<Frame> frames(const Settings& settings, std::vector<StructureCells>* structures = nullptr) {
    std::vector<Frame> result;
    Scene scene = scene_;
    Renderer renderer = makeRenderer(scene);
    const auto draw = [&](const Camera& camera) {
      result.push_back(drawWith(renderer, camera, settings, 80, 60));
      if (structures) structures->push_back(renderer.readStructure());
    };
    draw(kAbove);
    for (int i = 1; i < 4; ++i) draw(cameraAt(i));
    for (const Move& by : kMoves) {
      move(scene, by);
      renderer.updateVertices(scene, std::span(&moving_, 1));
      draw(cameraAt(3));
    }
    return result;
  }

  static Camera cameraAt(int step) {
    const float x = 0.15f * static_cast<float>(step);
    return lookAt({x, 1.9f, 3.2f}, {x, 0.1f, 0});
  }

  inline static const std::vector<Move> kMoves = {{0, 0.05f, 0}, {0.1f, 0.05f, 0}, {-0.5f, 0.9f, 0.3f}, {0, 0.6f, 0}};

  Scene scene_;
  VertexRange moving_{0, 0};
};

using Corner = std::tuple<float, float, float>;
Corner lowOf(const StructureCell& cell) { return {cell.bounds.low.x, cell.bounds.low.y, cell.bounds.low.z}; }

// How long the lists of each brick are: where its voxels lie, and their entries.
std::map<Corner, std::map<Corner, std::uint32_t>> listsOf(const StructureCells& structure) {
  std::map<Corner, std::map<Corner, std::uint32_t>> bricks;
  std::size_t voxel = 0;  // bricks and their voxels are in one order
  for (const StructureCell& brick : structure.bricks) {
    auto& lists = bricks[lowOf(brick)];
    for (std::uint32_t left = brick.entries; left > 0; left -= structure.voxels[voxel++].entries)
      lists[lowOf(structure.voxels[voxel])] = structure.voxels[voxel].entries;
  }
  return bricks;
}

// Which bricks a ray asks for besides the one that it needs depends on when they are built, their lists do not.
TEST_F(Moves, BuildWhatTheStepsOfAFirstFrameBuild) {
  for (const std::string axis : {"own", "area"}) {
    const Settings settings = settingsWith({{"voxels.axis", axis.c_str()}});
    std::vector<StructureCells> structures, inSteps;
    const std::vector<Frame> few = frames(settings, &structures);
    std::vector<Frame> many;
    withShaders({kInSteps}, [&] { many = frames(settings, &inSteps); });
    ASSERT_EQ(few.size(), many.size());
    for (std::size_t i = 0; i < few.size(); ++i) {
      EXPECT_EQ(few[i].layers.data, many[i].layers.data) << axis << i;
      EXPECT_EQ(few[i].report.overflow, 0u) << axis << i;
      const auto one = listsOf(structures[i]), other = listsOf(inSteps[i]);
      std::size_t both = 0;
      for (const auto& [brick, lists] : one) {
        const auto found = other.find(brick);
        if (found == other.end()) continue;
        ++both;
        EXPECT_TRUE(found->second == lists) << axis << i;
      }
      EXPECT_GT(both, one.size() * 9 / 10) << axis << i;
      EXPECT_LE(one.size(), other.size()) << axis << i << ", a build of few bricks asks for no more";
    }
    EXPECT_GT(structures[3].bricks.size(), structures[0].bricks.size() + 10) << "the camera's moves build";
    if (axis == "own") {
      EXPECT_GT(few.back().report.memory.fragments, few[3].report.memory.fragments) << "those of triangles do";
    }
    EXPECT_LT(few[3].report.memory.fragments, many[3].report.memory.fragments) << "by other steps";
  }
}

TEST_F(Moves, GiveThePictureOfAFirstFrame) {
  const Settings settings = settingsWith({});
  const std::vector<Frame> moved = frames(settings);
  Scene scene = scene_;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (i >= 4) move(scene, kMoves[i - 4]);
    const Camera camera = cameraAt(std::min(static_cast<int>(i), 3));
    EXPECT_EQ(moved[i].layers.data, drawOnce(scene, camera, settings, 80, 60).layers.data) << i;
    if (i > 0) {
      EXPECT_NE(moved[i].layers.data, moved[i - 1].layers.data) << i;
    }
  }
}

// A group has room for two thousand triangles; bricks with more are left to the steps of a first frame.
TEST_F(Moves, ToBricksWithVeryManyTrianglesAreExact) {
  for (int i = 0; i < 6000; ++i) {
    const float x = 0.0001f * static_cast<float>(i % 80), z = 0.0001f * static_cast<float>(i / 80);
    addTriangle(scene_, {x, 0.06f, z}, {x + 0.01f, 0.06f, z}, {x, 0.07f, z + 0.01f}, 1);
  }
  const Settings settings = settingsWith({{"select.fraction", "0.02"}}), all = settingsWith({});
  Renderer renderer = makeRenderer(scene_);
  drawWith(renderer, kAbove, settings, 80, 60);
  const Frame frame = drawWith(renderer, kAbove, all, 80, 60);
  EXPECT_EQ(frame.layers.data, drawOnce(scene_, kAbove, all, 80, 60).layers.data);
  std::uint32_t most = 0;
  for (const StructureCell& brick : renderer.readStructure().bricks) most = std::max(most, brick.entries);
  EXPECT_GT(most, 2048u);
  EXPECT_EQ(frame.report.overflow, 0u);
}

// States of the structure's bricks, and which empty cubes they begin, found by a look at every brick of each cube.
class EmptyCubes : public Moves {
 protected:
  template <class Function>
  void load(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(context.getProcAddress()(name));
  }

  // Of the one structure that there is.
  std::vector<GLuint> readStates() const {
    PFNGLISBUFFERPROC isBuffer = nullptr;
    PFNGLGETOBJECTLABELPROC getLabel = nullptr;
    PFNGLGETNAMEDBUFFERPARAMETERIVPROC getParameter = nullptr;
    load("glIsBuffer", isBuffer);
    load("glGetObjectLabel", getLabel);
    load("glGetNamedBufferParameteriv", getParameter);
    for (GLuint name = 1; name < 10000; ++name) {
      char label[64] = "";
      if (isBuffer(name) == GL_FALSE) continue;
      getLabel(GL_BUFFER, name, sizeof(label), nullptr, label);
      if (std::string(label) != "A-buffer bricks") continue;
      GLint bytes = 0;
      getParameter(name, GL_BUFFER_SIZE, &bytes);
      std::vector<GLuint> states(static_cast<std::size_t>(bytes) / sizeof(GLuint));
      api.GetNamedBufferSubData(name, 0, bytes, states.data());
      return states;
    }
    return {};
  }

  static glm::ivec3 brickCount(const Frame& frame) {
    const auto& voxels = frame.report.memory.grid;
    return glm::ivec3(voxels[0], voxels[1], voxels[2]) / BRICK_SIDE;
  }

  // The largest power of two such that so many bricks along each axis are empty, from `brick` on into `direction`.
  static GLuint emptySide(const std::vector<GLuint>& states, const glm::ivec3& count, const glm::ivec3& brick,
                          GLuint direction) {
    const glm::ivec3 step = 2 * glm::ivec3(direction & 1u, direction >> 1 & 1u, direction >> 2) - 1;
    for (int side = 1; side <= 1 << MAX_EMPTY_SIDE; ++side)
      for (int z = 0; z < side; ++z)
        for (int y = 0; y < side; ++y)
          for (int x = 0; x < side; ++x) {
            if (std::max(x, std::max(y, z)) != side - 1) continue;  // in the smaller cubes
            const glm::ivec3 at = brick + step * glm::ivec3(x, y, z);
            if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, count))) continue;
            if (states[static_cast<std::size_t>(at.x + count.x * (at.y + count.y * at.z))] >= BRICK_EMPTY) continue;
            GLuint power = 0;
            while (2 << power < side) ++power;
            return power;
          }
    return MAX_EMPTY_SIDE;
  }

  // How many states are those of empty bricks with the right cubes.
  static std::size_t expectEmptyCubes(const std::vector<GLuint>& states, const glm::ivec3& count) {
    std::size_t empty = 0, wrong = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] < BRICK_EMPTY) continue;
      ++empty;
      const auto at = static_cast<int>(i);
      const glm::ivec3 brick(at % count.x, at / count.x % count.y, at / (count.x * count.y));
      for (GLuint direction = 0; direction < 8; ++direction)
        wrong += (states[i] >> (EMPTY_SIDE_BITS * direction) & 7u) != emptySide(states, count, brick, direction);
    }
    EXPECT_EQ(wrong, 0u);
    return empty;
  }
};

TEST_F(EmptyCubes, AreEmptyAndAsLargeAsTheyCanBe) {
  for (Vertex& vertex : scene_.vertices) vertex.position.y *= 3;  // room between the triangles
  const Settings settings = settingsWith({{"voxels.resolution", "128"}, {"voxels.per_triangle", "0"}});
  Scene scene = scene_;
  Renderer renderer = makeRenderer(scene);
  const glm::ivec3 count = brickCount(drawWith(renderer, kAbove, settings, 80, 60));
  std::vector<GLuint> before = readStates();
  ASSERT_EQ(before.size(), static_cast<std::size_t>(count.x) * count.y * count.z);
  std::size_t empty = expectEmptyCubes(before, count);
  EXPECT_GT(empty, before.size() / 4);
  EXPECT_LT(empty, before.size());
  for (const Move& by : kMoves) {
    move(scene, by);
    renderer.updateVertices(scene, std::span(&moving_, 1));
    drawWith(renderer, kAbove, settings, 80, 60);
    const std::vector<GLuint> after = readStates();
    const std::size_t left = expectEmptyCubes(after, count);
    EXPECT_LE(left, empty);
    empty = left;
  }
  EXPECT_NE(readStates(), before);
}

}  // namespace
}  // namespace halfsilver::testing
