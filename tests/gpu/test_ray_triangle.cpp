// The exact part of the ray/triangle test: what floats leave undecided on edges and corners.
#include <bit>
#include <cmath>
#include <random>

#include "gl/shader_files.h"
#include "gpu/context_fixture.h"
#include "gpu/shader_function.h"

namespace halfsilver::testing {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;

float rounded(double value) { return static_cast<float>(value); }
float next(float value, int steps) { return std::bit_cast<float>(std::bit_cast<std::int32_t>(value) + steps); }

// a b - c d: products of floats are exact in double.
float reference(float a, float b, float c, float d) {
  return rounded(static_cast<double>(a) * b - static_cast<double>(c) * d);
}

class RayTriangle : public ContextTest {
 protected:
  std::mt19937 random_{11};

  float number(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  float sign() { return random_() % 2 == 0 ? 1.0f : -1.0f; }
};

TEST_F(RayTriangle, ADifferenceOfProductsHasTheBitsOfDoubles) {
  std::vector<vec4> inputs;
  for (int i = 0; i < 60000; ++i) {
    const float scale = std::exp2(std::floor(number(-12, 12)));
    const float a = sign() * scale * number(0.5f, 2),
                b = sign() * number(0.5f, 2) / std::exp2(std::floor(number(-6, 6)));
    // Nearly the same product again: factors that moved by a few units in the last place, in turn, and powers of two.
    const int steps = static_cast<int>(random_() % 9) - 4;
    const float power = std::exp2(std::floor(number(-8, 8)));
    inputs.push_back({a, b, next(b, steps) * power, next(a, static_cast<int>(random_() % 9) - 4) / power});
  }
  for (int i = 0; i < 20000; ++i) {
    // Few bits: products that are exact in floats, and equal now and then.
    const auto whole = [this] { return std::round(number(-6, 6)) * std::exp2(std::round(number(-3, 3))); };
    inputs.push_back({whole(), whole(), whole(), whole()});
  }
  const ShaderFunction difference(
      api, "tracing/common/ray_triangle.glsl",
      "vec4 v = inputs[item];\n"
      "precise float p = v.x * v.y, q = v.z * v.w;\n"
      "outputs[item] = vec4(exactDifference(v.x, v.y, v.z, v.w), exactDifference(v.z, v.w, v.x, v.y), p - q, 0.0);",
      1, 1);
  const std::vector<vec4> found = difference.run(inputs);
  std::size_t undecided = 0, nearlyEqual = 0, wrong = 0, notOpposite = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const vec4& v = inputs[i];
    const float exact = reference(v.x, v.y, v.z, v.w);
    wrong += found[i].x != exact;
    notOpposite += found[i].x != -found[i].y;
    undecided += found[i].z == 0 && exact != 0;
    nearlyEqual += found[i].z != exact;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(notOpposite, 0u) << "both triangles of an edge must see the same";
  EXPECT_GT(undecided, 1000u) << "floats alone would have done";
  EXPECT_GT(nearlyEqual, 20000u);
}

// Fans of triangles around a corner and rays at that corner and at points of the edges that meet there.
TEST_F(RayTriangle, NoRayPassesBetweenTheTrianglesOfAFan) {
  constexpr int kFans = 400, kSides = 7, kRaysPerFan = 24;
  struct Shot {
    int fan, ray;
  };
  std::vector<vec4> inputs;
  std::vector<Shot> shots;
  for (int fan = 0; fan < kFans; ++fan) {
    const vec3 corner(number(-1, 1), number(-1, 1), number(-1, 1));
    vec3 rim[kSides];
    for (int i = 0; i < kSides; ++i) {
      const float angle = 6.2831853f * (static_cast<float>(i) + number(0.1f, 0.9f)) / kSides;
      rim[i] = corner + vec3(std::cos(angle), std::sin(angle), number(-0.3f, 0.3f));
    }
    for (int ray = 0; ray < kRaysPerFan; ++ray) {
      const vec3 origin(number(-2, 2), number(-2, 2), number(3, 4));
      const vec3 target = ray % 3 == 0 ? corner : glm::mix(corner, rim[ray % kSides], number(0, 0.5f));
      const vec3 direction = glm::normalize(target - origin);
      for (int i = 0; i < kSides; ++i) {
        inputs.insert(inputs.end(), {vec4(origin, 0), vec4(direction, 0), vec4(corner, 0), vec4(rim[i], 0),
                                     vec4(rim[(i + 1) % kSides], 0)});
        shots.push_back({fan, ray});
      }
    }
  }
  const ShaderFunction test(api, "tracing/common/ray_triangle.glsl",
                            "uint first = 5u * item;\n"
                            "EdgeTest test = testEdges(makeShear(inputs[first + 1u].xyz), inputs[first].xyz,\n"
                            "  inputs[first + 2u].xyz, inputs[first + 3u].xyz, inputs[first + 4u].xyz);\n"
                            "bool undecided = onEdge(test);\n"
                            "if (undecided) decideEdges(test);\n"
                            "outputs[3u * item] = vec4(test.edges, undecided ? 1.0 : 0.0);\n"
                            "outputs[3u * item + 1u] = vec4(test.a, test.b);\n"
                            "outputs[3u * item + 2u] = vec4(test.c, inside(test) ? 1.0 : 0.0, 0.0);",
                            5, 3);
  const std::vector<vec4> found = test.run(inputs);
  std::vector<int> hits(kFans * kRaysPerFan, 0);
  std::size_t undecided = 0, wrong = 0;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const vec4 edges = found[3 * i], ab = found[3 * i + 1], c = found[3 * i + 2];
    hits[static_cast<std::size_t>(shots[i].fan * kRaysPerFan + shots[i].ray)] += c.z != 0;
    if (edges.w == 0) continue;
    ++undecided;
    wrong += edges.x != reference(c.x, ab.w, c.y, ab.z);
    wrong += edges.y != reference(ab.x, c.y, ab.y, c.x);
    wrong += edges.z != reference(ab.z, ab.y, ab.w, ab.x);
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(undecided, 1000u);
  for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_GT(hits[i], 0) << "ray " << i << " passes";
}

// Doubles are emulated on many devices, where a few of them make programs that take seconds to link.
TEST_F(RayTriangle, NoShaderUsesDoubles) {
  for (const gl::ShaderFile& file : gl::shaderFiles())
    for (const char* word : {"double(", "double ", "dvec"})
      EXPECT_EQ(std::string_view(file.text).find(word), std::string_view::npos) << file.path << " has " << word;
}

}  // namespace
}  // namespace halfsilver::testing
