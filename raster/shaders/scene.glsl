// The scene's triangles, fetched by instance and triangle id. Transforms are double precision: world coordinates of
// large scenes differ by less than a float resolves.
struct InstanceData {
  dvec4 rows[3];  // of world_from_mesh
  uint first_index;
  uint first_vertex;
  uint flags;
  uint unused;
};
layout(std430, binding = BUFFER_INSTANCES) restrict readonly buffer Instances { InstanceData instances[]; };
layout(std430, binding = BUFFER_POSITIONS) restrict readonly buffer Positions { float positions[]; };
layout(std430, binding = BUFFER_INDICES) restrict readonly buffer Indices { uint indices[]; };

dvec3 world_from_mesh(uint instance, dvec3 position) {
  dvec4 p = dvec4(position, 1.0lf);
  return dvec3(dot(instances[instance].rows[0], p), dot(instances[instance].rows[1], p),
               dot(instances[instance].rows[2], p));
}

// Numbers of the triangle's vertices in the merged buffers.
uvec3 vertices_of(uint instance, uint triangle) {
  uint first = instances[instance].first_index + 3u * triangle;
  return instances[instance].first_vertex + uvec3(indices[first], indices[first + 1u], indices[first + 2u]);
}

vec3 mesh_position(uint vertex) {
  return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
}
