#include "scene.glsl"
#include "view.glsl"
layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_TEXCOORD) in vec2 texcoord;
layout(location = UNIFORM_FIRST_INSTANCE) uniform uint first_instance;
layout(location = 0) flat out uint instance;
layout(location = 1) out vec2 surface_texcoord;

void main() {
  instance = first_instance + uint(gl_InstanceID);
  surface_texcoord = texcoord;
  gl_Position = vec4(clip_from_world * dvec4(world_from_mesh(instance, dvec3(position)), 1.0lf));
}
