// Ids of the triangle that the light sees at a texel centre; for perspective, cube and warped maps also its depth.
#include "light.glsl"
#include "map_depth.glsl"
#include "map_warp.glsl"
#if ALPHA_MASK
#include "base_color.glsl"
uniform float alpha_cutoff;
#endif
layout(location = 0) flat in uint instance;
layout(location = 1) in vec2 surface_texcoord;
#if HAS_PLANE
layout(location = 2) flat in vec4 plane;
layout(location = 3) flat in vec2 depth_range;
layout(location = 4) flat in int face;
#else
uniform int map_view;
#endif
#if PEELS
uniform sampler2DArray in_front;
#endif
uniform float near_depth;
uniform float offset_factor;
uniform float offset_units;
layout(location = 0) out uvec2 ids;

// Surfaces that are nearer to one another than this share of far_depth are one layer, so that rounding does not put
// the copy of a triangle, or one that overlaps it in its plane, behind it.
const float same_layer = 9.5367431640625e-7;  // 2^-20

#if HAS_PLANE
// Where the light's ray through the texel's centre meets the plane of the triangle, metres.
float plane_depth() {
#if MAP_WARPED
  precise dvec2 place = 2.0lf * dvec2(gl_FragCoord.xy) / double(resolution) - 1.0lf;
  dvec2 p = from_warped(place);
  return float((dot(dvec2(plane.xy), p) - double(plane.w)) / double(plane.z));
#else
  vec2 p = (2.0 * gl_FragCoord.xy / float(resolution) - 1.0) * float(map_views[0].z);
#if MAP_KIND == MAP_CUBE
  vec3 direction = vec3(face_basis[3 * face].xyz) * p.x + vec3(face_basis[3 * face + 1].xyz) * p.y +
                   vec3(face_basis[3 * face + 2].xyz);
#if DEPTH_MAPPING == DEPTH_LINEAR || DEPTH_MAPPING == DEPTH_REVERSED_LINEAR
  direction = normalize(direction);
#endif
#else
  vec3 direction = vec3(p, -1.0);
#endif
  return plane.w / dot(plane.xyz, direction);
#endif
}

float stored_of(float depth) {
#if DEPTH_MAPPING == DEPTH_LINEAR
  return depth / float(far_depth);
#elif STORES_OVER_W
  double w = warp_w(double(gl_FragCoord.y));
  return float(encode_over_w(DEPTH_MAPPING, double(depth), w, dvec2(warp_middle_depth, warp_depth_scale)));
#else
  return float(encode_depth(DEPTH_MAPPING, double(depth), double(near_depth), encoded_far));
#endif
}

#if HAS_OFFSET
// The polygon offset that OpenGL adds to a depth which no shader writes (OpenGL 4.5, section 14.6.5): factor times the
// largest slope, here the difference to the neighbouring texel, plus units times the unit of the format. A float's unit
// is that of the largest depth of the triangle; offset_units holds the one for depths from ½ to 1.
float polygon_offset(float stored) {
  float slope = max(abs(dFdx(stored)), abs(dFdy(stored)));
  // Edge-on triangles have no slope; an offset of the whole range is as good as any larger one.
  slope = slope < 1.0 ? slope : 1.0;
  float units = offset_units;
#if IS_FLOAT
  int exponent;
  frexp(max(stored_of(depth_range.x), stored_of(depth_range.y)), exponent);
  units = ldexp(units, exponent);
#endif
  return offset_factor * slope + units;
}
#endif
#endif

void main() {
#if HAS_OFFSET
  // Before any discard, which would leave the differences between texels undefined.
  float offset = polygon_offset(stored_of(plane_depth()));
#endif
#if ALPHA_MASK
  if (!(base_color_at(surface_texcoord, false).a >= alpha_cutoff)) discard;
#endif
#if HAS_PLANE
  // Edge-on triangles reach texel centres only by the rasteriser's snapping: their range keeps the depth sane.
  float stored = stored_of(clamp(plane_depth(), depth_range.x, depth_range.y));
#if HAS_OFFSET
  stored += offset;
#endif
#if STORES_OVER_W
  // Beyond the warped volume the number can leave the range.
  stored = clamp(stored, 0.0, 1.0);
#endif
  gl_FragDepth = stored;
#endif
#if PEELS
#if HAS_PLANE
  int layer = face;
#else
  int layer = map_view;
  float stored = gl_FragCoord.z;
#endif
  if (!(stored > texelFetch(in_front, ivec3(gl_FragCoord.xy, layer), 0).r + same_layer)) discard;
#endif
  ids = uvec2(instance, uint(gl_PrimitiveID));
}
