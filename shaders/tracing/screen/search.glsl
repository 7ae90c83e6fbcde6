// Search of the screen-space method: the ray's way over the screen, pixel by pixel and exact in perspective, in large
// steps where it stays before all surfaces. In a pixel it is tested against the triangle that the pixel shows, so most
// hits are where geometry has them; where triangles are smaller than pixels, it is enough that the ray crosses the
// pixel's depth. What the camera does not see is not there.
#include "lib/surface_point.glsl"
#include "shared/rays.h"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/screen_ray.glsl"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

// A ray may cross the depths of the surface that it begins on without leaving it.
const int OWN_PIXELS = 3;

// Where the ray is as far away as the pixel's surface, if that is between the two distances.
bool crossesDepth(ScreenRay s, ivec2 pixel, float from, float to) {
  float shown = surfacePoint(pixel).w;
  float first = s.depth + from * s.depthStep, last = s.depth + to * s.depthStep;
  return shown > 0.0 && shown >= min(first, last) && shown <= max(first, last) && s.depthStep != 0.0;
}

Hit crossing(ScreenRay s, ivec2 pixel, uint triangle) {
  TrianglePoint shown = pointOnTriangle(triangle, pixelOrigin(pixel), pixelRay(pixel));
  float t = (dot(shown.relative, frame.forward) - s.depth) / s.depthStep;
  return Hit(t, triangle, shown.barycentrics.x, shown.barycentrics.y);
}

// The nearest hit, in that range, on what a pixel and its neighbors show.
Hit nearestAround(TraceRay ray, ivec2 pixel, int reach, vec2 range) {
  Hit nearest = Hit(farAway, NO_TRIANGLE, 0.0, 0.0);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(frame.width, frame.height) - 1);
      uint seen = texelFetch(gVisibility, other, 0).x;
      Hit found = Hit(farAway, NO_TRIANGLE, 0.0, 0.0);
      if (seen != 0u) testCandidate(ray, seen - 1u, found);
      if (found.t >= range.x && found.t <= range.y && found.t < nearest.t) nearest = found;
    }
  return nearest;
}

bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  ScreenRay s = onScreen(ray);
  ivec2 screen = ivec2(frame.width, frame.height);
  vec2 range = seenRange(s, vec2(max(pause.t, 0.0), end));
  float t = range.x;
  ivec2 pixel = clamp(pixelAt(s, t), ivec2(0), screen - 1);
  int level = 0, work = 0, pixels = int(pause.tested);
  ivec2 met = pixel;
  bool going = t < range.y;
  uint candidate = NO_TRIANGLE;
  float exit = t;
  while (going) {
    while (going && candidate == NO_TRIANGLE && work < workLimit) {
      countStep();
      int size = 1 << level;
      ivec2 low = (pixel >> level) << level;
      float exitX = leaves(s.start.x, s.step.x, s.start.w, s.step.w, low.x, size, s.way.x, frame.width);
      float exitY = leaves(s.start.y, s.step.y, s.start.w, s.step.w, low.y, size, s.way.y, frame.height);
      exit = clamp(min(exitX, exitY), t, range.y);
      float farthest = s.depth + (s.depthStep > 0.0 ? exit : t) * s.depthStep;
      bool before = farthest < texelFetch(screenDepths, pixel >> level, level).r;
      if (!before && level > 0) {
        --level;
      } else {
        // A triangle that is seen here may be hit, by a ray that is not before everything.
        if (!before) {
          uint seen = texelFetch(gVisibility, pixel, 0).x;
          countTest();
          bool crosses = pixels > OWN_PIXELS && seen - 1u != ray.excluded && crossesDepth(s, pixel, t, exit);
          if (seen != 0u && (crosses || mayHit(ray, seen - 1u, farAway))) candidate = seen - 1u;
          met = pixel;
        }
        ++pixels;
        ivec2 next = clamp(pixelAt(s, exit), low, low + size - 1);
        if (exitX <= exitY) next.x = s.way.x > 0 ? low.x + size : low.x - 1;
        else next.y = s.way.y > 0 ? low.y + size : low.y - 1;
        if (candidate == NO_TRIANGLE) {
          t = exit;
          level = before ? min(level + 1, SCREEN_LEVELS - 1) : 0;
        }
        pixel = next;
        going = exit < range.y && all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, screen));
      }
      ++work;
    }
    if (candidate != NO_TRIANGLE) {
      // Seen at the pixel's center, it may be met in a neighbor.
      float slack = 1.5 * (exit - t);
      vec2 around = vec2(t - slack, exit + slack);
      bool crosses = pixels > OWN_PIXELS + 1 && candidate != ray.excluded && crossesDepth(s, met, t, exit);
      Hit found = nearestAround(ray, met, crosses ? 1 : 0, around);
      if (found.triangle == NO_TRIANGLE && crosses) found = crossing(s, met, candidate);
      if (found.triangle != NO_TRIANGLE && found.t >= ray.least) {
        best = found;
        going = false;
      }
      candidate = NO_TRIANGLE;
      t = exit;
      level = 0;
    }
    if (going && work >= workLimit) {
      pause = PausedRay(t, 0u, uint(pixels), 0u);
      return false;
    }
  }
  return true;
}

void storeSurface(uint index, Hit hit) {}
