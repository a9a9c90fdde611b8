// The normals that AO techniques read: AoNormals of techniques/ao/inputs.h.
#include "view.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D geometric_normal;
uniform sampler2D linear_depth;
layout(rgba32f) writeonly uniform image2D normals;

float depth_at(ivec2 pixel) { return texelFetch(linear_depth, pixel, 0).r; }
#include "screen.glsl"

#if AO_NORMALS == AO_NORMALS_RGB8

vec3 normal_at(ivec2 pixel) {
  vec3 stored = floor((texelFetch(geometric_normal, pixel, 0).xyz * 0.5 + 0.5) * 255.0 + 0.5) / 255.0;
  return normalize(stored * 2.0 - 1.0);
}

#else

// From the surfel to its neighbour of closer depth along an axis, in the axis's direction; 0 if there is none.
vec3 step_along(ivec2 pixel, ivec2 axis) {
  vec3 center = seen_position(pixel);
  float before = has_surface(pixel - axis) ? abs(depth_at(pixel - axis) - depth_at(pixel)) : 1e30;
  float after = has_surface(pixel + axis) ? abs(depth_at(pixel + axis) - depth_at(pixel)) : 1e30;
  if (min(before, after) >= 1e30) return vec3(0.0);
  return before < after ? center - seen_position(pixel - axis) : seen_position(pixel + axis) - center;
}

vec3 normal_at(ivec2 pixel) {
  vec3 normal = cross(step_along(pixel, ivec2(1, 0)), step_along(pixel, ivec2(0, 1)));
  float size = length(normal);
  // A pixel without neighbours faces the viewer.
  normal = size > 0.0 ? normal / size : direction_to_viewer(seen_position(pixel));
  return normalize(vec3(transpose(dmat3(view_from_world)) * dvec3(normal)));
}

#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  vec3 normal = texelFetch(ids, pixel, 0).r != NO_ID ? normal_at(pixel) : vec3(0.0);
  imageStore(normals, pixel, vec4(normal, 0.0));
}
