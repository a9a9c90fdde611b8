// The normals of a mesh that has none.
#pragma once

#include "scenes/scene.h"

namespace umbrameter {

/// The cross product of two sides of a triangle: along its normal, of twice its area.
dvec3 area_vector(const Mesh& mesh, const uvec3& triangle);

/// The same surface with three vertices for each triangle, which have its normal: what a mesh without normals stands
/// for (glTF 2.0, section 3.7.2.1), for programs that would not compute them. Keeps texture coordinates.
Mesh with_flat_normals(const Mesh& mesh);

}  // namespace umbrameter
