#include "scene.glsl"
#include "light.glsl"
layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_TEXCOORD) in vec2 texcoord;
layout(location = ATTRIBUTE_INSTANCE) in uint drawn_instance;
#if HAS_PLANE || MOVES_CASTERS
layout(location = 0) out uint vertex_instance;
layout(location = 1) out vec2 vertex_texcoord;
layout(location = 2) out vec3 vertex_in_light;
#else
#include "map_projection.glsl"
layout(location = 0) flat out uint instance;
layout(location = 1) out vec2 surface_texcoord;
#endif

void main() {
  uint id = drawn_instance;
  dvec3 p = dvec3(light_from_world * dvec4(world_from_mesh(id, dvec3(position)), 1.0lf));
#if HAS_PLANE || MOVES_CASTERS
  vertex_instance = id;
  vertex_texcoord = texcoord;
  vertex_in_light = vec3(p);
#else
  instance = id;
  surface_texcoord = texcoord;
  gl_Position = on_map(p);
#endif
}
