// The camera behind the mirror.
#include "shared/passes/captures.h"

layout(std140, binding = UBO_PLANE) uniform PlaneBlock { vec4 mirrorPlane; };

float beforeMirror(vec3 position) { return dot(mirrorPlane.xyz, position) + mirrorPlane.w; }
vec3 mirroredPoint(vec3 position) { return position - 2.0 * beforeMirror(position) * mirrorPlane.xyz; }
vec3 mirroredDirection(vec3 direction) { return reflect(direction, mirrorPlane.xyz); }
