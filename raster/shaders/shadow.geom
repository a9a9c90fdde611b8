// Lays a triangle on the faces of a perspective or cube map, or on a warped map, and hands its plane on, from which
// shadow.frag computes the depth at the texel centre itself.
#if MOVES_CASTERS
#include "scene.glsl"
#endif
#include "light.glsl"
#if MOVES_CASTERS
#include "caster_offset.glsl"
#endif
layout(triangles) in;
#if CUBE_PASSES
layout(triangle_strip, max_vertices = 3) out;
uniform int map_view;
#elif MAP_KIND == MAP_CUBE
layout(triangle_strip, max_vertices = 18) out;
#else
layout(triangle_strip, max_vertices = 3) out;
#endif
layout(location = 0) in uint vertex_instance[];
layout(location = 1) in vec2 vertex_texcoord[];
layout(location = 2) in vec3 vertex_in_light[];
layout(location = 0) flat out uint instance;
layout(location = 1) out vec2 surface_texcoord;
layout(location = 2) flat out vec4 plane;        // light space: normal·p = w
layout(location = 3) flat out vec2 depth_range;  // metres, of this triangle
layout(location = 4) flat out int face;

// Nearer than this share of far_depth nothing is drawn: a projection has no room for a surface at its centre.
const float nearest_share = 1e-6;
// Perspective mappings store the depth along the axis of the face, and begin at their near plane.
#define IS_PERSPECTIVE (DEPTH_MAPPING == DEPTH_PERSPECTIVE || DEPTH_MAPPING == DEPTH_REVERSED_PERSPECTIVE)
#if IS_PERSPECTIVE
uniform float near_depth;
#endif

void main() {
  vec3 corners[3] = vec3[3](vertex_in_light[0], vertex_in_light[1], vertex_in_light[2]);
#if MOVES_CASTERS
  vec3 moved[3];
  // All faces of a cube have texels of one size.
  for (uint i = 0u; i < 3u; ++i) moved[i] = vec3(moved_caster(vertex_instance[i], i, corners, 0));
  corners = moved;
#endif
  vec3 a = corners[0];
  vec3 b = corners[1];
  vec3 c = corners[2];
  vec3 normal = cross(b - a, c - a);
  float normal_length = length(normal);
  if (!(normal_length > 0.0)) return;
  normal /= normal_length;
  float offset = dot(normal, a);
#if MAP_KIND == MAP_CUBE
  vec2 range = vec2(abs(offset), max(max(length(a), length(b)), length(c)));
#else
  vec2 range = vec2(min(min(-a.z, -b.z), -c.z), max(max(-a.z, -b.z), -c.z));
#endif
  float near = nearest_share * float(far_depth);
#if IS_PERSPECTIVE
  near = max(near, near_depth);
#endif
  float tangent = float(map_views[0].z);
#if CUBE_PASSES
  int first_face = map_view;
  int end_face = map_view + 1;
#else
  const int first_face = 0;
  const int end_face = MAP_KIND == MAP_CUBE ? 6 : 1;
#endif
  for (int f = first_face; f < end_face; ++f) {
    vec4 clip[3];
    for (int i = 0; i < 3; ++i) {
      vec3 p = corners[i];
#if MAP_KIND == MAP_CUBE
      p = vec3(dot(vec3(face_basis[3 * f].xyz), p), dot(vec3(face_basis[3 * f + 1].xyz), p),
               -dot(vec3(face_basis[3 * f + 2].xyz), p));
#endif
#if MAP_WARPED
      // Which triangles are drawn does not depend on depth: it is clamped.
      double w = double(p.y) - warp_center.y;
      clip[i] = vec4(warp_scale.x * (double(p.x) - warp_center.x) + warp_shift.x * w, warp_scale.y + warp_shift.y * w,
                     0.0lf, w);
      continue;
#endif
      // Clip depth holds only the near plane, at w = near; the depth buffer gets what shadow.frag computes.
      clip[i] = vec4(p.x / tangent, p.y / tangent, -p.z - near, -p.z);
    }
    bool outside = false;
    for (int axis = 0; axis < 2; ++axis) {
      vec3 s = vec3(clip[0][axis], clip[1][axis], clip[2][axis]);
      vec3 w = vec3(clip[0].w, clip[1].w, clip[2].w);
      outside = outside || all(greaterThan(s, w)) || all(lessThan(s, -w));
    }
    if (outside) continue;
#if IS_PERSPECTIVE
    range = max(vec2(min(min(clip[0].w, clip[1].w), clip[2].w), max(max(clip[0].w, clip[1].w), clip[2].w)), near);
#endif
    for (int i = 0; i < 3; ++i) {
      gl_Position = clip[i];
      gl_Layer = f;
      gl_PrimitiveID = gl_PrimitiveIDIn;
      instance = vertex_instance[i];
      surface_texcoord = vertex_texcoord[i];
      plane = vec4(normal, offset);
      depth_range = range;
      face = f;
      EmitVertex();
    }
    EndPrimitive();
  }
}
