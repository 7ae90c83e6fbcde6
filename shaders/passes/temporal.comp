// Joins a frame with what earlier ones showed of the same surfaces. A pixel's own light and what it reflects move
// differently, so each has a history of its own: the first follows the surface, the second the image behind it.
#include "lib/history.glsl"
#include "lib/pixel_light.glsl"

layout(local_size_x = TEMPORAL_GROUP, local_size_y = TEMPORAL_GROUP) in;

layout(binding = UNIT_MOTION) uniform sampler2D gMotion;
layout(binding = UNIT_REFLECTION_MOTION) uniform sampler2D reflectionMotion;
layout(binding = UNIT_SURFACE_HISTORY) uniform sampler2D surfaceHistory;
layout(binding = UNIT_REFLECTED_HISTORY) uniform sampler2D reflectedHistory;
layout(binding = UNIT_DEPTH_HISTORY) uniform sampler2D depthHistory;
layout(rgba32f, binding = IMAGE_SURFACE) uniform writeonly image2D surfaceImage;
layout(rgba32f, binding = IMAGE_REFLECTED) uniform writeonly image2D reflectedImage;
layout(rg32f, binding = IMAGE_DEPTHS) uniform writeonly image2D depthImage;

uniform int history;          // HISTORY_...
uniform vec3 previousEye;     // of the frame before
uniform vec3 previousForward;

const int TILE = TEMPORAL_GROUP + 2;  // a group's pixels and their neighbors
shared vec3 surfaces[TILE * TILE];
shared vec3 reflections[TILE * TILE];
shared vec2 depths[TILE * TILE];  // as UNIT_DEPTH_HISTORY

const float MOST_FRAMES = 16.0;       // of a history that has moved
const float MOST_STILL_FRAMES = 4096.0;
const float DEVIATIONS = 1.25;         // of the neighborhood that a history may show

int tileIndex(ivec2 at) { return at.y * TILE + at.x; }

void loadTile() {
  ivec2 size = ivec2(frame.width, frame.height);
  for (int i = int(gl_LocalInvocationIndex); i < TILE * TILE; i += TEMPORAL_GROUP * TEMPORAL_GROUP) {
    ivec2 pixel = ivec2(gl_WorkGroupID.xy) * TEMPORAL_GROUP - 1 + ivec2(i % TILE, i / TILE);
    pixel = clamp(pixel, ivec2(0), size - 1);
    PixelLight light = pixelLight(pixel);
    float depth = texelFetch(gPosition, pixel, 0).w;
    surfaces[i] = light.surface;
    reflections[i] = light.reflected;
    depths[i] = vec2(depth > 0.0 ? depth : VERY_FAR, texelFetch(reflectionMotion, pixel, 0).z);
  }
}

bool inside(vec2 at) { return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(frame.width, frame.height))); }

// The depths of the four texels around a place in the frame before.
void depthsBefore(vec2 at, out DepthRange surface, out DepthRange image) {
  surface = image = NO_DEPTHS;
  ivec2 corner = ivec2(floor(at - 0.5)), last = ivec2(frame.width, frame.height) - 1;
  for (int i = 0; i < 4; ++i) {
    vec2 depth = texelFetch(depthHistory, clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), last), 0).xy;
    surface = extended(surface, depth.x);
    image = extended(image, depth.y);
  }
}

// A new mean and its count. `at`: where the history lies, or outside the picture if there is none.
vec4 joined(vec3 now, sampler2D before, vec2 at, Neighborhood around) {
  if (!inside(at)) return vec4(now, 1.0);
  float frames = min(texelFetch(before, ivec2(at), 0).a, MOST_FRAMES - 1.0);
  vec3 mean, old = toPerceived(smoothHistory(before, at), frame.exposure);
  float strange = strangeness(old, around, DEVIATIONS, mean);
  if (strange > 1.0) {
    // To the nearest within the spread, on the line to the mean.
    old = mean + (old - mean) / strange;
    frames /= strange;
  }
  return vec4(mix(fromPerceived(old, frame.exposure), now, 1.0 / (frames + 1.0)), frames + 1.0);
}

vec4 continued(vec3 now, vec4 before) {
  float frames = min(before.a, MOST_STILL_FRAMES - 1.0);
  return vec4(before.rgb + (now - before.rgb) / (frames + 1.0), frames + 1.0);
}

void followed(ivec2 pixel, ivec2 center, out vec4 surface, out vec4 reflected) {
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
  vec4 position = texelFetch(gPosition, leading, 0);
  if (position.w > 0.0) {
    // How much nearer the camera has come.
    float ratio = dot(position.xyz - previousEye, previousForward) / position.w;
    surfaceRange.low *= ratio;
    if (surfaceRange.high < VERY_FAR) surfaceRange.high *= ratio;
  }
  bool uncovered = apart(surfaceRange, surfaceBefore);
  if (uncovered) surfaceAt = NOWHERE;
  surface = joined(surfaces[tileIndex(center)], surfaceHistory, surfaceAt, surfacesAround);

  vec2 imageAt = surfaceAt;  // also of a mirror's edge
  if (reflects) {
    vec4 image = texelFetch(reflectionMotion, pixel, 0);
    imageAt = here - image.xy;
    depthsBefore(imageAt, surfaceBefore, imageBefore);
    float ratio = image.w / image.z;
    imageRange.low *= ratio;
    if (imageRange.high < VERY_FAR) imageRange.high *= ratio;
    if (uncovered || imageBefore.high <= 0.0 || apart(imageRange, imageBefore)) imageAt = NOWHERE;
  }
  reflected = joined(reflections[tileIndex(center)], reflectedHistory, imageAt, reflectionsAround);
}

void main() {
  loadTile();
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), center = ivec2(gl_LocalInvocationID.xy) + 1;
  if (any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return;
  vec4 surface = vec4(surfaces[tileIndex(center)], 1.0), reflected = vec4(reflections[tileIndex(center)], 1.0);
  if (history == HISTORY_STILL) {
    surface = continued(surface.rgb, texelFetch(surfaceHistory, pixel, 0));
    reflected = continued(reflected.rgb, texelFetch(reflectedHistory, pixel, 0));
  } else if (history == HISTORY_MOVING) {
    followed(pixel, center, surface, reflected);
  }
  imageStore(surfaceImage, pixel, surface);
  imageStore(reflectedImage, pixel, reflected);
  imageStore(depthImage, pixel, vec4(depths[tileIndex(center)], 0.0, 0.0));
}
