// Draws a triangle on an orthographic or paraboloid map after its corners have moved.
#include "scene.glsl"
#include "light.glsl"
#include "map_projection.glsl"
#include "caster_offset.glsl"
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) in uint vertex_instance[];
layout(location = 1) in vec2 vertex_texcoord[];
layout(location = 2) in vec3 vertex_in_light[];
layout(location = 0) flat out uint instance;
layout(location = 1) out vec2 surface_texcoord;

void main() {
  vec3 corners[3] = vec3[3](vertex_in_light[0], vertex_in_light[1], vertex_in_light[2]);
  for (uint i = 0u; i < 3u; ++i) {
    gl_Position = on_map(moved_caster(vertex_instance[i], i, corners, map_view));
    gl_PrimitiveID = gl_PrimitiveIDIn;
    instance = vertex_instance[i];
    surface_texcoord = vertex_texcoord[i];
    EmitVertex();
  }
  EndPrimitive();
}
