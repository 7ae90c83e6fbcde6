// A smooth border between two media that do not conduct.

struct Interface {
  vec3 refracted;     // unit; the mirror direction if nothing passes
  float reflectance;  // of unpolarized light; 1: total internal reflection
};

// direction: unit, towards the surface; normal: unit, against it. ratio: index of refraction before the border over the
// one behind (Snell's law and Fresnel's equations).
Interface meetInterface(vec3 direction, vec3 normal, float ratio) {
  float cosine = clamp(-dot(direction, normal), 0.0, 1.0);
  float sine2 = ratio * ratio * (1.0 - cosine * cosine);  // of the angle behind
  if (sine2 >= 1.0) return Interface(reflect(direction, normal), 1.0);
  float behind = sqrt(1.0 - sine2);
  float parallel = (cosine - ratio * behind) / max(cosine + ratio * behind, 1e-20);
  float perpendicular = (ratio * cosine - behind) / max(ratio * cosine + behind, 1e-20);
  return Interface(normalize(ratio * direction + (ratio * cosine - behind) * normal),
                   0.5 * (parallel * parallel + perpendicular * perpendicular));
}
