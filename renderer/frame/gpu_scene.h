#pragma once

#include <span>

#include <halfsilver/model.h>
#include <halfsilver/products.h>
#include <halfsilver/scene.h>

namespace halfsilver {

// The whole scene in GPU memory; the caller's copy is not needed afterwards. Throws Error (badInput) where an index of
// the scene points nowhere and Error (failed) where the device cannot hold it.
GpuScene uploadScene(const gl::Api& api, const Scene& scene);

// Uploads moved vertices of the scene that was uploaded; everything but their attributes is unchanged.
void updateVertices(GpuScene& gpu, const Scene& scene, std::span<const VertexRange> ranges);

}  // namespace halfsilver
