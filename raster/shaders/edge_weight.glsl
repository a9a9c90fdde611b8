// The weight of a neighbour's ambient occlusion: falls with its distance from the surfel's tangent plane, and with the
// angle between the normals.
uniform sampler2D position_depth;
uniform sampler2D geometric_normal;
uniform float plane_distance;   // metres from the tangent plane at which a weight is 1/e; 0: not weighted
uniform float normal_exponent;  // of the cosine between normals; 0: not weighted

float above_tangent(vec3 position, vec3 normal, ivec2 neighbour) {
  return dot(texelFetch(position_depth, neighbour, 0).xyz - position, normal);
}

float edge_weighted(float weight, vec3 position, vec3 normal, ivec2 neighbour) {
  if (plane_distance > 0.0) {
    float apart = above_tangent(position, normal, neighbour) / plane_distance;
    weight *= exp(-apart * apart);
  }
  if (normal_exponent > 0.0) {
    float cosine = min(max(dot(texelFetch(geometric_normal, neighbour, 0).xyz, normal), 0.0), 1.0);
    weight *= cosine < 1.0 ? pow(cosine, normal_exponent) : 1.0;
  }
  return weight;
}
