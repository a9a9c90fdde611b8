// Ids of the triangle that the light sees at a texel centre; for perspective and cube maps also its linear depth.
#include "light.glsl"
#if ALPHA_MASK
#include "base_color.glsl"
uniform float alpha_cutoff;
#endif
layout(location = 0) flat in uint instance;
layout(location = 1) in vec2 surface_texcoord;
#if MAP_KIND != MAP_ORTHOGRAPHIC
layout(location = 2) flat in vec4 plane;
layout(location = 3) flat in vec2 depth_range;
layout(location = 4) flat in int face;
#endif
layout(location = 0) out uvec2 ids;

void main() {
#if ALPHA_MASK
  if (!(base_color_at(surface_texcoord, false).a >= alpha_cutoff)) discard;
#endif
#if MAP_KIND != MAP_ORTHOGRAPHIC
  vec2 p = (2.0 * gl_FragCoord.xy / float(resolution) - 1.0) * float(map_views[0].z);
#if MAP_KIND == MAP_CUBE
  vec3 direction = normalize(vec3(face_basis[3 * face].xyz) * p.x + vec3(face_basis[3 * face + 1].xyz) * p.y +
                             vec3(face_basis[3 * face + 2].xyz));
#else
  vec3 direction = vec3(p, -1.0);
#endif
  // Edge-on triangles reach texel centres only by the rasteriser's snapping: their range keeps the depth sane.
  float depth = clamp(plane.w / dot(plane.xyz, direction), depth_range.x, depth_range.y);
  gl_FragDepth = depth / float(far_depth);
#endif
  ids = uvec2(instance, uint(gl_PrimitiveID));
}
