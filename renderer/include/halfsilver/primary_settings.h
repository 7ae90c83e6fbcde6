#pragma once

// Settings of the camera's rays, see settings.h.
namespace halfsilver {

// Which surface the camera's ray of a pixel meets.
enum class PrimaryHits {
  raster,  // the one that rasterization found there, whether the ray passes beside it or not
  tested   // if its triangle passes the test of rays; else see Multisampling
};
// Whose triangles a pixel's ray is tested against (Robert et al. 2007).
enum class Multisampling {
  none,  // its own alone
  lazy,  // the neighborhood's as well, where its own is missed
  full   // all of the neighborhood's, at every pixel; the nearest hit counts
};

struct PrimarySettings {
  PrimaryHits hits = PrimaryHits::raster;
  Multisampling multisampling = Multisampling::lazy;  // of tested hits; what none of them meets is interpolated
  int neighborhood = 3;                               // pixels along its side, 3..7, odd
  int every = 1;  // one pixel in so many has a ray, 1..8; the others are interpolated

  bool operator==(const PrimarySettings&) const = default;
};

}  // namespace halfsilver
