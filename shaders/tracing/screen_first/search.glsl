// Search of the method that asks the screen first. The space between the camera and what a pixel shows holds no
// surface (none that pixels can tell: parts thinner than a pixel may be missed), so what a ray does there is certain:
//
// - It stays before all that is seen, by the pyramid of nearest depths, or, beside surfaces, on the camera's side of
//   the planes of all triangles that the nine pixels around it show.
// - It ends there: at the exact hit of one of these triangles, or at its end.
//
// A ray that leaves the picture, goes behind something, or comes to where the camera looks through the back of a
// single-sided material is left to the structure.
#include "lib/gbuffer.glsl"
#include "lib/triangles.glsl"
#include "tracing/common/ray_queue.glsl"
#include "tracing/common/screen_ray.glsl"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/walk.glsl"

bool certain = false;

// Steps over cells and between surfaces; drivers stop long loops, and few rays need more.
const int MAX_STEPS = 2000;
const int MAX_CONTACTS = 48;

// Behind a plane by less than this many pixels is before it: the surface bends between the pixels that show it. A ray
// that leaves a curved mirror begins behind its neighbors' planes; where it ends, such parts may hide others.
const float BEHIND_OWN = 1.0, BEHIND_OTHERS = 0.25;

// What the nine pixels around a stretch of the ray say of it.
struct Contact {
  Hit hit;       // nearest on a triangle that they show
  float behind;  // from here on the ray is behind one of them
};

// Where between two distances the ray comes behind the triangle's plane, as the camera sees it.
float comesBehind(TraceRay ray, vec3 a, vec3 b, vec3 c, float from, float to, float slack) {
  vec3 normal = cross(b - a, c - a);
  float size = length(normal);
  float facing = dot(normal, frame.parallel != 0u ? -frame.forward : frame.eye - a);
  normal *= (facing < 0.0 ? -1.0 : 1.0) / (size > 0.0 ? size : 1.0);
  float first = dot(normal, ray.origin + from * ray.direction - a) + slack;
  float last = dot(normal, ray.origin + to * ray.direction - a) + slack;
  if (first < 0.0) return from;
  return last < 0.0 ? from + (to - from) * first / (first - last) : farAway;
}

Contact contactWith(TraceRay ray, ScreenRay s, ivec2 pixel, float from, float to, bool leaving) {
  Contact contact = Contact(Hit(farAway, NO_TRIANGLE, 0.0, 0.0), farAway);
  float depth = max(s.depth + from * s.depthStep, s.depth + to * s.depthStep);
  float slack = (leaving ? BEHIND_OWN : BEHIND_OTHERS) * coneWidth(depth);
  uint last = 0u;
  for (int i = 0; i < 9; ++i) {
    ivec2 other = clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), ivec2(frame.width, frame.height) - 1);
    uint seen = texelFetch(gVisibility, other, 0).x;
    if (seen == 0u || seen == last) continue;
    last = seen;
    vec3 a, b, c;
    trianglePositions(seen - 1u, a, b, c);
    contact.behind = min(contact.behind, comesBehind(ray, a, b, c, from, to, slack));
    testCandidate(ray, seen - 1u, contact.hit);
  }
  return contact;
}

bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  ScreenRay s = onScreen(ray);
  ivec2 screen = ivec2(frame.width, frame.height);
  vec2 range = seenRange(s, vec2(0.0, end));
  if (range.x > 0.0 || range.y <= 0.0) return true;
  float t = 0.0, from = 0.0;
  ivec2 pixel = clamp(pixelAt(s, t), ivec2(0), screen - 1), met = pixel;
  int level = 0, steps = 0, contacts = 0;
  bool going = true, leaving = true;  // leaving: it has been beside surfaces all the time
  while (going) {
    bool beside = false, throughBack = false;
    while (going && !beside && steps < MAX_STEPS) {
      int size = 1 << level;
      ivec2 low = (pixel >> level) << level;
      float exitX = leaves(s.start.x, s.step.x, s.start.w, s.step.w, low.x, size, s.way.x, frame.width);
      float exitY = leaves(s.start.y, s.step.y, s.start.w, s.step.w, low.y, size, s.way.y, frame.height);
      float exit = clamp(min(exitX, exitY), t, range.y);
      float farthest = s.depth + (s.depthStep > 0.0 ? exit : t) * s.depthStep;
      float nearest = texelFetch(screenDepths, pixel >> level, level).r;
      bool before = farthest < abs(nearest);
      if (!before && level > 0) {
        --level;
      } else {
        beside = !before;
        leaving = leaving && beside;
        throughBack = nearest < 0.0;
        met = pixel;
        ivec2 next = clamp(pixelAt(s, exit), low, low + size - 1);
        if (exitX <= exitY) next.x = s.way.x > 0 ? low.x + size : low.x - 1;
        else next.y = s.way.y > 0 ? low.y + size : low.y - 1;
        from = t;
        t = exit;
        level = before ? min(level + 1, SCREEN_LEVELS - 1) : 0;
        pixel = next;
        going = exit < range.y && all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, screen));
      }
      ++steps;
    }
    if (steps >= MAX_STEPS || ++contacts > MAX_CONTACTS) return true;
    if (beside) {
      Contact contact = contactWith(ray, s, met, from, t, leaving);
      if (throughBack) contact.behind = from;
      if (contact.hit.t <= min(t, contact.behind)) {
        best = contact.hit;
        certain = true;
        return true;
      }
      if (contact.behind <= t) return true;
    }
  }
  certain = t >= end;
  return true;
}

// HIT_NOT_TRACED: left to the structure.
void storeSurface(uint index, Hit hit) {
  if (!certain) hits[index].t = HIT_NOT_TRACED;
}
