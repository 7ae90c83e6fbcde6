#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <halfsilver/products.h>
#include <halfsilver/scene.h>
#include <halfsilver/scene_change.h>

namespace halfsilver {

// The whole scene in GPU memory; the caller's copy is not needed afterwards. `posed`: what will be posed on the GPU,
// see SceneExtents. Throws Error (badInput) if an index of the scene points nowhere and Error (failed) if the device
// cannot hold it.
GpuScene uploadScene(const gl::Api& api, const Scene& scene, std::vector<PosedPart> posed = {});

// Uploads what changed in the scene that was uploaded: moved vertices, the sky, the values of materials. Throws Error
// (usage) if the scene has other counts of vertices, triangles, materials or textures, before anything is written.
// Returns the bounds of what moved, before and after, a few hundred triangles at a time.
std::vector<Bounds> updateScene(const gl::Api& api, GpuScene& gpu, const Scene& scene, const SceneChange& change);

// Vertices from `first` on.
void writeVertices(GpuScene& gpu, std::span<const Vertex> vertices, std::size_t first);

// Has triangles wind the other way round, or throws before any does. Reads them back: waits for the GPU.
void turnTriangles(GpuScene& gpu, const TriangleRange& range);

}  // namespace halfsilver
