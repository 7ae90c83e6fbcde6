// Joins a frame with what earlier ones showed of the same surfaces. A pixel's own light and what it reflects move
// differently, so each is followed by itself: the first with the surface, the second with the image behind it.
#include "lib/history.glsl"
#include "lib/pixel_light.glsl"

layout(local_size_x = TEMPORAL_GROUP, local_size_y = TEMPORAL_GROUP) in;

layout(binding = UNIT_MOTION) uniform sampler2D gMotion;
layout(binding = UNIT_REFLECTION_MOTION) uniform sampler2D reflectionMotion;
layout(binding = UNIT_PAST_FRAMES) uniform usampler2DArray pastFrames;
layout(binding = UNIT_COUNTS_BEFORE) uniform sampler2D countsBefore;
layout(binding = UNIT_DEPTHS_BEFORE) uniform sampler2D depthsOfBefore;
layout(rgba32f, binding = IMAGE_MEAN) uniform image2D meanImage;
layout(rg32ui, binding = IMAGE_FRAME) uniform writeonly uimage2DArray frameImage;
layout(rg8, binding = IMAGE_COUNTS) uniform writeonly image2D countImage;
layout(rg32f, binding = IMAGE_DEPTHS) uniform writeonly image2D depthImage;

uniform int history;                    // HISTORY_...
uniform int number;                     // of this frame, modulo TEMPORAL_FRAMES
uniform vec2 jitters[TEMPORAL_FRAMES];  // of this frame, of the one before, and so on
uniform vec3 previousEye;               // of the frame before
uniform vec3 previousForward;

const int TILE = TEMPORAL_GROUP + 2;  // a group's pixels and their neighbors
shared vec3 surfaces[TILE * TILE];
shared vec3 reflections[TILE * TILE];
shared vec2 depths[TILE * TILE];  // as IMAGE_DEPTHS

const float MOST_FRAMES = float(TEMPORAL_FRAMES);
const float MOST_STILL_FRAMES = 4096.0;
const float DEVIATIONS = 1.25;  // of the neighborhood that a history may show

int tileIndex(ivec2 at) { return at.y * TILE + at.x; }

void loadTile() {
  ivec2 size = ivec2(frame.width, frame.height);
  for (int i = int(gl_LocalInvocationIndex); i < TILE * TILE; i += TEMPORAL_GROUP * TEMPORAL_GROUP) {
    ivec2 pixel = ivec2(gl_WorkGroupID.xy) * TEMPORAL_GROUP - 1 + ivec2(i % TILE, i / TILE);
    pixel = clamp(pixel, ivec2(0), size - 1);
    PixelLight light = pixelLight(pixel);
    surfaces[i] = light.surface;
    reflections[i] = light.reflected;
    depths[i] = vec2(min(drawnDepth(pixel), VERY_FAR), texelFetch(reflectionMotion, pixel, 0).z);
  }
}

bool inside(vec2 at) { return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(frame.width, frame.height))); }

// The depths of the four samples around a place in the frame before.
void depthsBefore(vec2 at, out DepthRange surface, out DepthRange image) {
  surface = image = NO_DEPTHS;
  ivec2 corner = ivec2(floor(at - jitters[1] - 0.5)), last = ivec2(frame.width, frame.height) - 1;
  for (int i = 0; i < 4; ++i) {
    vec2 depth = texelFetch(depthsOfBefore, clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), last), 0).xy;
    surface = extended(surface, depth.x);
    image = extended(image, depth.y);
  }
}

