#include "scene.glsl"
#include "light.glsl"
layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_TEXCOORD) in vec2 texcoord;
layout(location = ATTRIBUTE_INSTANCE) in uint drawn_instance;
#if !HAS_PLANE
uniform int map_view;
layout(location = 0) flat out uint instance;
layout(location = 1) out vec2 surface_texcoord;
#else
layout(location = 0) out uint vertex_instance;
layout(location = 1) out vec2 vertex_texcoord;
layout(location = 2) out vec3 vertex_in_light;
#endif

void main() {
  uint id = drawn_instance;
  dvec3 p = dvec3(light_from_world * dvec4(world_from_mesh(id, dvec3(position)), 1.0lf));
#if !HAS_PLANE
  instance = id;
  surface_texcoord = texcoord;
  dvec4 view = map_views[map_view];
#if MAP_KIND == MAP_PARABOLOID
  // W. Heidrich and H.-P. Seidel, View-independent Environment Maps, Graphics Hardware 1998; for shadows S. Brabec,
  // T. Annen and H.-P. Seidel, Shadow Mapping for Hemispherical and Omnidirectional Light Sources, CGI 2002. Vertices are
  // projected, and the rasteriser joins them by straight lines, where the projection of an edge is bent.
  if (map_view == 1) p = dvec3(-p.x, p.y, -p.z);
  double radius = length(p);
  gl_ClipDistance[0] = float(-p.z);
  // Behind the hemisphere the projection runs to infinity.
  p.xy /= max(radius - p.z, 1e-3lf * radius + 1e-9lf * far_depth);
  p.z = -radius;
#endif
#if DEPTH_MAPPING == DEPTH_REVERSED_LINEAR
  double depth = (far_depth + p.z) / far_depth;
#else
  double depth = -p.z / far_depth;
#endif
  dvec2 place = dvec2((p.x - view.x) / view.z, (p.y - view.y) / view.z);
  if (is_stable != 0) {
    // The rasteriser rounds positions to this grid; rounding to single precision before that would depend on the view.
    double steps = 128.0lf * double(resolution);
    place = floor(place * steps + 0.5lf) / steps;
  }
  gl_Position = vec4(vec3(place, depth), 1.0);
#else
  vertex_instance = id;
  vertex_texcoord = texcoord;
  vertex_in_light = vec3(p);
#endif
}
