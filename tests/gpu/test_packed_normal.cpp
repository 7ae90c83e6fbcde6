#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "gpu/context_fixture.h"
#include "gpu/shader_function.h"

namespace halfsilver::testing {
namespace {

using glm::vec3;
using glm::vec4;

class PackedNormalTest : public ContextTest {
 protected:
  std::vector<vec4> throughStorage(const std::vector<vec4>& normals) const {
    return ShaderFunction(api, "lib/packed_normal.glsl", "outputs[item] = unpackNormal(packNormal(inputs[item]));", 1,
                          1)
        .run(normals);
  }
};

TEST_F(PackedNormalTest, AxesAndDiagonalsStayAsTheyAre) {
  std::vector<vec4> normals;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      vec4 normal(0, 0, 0, sign);
      normal[axis] = sign;
      normals.push_back(normal);
    }
  normals.emplace_back(0, 0, 1, 0);  // and is not taken for none
  EXPECT_EQ(throughStorage(normals), normals);
  std::vector<vec4> diagonals;
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f})
      for (int zero = 0; zero < 3; ++zero) {
        vec4 diagonal(std::sqrt(0.5f) * x);
        diagonal[(zero + 1) % 3] = std::sqrt(0.5f) * y;
        diagonal[zero] = 0;
        diagonal.w = 0.25f;
        diagonals.push_back(diagonal);
      }
  const std::vector<vec4> found = throughStorage(diagonals);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(found[i][axis], diagonals[i][axis], diagonals[i][axis] == 0 ? 0 : 6e-8f);
}

TEST_F(PackedNormalTest, DirectionsAreOffByATenMillionthOnAverage) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::vector<vec4> inputs;
  for (int i = 0; i < 20000; ++i)
    inputs.emplace_back(glm::normalize(vec3(normal(random), normal(random), normal(random))),
                        static_cast<float>(i % 2001 - 1000) / 1000);
  const std::vector<vec4> found = throughStorage(inputs);
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double off = glm::length(glm::cross(glm::dvec3(glm::vec3(inputs[i])), glm::dvec3(glm::vec3(found[i]))));
    worst = std::max(worst, off);
    sum += off;
    EXPECT_NEAR(found[i].w, inputs[i].w, 1.0001f / 32767);
    EXPECT_LE(std::abs(found[i].w), std::abs(inputs[i].w)) << "a threshold of just that still leaves it out";
  }
  EXPECT_LT(worst, 6e-7);
  EXPECT_LT(sum / static_cast<double>(found.size()), 1.3e-7);
  EXPECT_GT(sum, 0);
}

// What blends ever so little still lets rays go on, and what reflects ever so little reflects.
TEST_F(PackedNormalTest, SmallNumbersKeepTheirSign) {
  const std::vector<vec4> found = throughStorage({{0, 1, 0, 1e-9f}, {0, 1, 0, -1e-9f}, {0, 1, 0, 0}, {0, 1, 0, 3}});
  EXPECT_GT(found[0].w, 0);
  EXPECT_LT(found[1].w, 0);
  EXPECT_EQ(found[2].w, 0);
  EXPECT_EQ(found[3].w, 1);
}

}  // namespace
}  // namespace halfsilver::testing
