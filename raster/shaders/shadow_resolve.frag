// Computes the depth of each texel of a view. With COMBINES: from the linear depths of the two nearest layers, stored
// by DEPTH_MAPPING. Otherwise the linear depth of a number stored by DEPTH_MAPPING, with IS_HALF rounded to 16-bit float.
#include "light_map.glsl"
#include "map_depth.glsl"
uniform int map_view;
uniform float near_depth;
#if COMBINES
uniform sampler2DArray nearest_layer;
uniform sampler2DArray second_layer;
uniform float dual_offset;  // metres
#else
uniform sampler2DArray stored_depth;
#endif

// The number that stands for no surface.
const bool is_reversed = DEPTH_MAPPING == DEPTH_REVERSED_LINEAR || DEPTH_MAPPING == DEPTH_REVERSED_PERSPECTIVE ||
                         DEPTH_MAPPING == DEPTH_REVERSED_OVER_W;
const float empty_stored = is_reversed ? 0.0 : 1.0;

// Depth of the light's rays per depth along the axis of the face, which the perspective mappings store.
double depth_per_axis_depth(ivec3 texel) {
#if MAP_KIND == MAP_CUBE && (DEPTH_MAPPING == DEPTH_PERSPECTIVE || DEPTH_MAPPING == DEPTH_REVERSED_PERSPECTIVE)
  dvec3 origin;
  dvec3 direction;
  texel_ray(texel, origin, direction);
  return length_of(direction);
#else
  return 1.0;
#endif
}

double stored_of(double depth) {
#if STORES_OVER_W
  return encode_over_w(DEPTH_MAPPING, depth, warp_w(gl_FragCoord.y), dvec2(warp_middle_depth, warp_depth_scale));
#else
  return encode_depth(DEPTH_MAPPING, depth, double(near_depth), encoded_far);
#endif
}

double depth_of(double stored) {
#if STORES_OVER_W
  return decode_over_w(DEPTH_MAPPING, stored, warp_w(gl_FragCoord.y), dvec2(warp_middle_depth, warp_depth_scale));
#else
  return decode_depth(DEPTH_MAPPING, stored, double(near_depth), encoded_far);
#endif
}

#if COMBINES
// Where the light meets one surface alone, nothing behind it needs a shadow: midpoint and second are then empty.
// Dual: D. Weiskopf and T. Ertl, Shadow Mapping Based on Dual Depth Layers, Eurographics 2003.
float combined(float nearest, float second) {
  bool has_second = second < empty_depth;
#if SURFACE == SURFACE_SECOND
  return second;
#else
  float midpoint = has_second ? 0.5 * (nearest + second) : empty_depth;
#if SURFACE == SURFACE_DUAL
  return nearest < empty_depth ? min(midpoint, nearest + dual_offset / float(far_depth)) : empty_depth;
#else
  return midpoint;
#endif
#endif
}
#endif

void main() {
  ivec3 texel = ivec3(gl_FragCoord.xy, map_view);
#if COMBINES
  float depth = combined(texelFetch(nearest_layer, texel, 0).r, texelFetch(second_layer, texel, 0).r);
  double metres = double(depth) * far_depth / depth_per_axis_depth(texel);
  bool is_empty = !(depth < empty_depth);
#if DEPTH_MAPPING == DEPTH_LINEAR
  gl_FragDepth = is_empty ? empty_stored : depth;
#else
  gl_FragDepth = is_empty ? empty_stored : float(stored_of(metres));
#endif
#else
  float stored = texelFetch(stored_depth, texel, 0).r;
#if IS_HALF
  stored = ROUNDS_DOWN != 0 ? half_below(stored) : nearest_half(stored);
#endif
  double metres = depth_of(double(stored));
  gl_FragDepth = stored == empty_stored ? empty_depth : float(metres * depth_per_axis_depth(texel) / far_depth);
#endif
}
