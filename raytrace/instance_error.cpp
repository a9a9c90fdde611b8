#include "raytrace/instance_error.h"

#include <algorithm>
#include <cmath>

namespace umbrameter {

// Embree transforms a ray to the space of a shared mesh by a float matrix, which it inverts itself. A cofactor is a
// difference of two products, the determinant a sum of three products with cofactors, and a division follows. With B
// the sums of the absolute terms of the cofactors over |det|, and D that of the determinant over |det|, the error of an
// entry of the inverse is at most γ(10)·D·B. Transforming the point and the translation adds four roundings. These 14,
// taken back to the world by |M|, bound the error of the origin: 14u · D · |M|·B·(|p| + |t|). Rounding the matrix
// itself moves the mesh by u·(|M|·|x| + |t|), which vertex_error() in surfel.cpp includes. (u and γ as at half_ulp.)
OriginError origin_error(const dmat4& world_from_mesh) {
  const dmat3 placed(world_from_mesh);
  const dmat3 linear(glm::abs(placed[0]), glm::abs(placed[1]), glm::abs(placed[2]));
  dmat3 cofactors(0.0);
  for (int column = 0; column < 3; ++column) {
    const dvec3& v = linear[(column + 1) % 3];
    const dvec3& w = linear[(column + 2) % 3];
    cofactors[column] = {v.y * w.z + v.z * w.y, v.z * w.x + v.x * w.z, v.x * w.y + v.y * w.x};
  }
  const double determinant = std::abs(glm::determinant(placed));
  if (!(determinant > 0.0)) return {};  // flat: no ray hits it
  const double spread = glm::dot(linear[0], cofactors[0]) / determinant;
  OriginError error;
  error.linear = 14.0 * half_ulp * spread / determinant * (linear * glm::transpose(cofactors));
  error.constant = error.linear * glm::abs(dvec3(world_from_mesh[3]));
  return error;
}

bool is_similarity(const dmat4& world_from_mesh) {
  const dmat3 gram = glm::transpose(dmat3(world_from_mesh)) * dmat3(world_from_mesh);
  const double scale = (gram[0][0] + gram[1][1] + gram[2][2]) / 3.0;
  double skew = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      skew = std::max(skew, std::abs(gram[column][row] - (row == column ? scale : 0.0)));
    }
  }
  return skew <= 1e-5 * scale;
}

}  // namespace umbrameter
