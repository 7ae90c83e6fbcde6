#pragma once

#include <halfsilver/image.h>
#include <halfsilver/products.h>

namespace halfsilver {

// Puts a frame together as an image of the contract's layers, rows from the top. `linear` is the blended picture before
// tone mapping (RGBA32F, the G-buffer's size); `rays` and `hits` are the first bounce's, empty if nothing was
// traced. hit.n* is the interpolated vertex normal (or the stored one) on the ray's side. Waits for the GPU.
Image assembleLayers(const GpuScene& scene, const GBuffer& gbuffer, const gl::Texture& linear, const RayQueue& rays,
                     const Hits& hits);

}  // namespace halfsilver
