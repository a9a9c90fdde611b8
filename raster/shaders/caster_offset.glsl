// Moves the corners of a triangle against their normals before the map is drawn: NormalOffset of
// techniques/shadow/normal_offset.h. Includes follow scene.glsl and light.glsl.
#include "map_warp.glsl"
#include "normal_offset.glsl"
uniform samplerBuffer normals;
uniform float caster_texels;
uniform float caster_metres;
uniform int caster_profile;

// Side of a texel of the view at a position in light space, metres: texel_at() of techniques/shadow/map_layout.h.
double caster_texel(dvec3 p, int view) {
#if MAP_WARPED
  return p.y > warp_center.y ? warped_texel(p.xy) : 0.0lf;
#endif
  double side = 2.0lf * map_views[view].z / double(resolution);
#if MAP_KIND == MAP_PERSPECTIVE
  side *= -p.z;
#elif MAP_KIND == MAP_CUBE
  side *= max(max(abs(p.x), abs(p.y)), abs(p.z));
#elif MAP_KIND == MAP_PARABOLOID
  side *= length(p) + abs(p.z);
#endif
  return side;
}

// Unit, in light space, outwards: of the mesh at this corner, or of the triangle if the mesh has none.
dvec3 corner_normal(uint id, uint vertex, dvec3 of_triangle) {
  dvec3 n = of_triangle;
  if (instances[id].first_normal != NO_ID) {
    dvec3 of_mesh = dvec3(texelFetch(normals, int(instances[id].first_normal + vertex)).xyz);
    dvec3 smooth_normal = dmat3(light_from_world) * world_from_normal(id, of_mesh);
    if (length(smooth_normal) > 0.0lf) n = smooth_normal;
  }
  return n / length(n);
}

// A corner in light space. `view`: whose texels count.
dvec3 moved_caster(uint id, uint corner, vec3 corners[3], int view) {
  dvec3 p = dvec3(corners[corner]);
  dvec3 of_triangle = cross(dvec3(corners[1]) - dvec3(corners[0]), dvec3(corners[2]) - dvec3(corners[0]));
  if (!(length(of_triangle) > 0.0lf)) return p;
  // The vertices of a mirrored instance turn the other way.
  double turn = is_mirrored(id) ? -1.0lf : 1.0lf;
  dvec3 n = turn * corner_normal(id, vertices_of(id, uint(gl_PrimitiveIDIn))[corner], of_triangle);
#if MAP_KIND == MAP_ORTHOGRAPHIC
  dvec3 to_light = dvec3(0.0lf, 0.0lf, 1.0lf);
#else
  dvec3 to_light = -p / max(length(p), 1e-9lf * far_depth);
#endif
  double scale = offset_scale(caster_profile, length(cross(n, to_light)), dot(n, to_light));
  return p - n * (scale * (double(caster_texels) * caster_texel(p, view) + double(caster_metres)));
}
