// The light model and its parameters.
#include "view.glsl"
#include "light_model.glsl"
layout(std140) uniform Shading {
  LightModel model;
  mat4 world_from_clip;
  float ambient;
  int light_count;
};

vec3 direction_to_viewer(vec3 position) {
  return vec3(normalize(is_orthographic != 0 ? -axis.xyz : eye.xyz - dvec3(position)));
}
