// The two-plane rule: whether a tap's sample and the receiver are on the same surface, decided from their triangles.
//
// They are on the same surface if (1) both are on the same triangle; or (2) the receiver is not behind the plane of the
// sample's triangle, seen from the light; or (3) the sample is not in front of the plane of the receiver's triangle.
// All computations are in light space and double precision, with normals towards the light.
//
// Coplanar triangles must compare as "not behind" although their stored vertices are rounded. A vertex is known to
// half a unit in the last place of a float: with world = M·p + t, each coordinate within 2^-24·(|M|·|p| + |t|)
// (p and t are floats in the file). Let e be the length of that vector for the largest |p| of the triangle. A point of
// the plane with barycentric coordinates l moves by at most e·sum|l_i| when the vertices move by e; a point on the
// other triangle moves by at most that triangle's e. So a signed distance within e_point + e_plane·sum|l_i| of zero may
// be zero. Double precision adds an error of 2^-53 of the same magnitudes, which is neglected.
#include "scene.glsl"

const double half_ulp = 5.9604644775390625e-8lf;  // 2^-24

struct Facet {
  dvec3 a;
  dvec3 ab;
  dvec3 ac;
  dvec3 normal;        // unit, towards the light
  double vertex_error;  // e above, metres
};

Facet fetch_facet(uvec2 id) {
  uvec3 v = vertices_of(id.x, id.y);
  vec3 a = mesh_position(id.x, v.x);
  vec3 b = mesh_position(id.x, v.y);
  vec3 c = mesh_position(id.x, v.z);
  dvec4 x = instances[id.x].rows[0];
  dvec4 y = instances[id.x].rows[1];
  dvec4 z = instances[id.x].rows[2];
  // Edges are computed in mesh space, where the difference of two floats is exact in double precision and the
  // translation cancels.
  dmat4 light_from_mesh = dmat4(dvec4(transform_vector(light_from_world, dvec3(x.x, y.x, z.x)), 0.0lf),
                                dvec4(transform_vector(light_from_world, dvec3(x.y, y.y, z.y)), 0.0lf),
                                dvec4(transform_vector(light_from_world, dvec3(x.z, y.z, z.z)), 0.0lf),
                                dvec4(transform_point(light_from_world, dvec3(x.w, y.w, z.w)), 1.0lf));
  Facet f;
  f.a = transform_point(light_from_mesh, dvec3(a));
  f.ab = transform_vector(light_from_mesh, dvec3(b) - dvec3(a));
  f.ac = transform_vector(light_from_mesh, dvec3(c) - dvec3(a));
  dvec3 n = cross_of(f.ab, f.ac);
  double area = length_of(n);
  f.normal = area > 0.0lf ? n / area : dvec3(0.0lf);
#if MAP_KIND == MAP_ORTHOGRAPHIC
  if (f.normal.z < 0.0lf) f.normal = -f.normal;
#else
  if (dot_of(f.normal, f.a) > 0.0lf) f.normal = -f.normal;
#endif
  dvec3 largest = dvec3(max(abs(a), max(abs(b), abs(c))));
  precise dvec3 reach = dvec3(dot_of(abs(x.xyz), largest) + abs(x.w), dot_of(abs(y.xyz), largest) + abs(y.w),
                              dot_of(abs(z.xyz), largest) + abs(z.w));
  f.vertex_error = half_ulp * length_of(reach);
  return f;
}

double signed_distance(Facet f, dvec3 point) { return dot_of(f.normal, point - f.a); }

double rounding_bound(Facet f, dvec3 point, double point_error) {
  dvec3 n = cross_of(f.ab, f.ac);
  double squared = dot_of(n, n);
  if (!(squared > 0.0lf)) return point_error;
  double v = dot_of(cross_of(point - f.a, f.ac), n) / squared;
  double w = dot_of(cross_of(f.ab, point - f.a), n) / squared;
  precise double bound = point_error + f.vertex_error * (abs(1.0lf - v - w) + abs(v) + abs(w));
  return bound;
}

// Where the light's ray intersects the triangle. If the ray misses it, because rasterisation covers texels slightly
// outside a triangle, the point is clamped to the triangle's edge. (Moeller and Trumbore 1997, as in
// gbuffer_resolve.comp.)
dvec3 sample_on(Facet f, dvec3 origin, dvec3 direction) {
  dvec3 p = cross_of(direction, f.ac);
  double determinant = dot_of(f.ab, p);
  dvec3 q = cross_of(origin - f.a, f.ab);
  precise dvec2 weight = abs(determinant) > 0.0lf
                             ? dvec2(dot_of(origin - f.a, p), dot_of(direction, q)) / determinant
                             : dvec2(1.0lf / 3.0lf);
  weight = max(weight, 0.0lf);
  weight /= max(1.0lf, weight.x + weight.y);
  precise dvec3 sample_point = f.a + weight.x * f.ab + weight.y * f.ac;
  return sample_point;
}

bool is_same_surface(Receiver receiver, uvec2 receiver_id, Facet own, ivec3 texel, uvec2 blocker_id) {
  if (receiver_id == blocker_id) return true;
  Facet blocker = fetch_facet(blocker_id);
  // The surfel's position is rounded to floats; project it back to its triangle's plane.
  precise dvec3 r = receiver.in_light - own.normal * signed_distance(own, receiver.in_light);
  if (signed_distance(blocker, r) >= -rounding_bound(blocker, r, own.vertex_error)) return true;
  dvec3 origin;
  dvec3 direction;
  texel_ray(texel, origin, direction);
  dvec3 s = sample_on(blocker, origin, direction);
  return signed_distance(own, s) <= rounding_bound(own, s, blocker.vertex_error);
}
