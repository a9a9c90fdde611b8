// The light model, its parameters and the projection of the G-buffer. raster/shading/gbuffer_store.h fills the block.
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