// Sum of what up to `frames` frames before this one showed at a place that is followed back from frame to frame, and
// how many they are. Every frame is read where its own samples lie: nothing is ever resampled. `what`: LAYER_...
vec4 past(vec2 at, float frames, int what) {
  const float ROUNDING = 1.0 / 32.0;  // of a count that was stored in eight bits; frames beyond it are none of its own
  ivec2 last = ivec2(frame.width, frame.height) - 1;
  vec4 sum = vec4(0.0);
  for (int age = 1; age < TEMPORAL_FRAMES; ++age) {
    float counted = min(frames - float(age - 1), 1.0);
    if (counted <= ROUNDING || !inside(at)) break;
    int layer = 2 * ((number + TEMPORAL_FRAMES - age) % TEMPORAL_FRAMES) + what;
    vec2 place = at - jitters[age] - 0.5;
    ivec2 corner = ivec2(floor(place));
    vec2 between = place - vec2(corner), next = shareOfNext(between);
    ivec2 nearest = ivec2(round(between));
    uint motion = 0u;
    for (int i = 0; i < 4; ++i) {
      ivec2 side = ivec2(i & 1, i >> 1);
      vec2 weights = mix(1.0 - next, next, vec2(side));
      float weight = weights.x * weights.y;
      if (weight <= 0.0) continue;
      uvec2 texel = texelFetch(pastFrames, ivec3(clamp(corner + side, ivec2(0), last), layer), 0).xy;
      sum.rgb += counted * weight * unpackRadiance(texel.x);
      if (side == nearest) motion = texel.y;
    }
    sum.a += counted;
    at -= unpackHalf2x16(motion);
  }
  return sum;
}

// A mean over frames and their number. `single`: this pixel's sample alone. `at`: where the frame before shows the
// same, or outside the picture if it does not.
vec4 joined(vec3 now, vec3 single, vec2 at, int what, Neighborhood around) {
  if (!inside(at)) return vec4(single, 1.0);
  ivec2 last = ivec2(frame.width, frame.height) - 1;
  float count = texelFetch(countsBefore, clamp(ivec2(floor(at - jitters[1])), ivec2(0), last), 0)[what];
  vec4 sum = past(at, min(MOST_FRAMES * count, MOST_FRAMES - 1.0), what);
  if (sum.a <= 0.0) return vec4(single, 1.0);
  vec3 old = sum.rgb / sum.a, mean, perceived = toPerceived(old, frame.exposure);
  float strange = strangeness(perceived, around, DEVIATIONS, mean);
  if (strange > 1.0) {
    // To the nearest within the spread, on the line to the mean.
    old = fromPerceived(mean + (perceived - mean) / strange, frame.exposure);
    sum.a /= strange * strange;
  }
  return vec4(mix(old, now, 1.0 / (sum.a + 1.0)), sum.a + 1.0);
}

struct Joined {
  vec4 surface, reflected;  // see joined()
  vec2 surfaceMotion, reflectedMotion;
};

