// The path of a pixel's mirror ray where surfaces may be clear. The includer has lib/queued_ray.glsl and meeting.glsl.

// What a volume reflects on its inside comes to an eye in there.
RayPath pixelPathInMedia(uint number, uint slot) {
  RayPath path = pixelPath(number, slot);
  Ray ray = mirrorRay(number);
  uint material = triangleAt(ray.excluded).w;
  bool volume = (materials[material].flags & (MATERIAL_TRANSMISSIVE | MATERIAL_THIN)) == MATERIAL_TRANSMISSIVE;
  if (volume && material < MEDIA_MATERIALS && (path.kindAndCounts & 255u) == RAY_REFLECTION &&
      !meetsFront(ray.excluded, fromCamera(ray.origin))) {
    path.media = enterMedium(0u, material);
    path.throughput = throughMedium(path.media, path.pathLength);
  }
  return path;
}
