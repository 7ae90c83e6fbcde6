#pragma once

#include <array>

namespace halfsilver {

enum class CubeDepth { half, single };
enum class CubeAxes {
  own,  // a triangle is seen along the axis that it faces most
  all   // along all three
};
enum class CubePosition {
  plane,  // where the ray meets the plane of the sample that it has come near
  sample  // where it comes near it
};
constexpr auto choiceNames(CubePosition) { return std::array{"plane", "sample"}; }
constexpr auto choiceNames(CubeDepth) { return std::array{"half", "single"}; }
constexpr auto choiceNames(CubeAxes) { return std::array{"own", "all"}; }

// Settings of trace.method=depth-cube: layered depth images along three axes (Buerger et al. 2007).
struct DepthCubeSettings {
  CubeDepth depth = CubeDepth::single;  // floating-point format in which depths are kept
  CubeAxes axes = CubeAxes::own;
  CubePosition position = CubePosition::plane;  // of a hit
  int layers = 64;                              // at most, 1..512; rays that come by what lies behind are overflow
  int block = 8;                                // texels along each side of a block with its range of depths, 2..32
  float tolerance = 0.001f;  // 0..1, of the scene's longest side: how near to a sample a ray meets it

  bool operator==(const DepthCubeSettings&) const = default;

  // visit(name, value, low, high, help) for each setting, see settings.cpp.
  template <class Self, class Visitor>
  static void visit(Self& s, Visitor&& visit) {
    visit("cube.depth", s.depth, 0, 0, "how depths are kept: in 16 or 32 bits (depth-cube)");
    visit("cube.axes", s.axes, 0, 0, "along which axes a triangle is stored (depth-cube)");
    visit("cube.position", s.position, 0, 0, "where along the ray a hit lies (depth-cube)");
    visit("cube.layers", s.layers, 1, 512, "layers at most (depth-cube)");
    visit("cube.block", s.block, 2, 32, "texels along each side of a block (depth-cube)");
    visit("cube.tolerance", s.tolerance, 0, 1, "a ray meets samples so near, of the scene's longest side (depth-cube)");
  }
};

}  // namespace halfsilver
