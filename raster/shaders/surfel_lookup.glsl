// Projects a surfel of the G-buffer to the light's map.
#include "light_map.glsl"
#include "normal_offset.glsl"
#include "scene.glsl"
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D geometric_normal;
uniform sampler2D truth_image;

struct Lookup {
  bool faces_light;  // geometric N·L > 0
  Receiver receiver;
  float slope;      // texel size at the receiver · tan θ, metres
  float bias_unit;  // metres per unit of constant bias
};

// dither_at() of techniques/shadow/map_layout.h: an 8×8 Bayer matrix.
double dither_at(ivec2 pixel) {
  uint column = uint(pixel.x);
  uint row = uint(textureSize(ids, 0).y - 1 - pixel.y);  // row 0 is the top row
  uint rank = 0u;
  for (uint bit = 0u; bit < 3u; ++bit) rank = rank << 2u | ((column ^ row) >> bit & 1u) << 1u | (row >> bit & 1u);
  return (double(rank) + 0.5lf) / 64.0lf;
}

// 1 if the pixel sees the front of its triangle, -1 if its back. normal: towards the viewer.
double side_of(ivec2 pixel, dvec3 normal) {
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  uvec3 v = vertices_of(id.x, id.y);
  dvec3 a = dvec3(mesh_position(id.x, v.x));
  dvec3 of_front = world_from_normal(
      id.x, cross(dvec3(mesh_position(id.x, v.y)) - a, dvec3(mesh_position(id.x, v.z)) - a));
  return (dot(of_front, normal) < 0.0lf) == is_mirrored(id.x) ? 1.0lf : -1.0lf;
}

Lookup look_up(ivec2 pixel) {
  Lookup result;
  dvec3 position = dvec3(texelFetch(position_depth, pixel, 0).xyz);
  dvec3 normal = dvec3(texelFetch(geometric_normal, pixel, 0).xyz);
  dvec3 to_light = light_in_world.w == 0.0lf ? light_in_world.xyz : light_in_world.xyz - position;
  precise double cosine = dot_of(normal, to_light);
  result.faces_light = cosine > 0.0lf;
  result.receiver = project_to_map(position, dither_at(pixel));
  precise double sine = length_of(cross_of(normal, to_light));
  float texel = texel_at(result.receiver);
  result.slope = texel * float(sine / cosine);
  if (normal_offset != 0.0 || offset_metres != 0.0lf) {
    // With the profile sin θ: D. Holbert, Saying "Goodbye" to Shadow Acne, GDC 2011.
    precise double distance = length_of(to_light);
    double side = offset_is_of_front != 0 ? side_of(pixel, normal) : 1.0lf;
    precise double shift = side * (double(normal_offset) * double(texel) + offset_metres) *
                           offset_scale(offset_profile, sine / distance, side * cosine / distance);
    precise dvec3 direction = normal;
    if (offset_is_across != 0) direction -= to_light * (cosine / (distance * distance));
    precise dvec3 moved = position + direction * shift;
    result.receiver = project_to_map(moved, dither_at(pixel));
  }
  result.bias_unit = bias_unit_of(result.receiver, texel);
#if RECEIVER_PLANE
  result.receiver.plane = transform_vector(light_from_world, normal);
#endif
  return result;
}

bool is_lit(float critical_bias, Lookup surfel) {
  return is_lit_at(constant_bias, surfel.bias_unit, flip_bias(critical_bias, surfel.slope, slope_bias));
}

// The reference's visibility: 1 lit, 0 blocked, below 0 if the pixel is not counted.
float reference_at(ivec2 pixel) { return texelFetch(truth_image, pixel, 0).r; }
bool is_lit_in_reference(ivec2 pixel) { return reference_at(pixel) >= 0.5; }
