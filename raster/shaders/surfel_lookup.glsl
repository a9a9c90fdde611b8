// A surfel of the G-buffer as the light's map sees it, and the taps of the filter.
#include "light_map.glsl"
layout(binding = TEXTURE_IDS) uniform usampler2D ids;
layout(binding = TEXTURE_POSITION_DEPTH) uniform sampler2D position_depth;
layout(binding = TEXTURE_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal;
layout(binding = TEXTURE_TRUTH) uniform sampler2D truth_image;

#if SHADOW_FILTER == SHADOW_FILTER_BOX
const int taps = SHADOW_FILTER_SIZE;
#else
const int taps = 1;
#endif
const int reach = (taps - 1) / 2;

struct Lookup {
  bool faces_light;  // geometric N·L > 0
  Receiver receiver;
  float slope;  // texel size at the receiver times tan of the angle to the light, metres
};

Lookup look_up(ivec2 pixel) {
  Lookup result;
  dvec3 position = dvec3(texelFetch(position_depth, pixel, 0).xyz);
  dvec3 normal = dvec3(texelFetch(geometric_normal, pixel, 0).xyz);
  dvec3 to_light = light_in_world.w == 0.0lf ? light_in_world.xyz : light_in_world.xyz - position;
  precise double cosine = normal.x * to_light.x + normal.y * to_light.y + normal.z * to_light.z;
  result.faces_light = cosine > 0.0lf;
  result.receiver = project_to_map(position);
  result.slope = texel_at(result.receiver) * float(length(cross(normal, to_light)) / cosine);
  return result;
}

bool is_truly_lit(ivec2 pixel) { return texelFetch(truth_image, pixel, 0).r >= 0.5; }
