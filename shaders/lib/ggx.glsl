// The GGX distribution of microfacets with Smith's shadowing, around z: Walter et al. 2007, Heitz 2014.

// Narrower lobes are mirrors.
bool smoothLobe(float alpha) { return alpha < 1e-3; }

float ggxDistribution(float hz, float alpha) {
  float a2 = alpha * alpha, d = hz * hz * (a2 - 1.0) + 1.0;
  return a2 / (3.14159265358979 * d * d);
}

// Share of the microfacets facing v that are seen from there.
float ggxMasking(float vz, float alpha) {
  float a2 = alpha * alpha;
  return 2.0 * vz / (vz + sqrt(a2 + (1.0 - a2) * vz * vz));
}

// Seen from both sides, heights correlated.
float ggxMaskingShadowing(float vz, float lz, float alpha) {
  float a2 = alpha * alpha, b = 1.0 - a2;
  return 2.0 * vz * lz / (vz * sqrt(a2 + b * lz * lz) + lz * sqrt(a2 + b * vz * vz));
}

// A microfacet's normal, as often as it is seen from v (Heitz 2018, "Sampling the GGX Distribution of Visible
// Normals").
vec3 ggxVisibleNormal(vec3 v, float alpha, vec2 numbers) {
  vec3 stretched = normalize(vec3(alpha * v.xy, v.z));
  float across = dot(stretched.xy, stretched.xy);
  vec3 x = across > 0.0 ? vec3(-stretched.y, stretched.x, 0.0) * inversesqrt(across) : vec3(1.0, 0.0, 0.0);
  vec3 y = cross(stretched, x);
  float radius = sqrt(numbers.x), angle = 6.28318530717959 * numbers.y;
  float s = 0.5 * (1.0 + stretched.z);
  float p = radius * cos(angle), q = radius * sin(angle);
  q = (1.0 - s) * sqrt(max(0.0, 1.0 - p * p)) + s * q;
  vec3 n = p * x + q * y + sqrt(max(0.0, 1.0 - p * p - q * q)) * stretched;
  return normalize(vec3(alpha * n.xy, max(n.z, 1e-6)));
}

#ifdef LOBES
// The same of two roughnesses, along x and y.
float ggxDistribution(vec3 h, vec2 alphas) {
  vec3 scaled = vec3(h.xy / alphas, h.z);
  float d = dot(scaled, scaled);
  return 1.0 / (3.14159265358979 * alphas.x * alphas.y * d * d);
}

float ggxMasking(vec3 v, vec2 alphas) { return 2.0 * v.z / (v.z + length(vec3(alphas * v.xy, v.z))); }

float ggxMaskingShadowing(vec3 v, vec3 l, vec2 alphas) {
  return 2.0 * v.z * l.z / (v.z * length(vec3(alphas * l.xy, l.z)) + l.z * length(vec3(alphas * v.xy, v.z)));
}

vec3 ggxVisibleNormal(vec3 v, vec2 alphas, vec2 numbers) {
  vec3 n = ggxVisibleNormal(normalize(vec3(alphas * v.xy, v.z)), 1.0, numbers);
  return normalize(vec3(alphas * n.xy, max(n.z, 1e-6)));
}

float ggxReflectedDensity(vec3 v, vec3 h, vec2 alphas) {
  return ggxMasking(v, alphas) * ggxDistribution(h, alphas) / (4.0 * v.z);
}
#endif

// Density of directions that are v mirrored at such normals.
float ggxReflectedDensity(float vz, float hz, float alpha) {
  return ggxMasking(vz, alpha) * ggxDistribution(hz, alpha) / (4.0 * vz);
}