Joined followed(ivec2 pixel, ivec2 center) {
  Neighborhood surfacesAround = Neighborhood(vec3(0.0), vec3(0.0), 9.0), reflectionsAround = surfacesAround;
  DepthRange surfaceRange = NO_DEPTHS, imageRange = NO_DEPTHS;
  ivec2 nearest = ivec2(0);
  float least = 2.0 * VERY_FAR;
  bool reflects = true;  // all of the neighborhood
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      int i = tileIndex(center + ivec2(x, y));
      vec3 s = toPerceived(surfaces[i], frame.exposure), r = toPerceived(reflections[i], frame.exposure);
      surfacesAround.sum += s;
      surfacesAround.squares += s * s;
      reflectionsAround.sum += r;
      reflectionsAround.squares += r * r;
      surfaceRange = extended(surfaceRange, depths[i].x);
      imageRange = extended(imageRange, depths[i].y);
      if (depths[i].x < least) {
        least = depths[i].x;
        nearest = ivec2(x, y);
      }
      reflects = reflects && depths[i].y > 0.0;
    }

  const vec2 NOWHERE = vec2(-1.0);
  vec2 here = vec2(pixel) + 0.5;
  ivec2 last = ivec2(frame.width, frame.height) - 1;
  // Edges move with what is in front.
  ivec2 leading = clamp(pixel + nearest, ivec2(0), last);
  vec2 surfaceAt = here - texelFetch(gMotion, leading, 0).xy;
  DepthRange surfaceBefore, imageBefore;
  depthsBefore(surfaceAt, surfaceBefore, imageBefore);
  if (least < VERY_FAR) {
    // How much nearer the camera has come.
    float ratio = dot(drawnPoint(leading) - previousEye, previousForward) / least;
    surfaceRange.low *= ratio;
    if (surfaceRange.high < VERY_FAR) surfaceRange.high *= ratio;
  }
  bool uncovered = apart(surfaceRange, surfaceBefore);
  Joined found;
  found.surfaceMotion = found.reflectedMotion = here - surfaceAt;
  if (uncovered) surfaceAt = NOWHERE;
  // This frame at the pixel's center, as past() reads others.
  ivec2 corner = center + ivec2(floor(-jitters[0]));
  vec2 next = shareOfNext(fract(-jitters[0]));
  vec3 surfaceNow = vec3(0.0), reflectedNow = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 side = ivec2(i & 1, i >> 1);
    vec2 weights = mix(1.0 - next, next, vec2(side));
    surfaceNow += weights.x * weights.y * surfaces[tileIndex(corner + side)];
    reflectedNow += weights.x * weights.y * reflections[tileIndex(corner + side)];
  }
  found.surface = joined(surfaceNow, surfaces[tileIndex(center)], surfaceAt, LAYER_SURFACE, surfacesAround);
  found.reflected = vec4(vec3(0.0), found.surface.a);
  if (reflectionsAround.sum.x <= 0.0) return found;

  vec2 imageAt = surfaceAt;  // also of a mirror's edge
  if (reflects) {
    vec4 image = texelFetch(reflectionMotion, pixel, 0);
    imageAt = here - image.xy;
    found.reflectedMotion = image.xy;
    depthsBefore(imageAt, surfaceBefore, imageBefore);
    float ratio = image.w / image.z;
    imageRange.low *= ratio;
    if (imageRange.high < VERY_FAR) imageRange.high *= ratio;
    if (uncovered || imageBefore.high <= 0.0 || apart(imageRange, imageBefore)) imageAt = NOWHERE;
  }
  found.reflected = joined(reflectedNow, reflections[tileIndex(center)], imageAt, LAYER_REFLECTED, reflectionsAround);
  return found;
}

void main() {
  loadTile();
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), center = ivec2(gl_LocalInvocationID.xy) + 1;
  if (any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return;
  vec3 surface = surfaces[tileIndex(center)], reflected = reflections[tileIndex(center)];
  vec4 mean = vec4(surface + reflected, 1.0);
  vec2 counts = vec2(1.0);
  vec2 surfaceMotion = vec2(0.0), reflectedMotion = vec2(0.0);
  if (history == HISTORY_STILL) {
    vec4 before = imageLoad(meanImage, pixel);
    float frames = min(before.a, MOST_STILL_FRAMES - 1.0);
    mean = vec4(before.rgb + (mean.rgb - before.rgb) / (frames + 1.0), frames + 1.0);
    counts += MOST_FRAMES * texelFetch(countsBefore, pixel, 0).xy;
  } else if (history == HISTORY_MOVING) {
    Joined found = followed(pixel, center);
    mean = vec4(found.surface.rgb + found.reflected.rgb, min(found.surface.a, found.reflected.a));
    counts = vec2(found.surface.a, found.reflected.a);
    surfaceMotion = found.surfaceMotion;
    reflectedMotion = found.reflectedMotion;
  }
  imageStore(meanImage, pixel, mean);
  imageStore(frameImage, ivec3(pixel, 2 * number + LAYER_SURFACE), packSample(surface, surfaceMotion).xyxy);
  imageStore(frameImage, ivec3(pixel, 2 * number + LAYER_REFLECTED), packSample(reflected, reflectedMotion).xyxy);
  imageStore(countImage, pixel, vec4(counts / MOST_FRAMES, 0.0, 0.0));
  imageStore(depthImage, pixel, vec4(depths[tileIndex(center)], 0.0, 0.0));
}
