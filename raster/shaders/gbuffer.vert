#include "scene.glsl"
#include "view.glsl"
layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_TEXCOORD) in vec2 texcoord;
layout(location = ATTRIBUTE_INSTANCE) in uint drawn_instance;
layout(location = 0) flat out uint instance;
layout(location = 1) out vec2 surface_texcoord;

void main() {
  instance = drawn_instance;
  surface_texcoord = texcoord;
  gl_Position = vec4(clip_from_world * dvec4(world_from_mesh(instance, dvec3(position)), 1.0lf));
}
