#pragma once

#include <halfsilver/scene.h>
#include <halfsilver/tracer.h>

namespace halfsilver {

// Exact rays on the CPU with Embree 3: the reference of every comparison, and the fast method where GL runs in
// software. Rays are read back, traced by `threads` threads (0: one per core) beside the rest of the frame and their
// hits uploaded, so everything but the intersection is the same as in the other methods: distances, excluded triangle,
// back faces, alpha cuts. What has never moved keeps a hierarchy that is made to trace fast; what has is in a second
// one, which every move builds again. Hits are those of one hierarchy.
//
// The factory keeps a reference: the scene must outlive the renderer that uses it and hold the vertices and materials
// that the renderer was given last.
TracerFactory makeExactTracerFactory(const Scene& scene, int threads = 0);

}  // namespace halfsilver
