#include "view.glsl"
uniform samplerBuffer volume_vertices;

void main() {
  gl_Position = vec4(clip_from_world * dvec4(dvec3(texelFetch(volume_vertices, gl_VertexID).xyz), 1.0lf));
}
