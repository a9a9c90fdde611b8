// Fetches the scene's triangles by instance and triangle id. Transforms are in double precision, because a float cannot
// resolve small differences between world coordinates in large scenes. Triangles and vertices are in buffer textures,
// which may be much larger than storage buffers.
struct InstanceData {
  dvec4 rows[3];  // of world_from_mesh
  uint first_triangle;
  uint first_vertex;
  uint first_normal;  // NO_ID: the mesh has none
  uint unused;
};
layout(std430) restrict readonly buffer Instances { InstanceData instances[]; };
uniform samplerBuffer positions;
uniform usamplerBuffer triangles;

dvec3 world_from_mesh(uint instance, dvec3 position) {
  dvec4 p = dvec4(position, 1.0lf);
  return dvec3(dot(instances[instance].rows[0], p), dot(instances[instance].rows[1], p),
               dot(instances[instance].rows[2], p));
}

// A normal of the mesh in the world, neither unit nor turned for a mirrored instance: normals transform with the
// cofactor matrix, the inverse transpose times the determinant.
dvec3 world_from_normal(uint instance, dvec3 normal) {
  dvec3 r0 = instances[instance].rows[0].xyz;
  dvec3 r1 = instances[instance].rows[1].xyz;
  dvec3 r2 = instances[instance].rows[2].xyz;
  return dvec3(dot(cross(r1, r2), normal), dot(cross(r2, r0), normal), dot(cross(r0, r1), normal));
}

bool is_mirrored(uint instance) {
  return dot(instances[instance].rows[0].xyz, cross(instances[instance].rows[1].xyz, instances[instance].rows[2].xyz)) <
         0.0lf;
}

// Indices of the triangle's vertices, relative to the first vertex of the mesh.
uvec3 vertices_of(uint instance, uint triangle) {
  return texelFetch(triangles, int(instances[instance].first_triangle + triangle)).xyz;
}

vec3 mesh_position(uint instance, uint vertex) {
  return texelFetch(positions, int(instances[instance].first_vertex + vertex)).xyz;
}
