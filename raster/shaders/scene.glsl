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

// Indices of the triangle's vertices, relative to the first vertex of the mesh.
uvec3 vertices_of(uint instance, uint triangle) {
  return texelFetch(triangles, int(instances[instance].first_triangle + triangle)).xyz;
}

vec3 mesh_position(uint instance, uint vertex) {
  return texelFetch(positions, int(instances[instance].first_vertex + vertex)).xyz;
}
