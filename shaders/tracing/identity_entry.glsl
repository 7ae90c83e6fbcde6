// An identity fragment: triangle number, and its depth range as two 16-bit steps, rounded outwards by a step more than
// needed so that rounding never hides a triangle.
// Room for rounding when depths are compared (grid units).
const float depthSlack = 2.0e-6;

const float depthSteps = 65535.0;

uvec2 packIdentity(uint triangle, vec2 depths) {
  float low = clamp(floor(depths.x * depthSteps) - 1.0, 0.0, depthSteps);
  float high = clamp(ceil(depths.y * depthSteps) + 1.0, 0.0, depthSteps);
  return uvec2(triangle, uint(low) | (uint(high) << 16));
}

vec2 identityDepths(uvec2 entry) { return vec2(float(entry.y & 0xffffu), float(entry.y >> 16)) / depthSteps; }
