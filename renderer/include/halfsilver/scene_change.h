#pragma once

#include <vector>

#include <halfsilver/model.h>

namespace halfsilver {

// What changed in a scene from one frame to the next. A camera that moves changes nothing of it.
struct SceneChange {
  bool topology = false;   // another scene: nothing of the old one holds
  bool materials = false;  // their values; triangles keep the material that they name
  bool lights = false;     // the list of lights
  bool sky = false;
  std::vector<VertexRange> moved{};     // vertices with new positions, normals or tangents
  std::vector<TriangleRange> turned{};  // triangles that wind the other way round; their vertices are among the moved

  // Whether a triangle may be elsewhere than before.
  bool geometry() const { return topology || !moved.empty(); }
  bool any() const { return geometry() || materials || lights || sky; }

  // Adds a later change.
  void add(const SceneChange& later) {
    topology = topology || later.topology;
    materials = materials || later.materials;
    lights = lights || later.lights;
    sky = sky || later.sky;
    moved.insert(moved.end(), later.moved.begin(), later.moved.end());
    turned.insert(turned.end(), later.turned.begin(), later.turned.end());
    if (!topology) return;
    moved.clear();  // nothing has stayed where it was
    turned.clear();
  }

  static SceneChange everything() { return {true, true, true, true, {}, {}}; }
};

}  // namespace halfsilver
