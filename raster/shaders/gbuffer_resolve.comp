// Computes surfels from triangle ids. It intersects the ray through the pixel centre with the triangle in double
// precision, so that positions are accurate to the last bit of a float and normals do not depend on how a driver
// interpolates.
// Intersection: Moeller and Trumbore, Fast Minimum Storage Ray/Triangle Intersection, JGT 2(1), 1997.
#include "scene.glsl"
#include "view.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform samplerBuffer normals;
layout(rgba32f) writeonly uniform image2D position_depth;
layout(rgba32f) writeonly uniform image2D geometric_normal;
layout(rgba32f) writeonly uniform image2D shading_normal;

dvec3 mesh_normal(uint instance, uint vertex) {
  return dvec3(texelFetch(normals, int(instances[instance].first_normal + vertex)).xyz);
}

// Along the edge from `from` to `from` + `edge`, 0 to 1: the point nearest to the ray through 0; its squared distance,
// times the direction's squared length.
dvec2 nearest_along(dvec3 from, dvec3 edge, dvec3 direction) {
  dvec3 at = cross(from, direction);
  dvec3 step = cross(edge, direction);
  double squared = dot(step, step);
  double along = squared > 0.0lf ? clamp(-dot(at, step) / squared, 0.0lf, 1.0lf) : 0.0lf;
  dvec3 rest = at + along * step;
  return dvec2(along, dot(rest, rest));
}

// Weights of ab and ac at the point of the triangle's edges that is nearest to the ray. Weights that are clamped one by
// one would lie pixels away where the triangle is seen edge-on.
dvec2 nearest_on_edges(dvec3 a, dvec3 ab, dvec3 ac, dvec3 direction) {
  dvec2 on_ab = nearest_along(a, ab, direction);
  dvec2 on_ac = nearest_along(a, ac, direction);
  dvec2 on_bc = nearest_along(a + ab, ac - ab, direction);
  if (on_ab.y <= on_ac.y && on_ab.y <= on_bc.y) return dvec2(on_ab.x, 0.0lf);
  return on_ac.y <= on_bc.y ? dvec2(0.0lf, on_ac.x) : dvec2(1.0lf - on_bc.x, on_bc.x);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  vec4 surfel = vec4(0);
  vec3 flat_normal = vec3(0);
  vec3 smooth_normal = vec3(0);
  if (id.x != NO_ID) {
    dvec2 ndc = (dvec2(pixel) + 0.5lf) / dvec2(size) * 2.0lf - 1.0lf;
    dvec3 origin = (ray_origin[0] + ndc.x * ray_origin[1] + ndc.y * ray_origin[2]).xyz;
    dvec3 direction = (ray_direction[0] + ndc.x * ray_direction[1] + ndc.y * ray_direction[2]).xyz;

    uvec3 v = vertices_of(id.x, id.y);
    vec3 mesh_a = mesh_position(id.x, v.x);
    dvec4 r0 = instances[id.x].rows[0];
    dvec4 r1 = instances[id.x].rows[1];
    dvec4 r2 = instances[id.x].rows[2];
    dmat3 linear = transpose(dmat3(r0.xyz, r1.xyz, r2.xyz));
    // Positions are relative to the eye. Edges are computed in mesh space, where the difference of two floats is exact
    // in double precision.
    dvec3 a = linear * dvec3(mesh_a) + (dvec3(r0.w, r1.w, r2.w) - eye.xyz);
    dvec3 ab = linear * (dvec3(mesh_position(id.x, v.y)) - dvec3(mesh_a));
    dvec3 ac = linear * (dvec3(mesh_position(id.x, v.z)) - dvec3(mesh_a));
    dvec3 p = cross(direction, ac);
    double determinant = dot(ab, p);
    dvec3 q = cross(origin - a, ab);
    dvec2 weight = abs(determinant) > 0.0lf ? dvec2(dot(origin - a, p), dot(direction, q)) / determinant
                                            : dvec2(1.0lf / 3.0lf);
    // Rasterisers snap vertices to a fraction of a pixel, so the centre may lie slightly outside the exact triangle.
    if (weight.x < 0.0lf || weight.y < 0.0lf || weight.x + weight.y > 1.0lf) {
      weight = nearest_on_edges(a - origin, ab, ac, direction);
    }

    dvec3 relative = a + weight.x * ab + weight.y * ac;
    surfel = vec4(vec3(relative + eye.xyz), float(dot(relative, axis.xyz)));

    dvec3 viewer = is_orthographic != 0 ? -axis.xyz : -relative;
    dvec3 n = normalize(cross(ab, ac));
    if (dot(n, viewer) < 0.0lf) n = -n;
    flat_normal = vec3(n);
    smooth_normal = flat_normal;
    if (instances[id.x].first_normal != NO_ID) {
      dvec3 m = (1.0lf - weight.x - weight.y) * mesh_normal(id.x, v.x) + weight.x * mesh_normal(id.x, v.y) +
                weight.y * mesh_normal(id.x, v.z);
      dvec3 s = world_from_normal(id.x, m);
      double s_length = length(s);
      if (s_length > 0.0lf) {
        s /= s_length;
        smooth_normal = vec3(dot(s, n) < 0.0lf ? -s : s);
      }
    }
  }
  imageStore(position_depth, pixel, surfel);
  imageStore(geometric_normal, pixel, vec4(flat_normal, 0));
  imageStore(shading_normal, pixel, vec4(smooth_normal, 0));
}
