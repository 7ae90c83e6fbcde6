// Search of the screen-space method: the ray's way over the screen, pixel by pixel and exact in perspective, in large
// steps where it stays before all surfaces. In a pixel it is tested against the triangle that the pixel shows, so most
// hits are where geometry has them; where triangles are smaller than pixels, it is enough that the ray crosses the
// pixel's depth. What the camera does not see is not there.
#include "lib/gbuffer.glsl"
#include "lib/triangle_point.glsl"
#include "shared/passes/screen.h"
#include "shared/rays.h"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

layout(binding = UNIT_SCREEN_DEPTHS) uniform sampler2D screenDepths;

// A ray in clip space and its depth along the view axis, both linear in t.
struct ScreenRay {
  vec4 start;
  vec4 step;
  float depth;
  float depthStep;
  ivec2 way;  // -1, 0 or 1: it keeps to it all the time
};

ScreenRay onScreen(TraceRay ray) {
  ScreenRay s;
  s.start = frame.viewProjection * vec4(ray.origin, 1.0);
  s.step = frame.viewProjection * vec4(ray.direction, 0.0);
  s.depth = dot(ray.origin - frame.eye, frame.forward);
  s.depthStep = dot(ray.direction, frame.forward);
  s.way = ivec2(sign(s.step.xy * s.start.w - s.start.xy * s.step.w));
  return s;
}

// Cuts the range to where start + t * step is at least 0.
void cutRange(float start, float step, inout vec2 range) {
  float t = -start / step;
  if (step > 0.0) range.x = max(range.x, t);
  if (step < 0.0) range.y = min(range.y, t);
  if (step == 0.0 && start < 0.0) range.y = -1.0;
}

// The part of the range that the camera sees.
vec2 seenRange(ScreenRay s, vec2 range) {
  cutRange(s.start.w - s.start.x, s.step.w - s.step.x, range);
  cutRange(s.start.w + s.start.x, s.step.w + s.step.x, range);
  cutRange(s.start.w - s.start.y, s.step.w - s.step.y, range);
  cutRange(s.start.w + s.start.y, s.step.w + s.step.y, range);
  cutRange(s.depth - frame.drawnNear, s.depthStep, range);
  return range;
}

ivec2 pixelAt(ScreenRay s, float t) {
  vec4 place = s.start + t * s.step;
  return ivec2(floor((0.5 * place.xy / place.w + 0.5) * vec2(frame.width, frame.height)));
}

// Where the ray leaves the columns or rows from `low` on, `size` of them. Those around its vanishing point it never
// does.
float leaves(float start, float step, float w, float wStep, int low, int size, int way, uint across) {
  float edge = 2.0 * float(way > 0 ? low + size : low) / float(across) - 1.0;
  float approach = step - edge * wStep;
  return approach * float(way) > 0.0 ? (edge * w - start) / approach : farAway;
}

// A ray may cross the depths of the surface that it begins on without leaving it.
const int OWN_PIXELS = 3;

// Where the ray is as far away as the pixel's surface, if that is between the two distances.
bool crossesDepth(ScreenRay s, ivec2 pixel, float from, float to) {
  float shown = texelFetch(gPosition, pixel, 0).w;
  float first = s.depth + from * s.depthStep, last = s.depth + to * s.depthStep;
  return shown > 0.0 && shown >= min(first, last) && shown <= max(first, last) && s.depthStep != 0.0;
}

Hit crossing(ScreenRay s, ivec2 pixel, uint triangle) {
  float t = (texelFetch(gPosition, pixel, 0).w - s.depth) / s.depthStep;
  vec2 place = pointOnTriangle(triangle, pixelOrigin(pixel), pixelRay(pixel)).barycentrics;
  return Hit(t, triangle, place.x, place.y);
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
