// Computes the visibility of each surfel from a filtered shadow map, with bilinear or, with HAS_MIPMAPS, trilinear
// interpolation: for several look-ups at once, each into its layer.
#include TECHNIQUE_TEXT
#include "surfel_lookup.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform sampler2DArray values;
layout(r32f) writeonly uniform image2DArray visibility_image;
uniform int lookup_count;

// What each look-up reads besides the map: PrefilteredLookup in raster/shadow/prefiltered_pass.h.
struct LookupValues {
  float constant_bias;  // in the unit of the look-up
  float slope_bias;
  Settings settings;
};
layout(std430) restrict readonly buffer Lookups { LookupValues lookups[]; };

// Bilinear interpolation in double precision, like all that follows: hardware filters with 8-bit weights.
dvec4 values_at_level(Receiver receiver, int group, int level) {
  int layer = receiver.view * GROUPS + group;
  ivec2 last = textureSize(values, level).xy - 1;
  dvec2 place = receiver.texels * (dvec2(last + 1) / double(resolution)) - 0.5lf;
  ivec2 base = ivec2(floor(place));
  dvec2 part = place - dvec2(base);
  ivec2 low = clamp(base, ivec2(0), last);
  ivec2 high = clamp(base + 1, ivec2(0), last);
  dvec4 bottom = mix(dvec4(texelFetch(values, ivec3(low, layer), level)),
                     dvec4(texelFetch(values, ivec3(high.x, low.y, layer), level)), part.x);
  dvec4 top = mix(dvec4(texelFetch(values, ivec3(low.x, high.y, layer), level)),
                  dvec4(texelFetch(values, ivec3(high, layer), level)), part.x);
  return mix(bottom, top, part.y);
}

#if HAS_MIPMAPS
#include "view.glsl"

// Texels of the first level per pixel along one axis of the image: by how much the map position moves while a ray moves
// over 1/64 pixel on the surfel's plane. If that leaves the view of the map, the ray moves the other way.
float texels_per_pixel(ivec2 pixel, dvec2 axis_of_image, Receiver receiver) {
  dvec3 position = dvec3(texelFetch(position_depth, pixel, 0).xyz);
  dvec3 normal = dvec3(texelFetch(geometric_normal, pixel, 0).xyz);
  double most = 0.0lf;
  for (int side = -1; side <= 1; side += 2) {
    dvec2 at = (dvec2(pixel) + 0.5lf + double(side) / 64.0lf * axis_of_image) / dvec2(size) * 2.0lf - 1.0lf;
    dvec3 origin = eye.xyz + ray_origin[0].xyz + at.x * ray_origin[1].xyz + at.y * ray_origin[2].xyz;
    dvec3 direction = ray_direction[0].xyz + at.x * ray_direction[1].xyz + at.y * ray_direction[2].xyz;
    double reach = dot(normal, position - origin) / dot(normal, direction);
    Receiver moved = project_to_map(origin + reach * direction, dither_at(pixel));
    if (moved.view == receiver.view) most = max(most, 64.0lf * length(moved.texels - receiver.texels));
  }
  return float(most);
}

float level_of_detail(ivec2 pixel, Receiver receiver) {
  // Without the normal offset.
  receiver = project_to_map(dvec3(texelFetch(position_depth, pixel, 0).xyz), dither_at(pixel));
  float most = max(texels_per_pixel(pixel, dvec2(1, 0), receiver), texels_per_pixel(pixel, dvec2(0, 1), receiver));
  return clamp(log2(max(most, 1.0)), 0.0, float(textureQueryLevels(values) - 1));
}
#else
float level_of_detail(ivec2 pixel, Receiver receiver) { return 0.0; }
#endif

dvec4 values_at(Receiver receiver, int group, float level) {
  int finer = int(level);
  dvec4 at_finer = values_at_level(receiver, group, finer);
  float part = level - float(finer);
  return part == 0.0 ? at_finer : mix(at_finer, values_at_level(receiver, group, finer + 1), double(part));
}

float visibility_at(dvec4 of_groups[GROUPS], double depth, Settings settings) {
  CONSTANTS
  float visibility = 0.0;
  for (int group = 0; group < GROUPS; ++group) {
    visibility = visibility_from(of_groups[group], depth, group, visibility, settings);
  }
  return visibility;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  float same_for_all = 1.0;
  bool reads_map = false;
  Lookup surfel;
  dvec4 of_groups[GROUPS];
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    surfel = look_up(pixel);
    same_for_all = surfel.faces_light ? 1.0 : 0.0;
    reads_map = surfel.faces_light && surfel.receiver.is_inside;
    if (reads_map) {
      float level = level_of_detail(pixel, surfel.receiver);
      for (int group = 0; group < GROUPS; ++group) of_groups[group] = values_at(surfel.receiver, group, level);
    }
  }
  for (int i = 0; i < lookup_count; ++i) {
    float visibility = same_for_all;
    if (reads_map) {
      LookupValues lookup = lookups[i];
      double bias = double(lookup.constant_bias * surfel.bias_unit + lookup.slope_bias * surfel.slope);
      visibility = visibility_at(of_groups, (surfel.receiver.depth - bias) / far_depth, lookup.settings);
    }
    imageStore(visibility_image, ivec3(pixel, i), vec4(visibility));
  }
}
