// Sums and products in a fixed order, so that the CPU implementation in techniques/shadow/reference gives bit-identical
// results. GLSL does not define the order for its built-in dot(), cross() and length().
//
// Nothing writes to a component of a double vector or a column of a double matrix by an index: NVIDIA's compiler
// (driver 580) refuses that for vectors and gives zeros for matrices.
double dot_of(dvec3 a, dvec3 b) {
  precise double sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}

dvec3 cross_of(dvec3 a, dvec3 b) {
  precise dvec3 product = dvec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
  return product;
}

double length_of(dvec3 a) {
  precise double squared = dot_of(a, a);
  return sqrt(squared);
}

dvec3 transform_vector(dmat4 m, dvec3 v) {
  precise dvec3 sum = m[0].xyz * v.x + m[1].xyz * v.y + m[2].xyz * v.z;
  return sum;
}

dvec3 transform_point(dmat4 m, dvec3 p) {
  precise dvec3 sum = transform_vector(m, p) + m[3].xyz;
  return sum;
}
