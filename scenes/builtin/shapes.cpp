#include "scenes/builtin/shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace umbrameter::builtin {
namespace {

std::uint32_t add_point(Shape& shape, const dvec3& point) {
  shape.points.push_back(point);
  return static_cast<std::uint32_t>(shape.points.size() - 1);
}

void add_quad(Shape& shape, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  shape.faces.push_back({a, b, c});
  shape.faces.push_back({a, c, d});
}

Shape turned_outwards(Shape shape) {
  double volume = 0.0;  // six times
  for (const uvec3& face : shape.faces) {
    volume += glm::dot(shape.points[face.x], glm::cross(shape.points[face.y], shape.points[face.z]));
  }
  if (volume < 0.0) {
    for (uvec3& face : shape.faces) std::swap(face.y, face.z);
  }
  return shape;
}

}  // namespace

void append(Shape& shape, const Shape& other, const dmat4& transform) {
  const auto first = static_cast<std::uint32_t>(shape.points.size());
  for (const dvec3& point : other.points) shape.points.push_back(dvec3(transform * dvec4(point, 1.0)));
  const bool mirrored = is_mirrored(transform);
  for (uvec3 face : other.faces) {
    if (mirrored) std::swap(face.y, face.z);
    shape.faces.push_back(face + first);
  }
}

Shape box(const dvec3& low, const dvec3& high) {
  const Bounds bounds{low, high};
  Shape shape;
  for (int i = 0; i < 8; ++i) add_point(shape, bounds.corner(i));
  add_quad(shape, 0, 4, 6, 2);
  add_quad(shape, 1, 3, 7, 5);
  add_quad(shape, 0, 1, 5, 4);
  add_quad(shape, 2, 6, 7, 3);
  add_quad(shape, 0, 2, 3, 1);
  add_quad(shape, 4, 5, 7, 6);
  return shape;
}

Shape chamfered(const std::array<dvec3, 8>& corners, double chamfer) {
  // Point 3·corner + axis lies on the corner's face across that axis, moved in along the face's two edges.
  Shape shape;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      dvec3 point = corners[corner];
      for (std::uint32_t other = 0; other < 3; ++other) {
        if (other == axis) continue;
        point += chamfer * glm::normalize(corners[corner ^ (1u << other)] - corners[corner]);
      }
      add_point(shape, point);
    }
  }
  const auto id = [](std::uint32_t corner, std::uint32_t axis) { return 3 * corner + axis; };
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t u = 1u << ((axis + 1) % 3);
    const std::uint32_t v = 1u << ((axis + 2) % 3);
    const std::uint32_t side = 1u << axis;
    add_quad(shape, id(0, axis), id(v, axis), id(u | v, axis), id(u, axis));
    add_quad(shape, id(side, axis), id(side | u, axis), id(side | u | v, axis), id(side | v, axis));
    // The four edges along this axis join the faces across the other two.
    const std::uint32_t a = (axis + 1) % 3;
    const std::uint32_t b = (axis + 2) % 3;
    for (const std::uint32_t edge : {0u, u, v, u | v}) {
      const bool flipped = edge == u || edge == v;
      const std::uint32_t p = id(edge, a), q = id(edge, b), r = id(edge | side, b), s = id(edge | side, a);
      if (flipped) {
        add_quad(shape, p, s, r, q);
      } else {
        add_quad(shape, p, q, r, s);
      }
    }
  }
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const bool even = corner == 0 || corner == 3 || corner == 5 || corner == 6;
    if (even) {
      shape.faces.push_back({id(corner, 0), id(corner, 2), id(corner, 1)});
    } else {
      shape.faces.push_back({id(corner, 0), id(corner, 1), id(corner, 2)});
    }
  }
  return turned_outwards(std::move(shape));
}

Shape chamfered_box(const dvec3& low, const dvec3& high, double chamfer) {
  const Bounds bounds{low, high};
  std::array<dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) corners[static_cast<std::size_t>(i)] = bounds.corner(i);
  return chamfered(corners, chamfer);
}

Shape bevelled_slab(const dvec3& low, const dvec3& high, double bevel) {
  const dvec3 inward{bevel, 0.0, bevel};
  const dvec3 shoulder{high.x, high.y - bevel, high.z};
  Shape shape;
  for (const auto& [min, max] :
       {std::pair{low, dvec3(shoulder.x, low.y, shoulder.z)}, std::pair{dvec3(low.x, shoulder.y, low.z), shoulder},
        std::pair{dvec3(low.x, high.y, low.z) + inward, high - inward}}) {
    add_point(shape, min);
    add_point(shape, {max.x, min.y, min.z});
    add_point(shape, max);
    add_point(shape, {min.x, min.y, max.z});
  }
  for (std::uint32_t ring : {0u, 4u}) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = (i + 1) % 4;
      add_quad(shape, ring + i, ring + 4 + i, ring + 4 + next, ring + next);
    }
  }
  add_quad(shape, 0, 1, 2, 3);
  add_quad(shape, 8, 11, 10, 9);
  return turned_outwards(std::move(shape));
}

Shape carved(std::span<const Bounds> solids, std::span<const Bounds> holes) {
  std::array<std::vector<double>, 3> cuts;
  for (const auto boxes : {solids, holes}) {
    for (const Bounds& bounds : boxes) {
      for (int axis = 0; axis < 3; ++axis) {
        cuts[static_cast<std::size_t>(axis)].push_back(bounds.min[axis]);
        cuts[static_cast<std::size_t>(axis)].push_back(bounds.max[axis]);
      }
    }
  }
  for (auto& axis : cuts) {
    std::ranges::sort(axis);
    axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
  }
  const std::array<std::size_t, 3> cells{cuts[0].size() - 1, cuts[1].size() - 1, cuts[2].size() - 1};
  using Cell = std::array<std::size_t, 3>;
  const auto is_solid = [&](const Cell& cell) {
    dvec3 middle(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] >= cells[axis]) return false;  // also −1, which wraps
      middle[static_cast<int>(axis)] = 0.5 * (cuts[axis][cell[axis]] + cuts[axis][cell[axis] + 1]);
    }
    const auto holds = [&](const Bounds& bounds) {
      return glm::all(glm::lessThan(bounds.min, middle)) && glm::all(glm::lessThan(middle, bounds.max));
    };
    return std::ranges::any_of(solids, holds) && std::ranges::none_of(holes, holds);
  };
  Shape shape;
  std::vector<std::uint32_t> ids(cuts[0].size() * cuts[1].size() * cuts[2].size(), 0);
  const auto point_id = [&](const Cell& at) {
    std::uint32_t& id = ids[(at[2] * cuts[1].size() + at[1]) * cuts[0].size() + at[0]];
    if (id == 0) id = add_point(shape, {cuts[0][at[0]], cuts[1][at[1]], cuts[2][at[2]]}) + 1;
    return id - 1;
  };
  Cell cell{};
  for (cell[2] = 0; cell[2] < cells[2]; ++cell[2]) {
    for (cell[1] = 0; cell[1] < cells[1]; ++cell[1]) {
      for (cell[0] = 0; cell[0] < cells[0]; ++cell[0]) {
        if (!is_solid(cell)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const bool upper : {false, true}) {
            Cell neighbour = cell;
            neighbour[axis] += upper ? 1 : static_cast<std::size_t>(-1);
            if (is_solid(neighbour)) continue;
            const std::size_t u = (axis + 1) % 3;
            const std::size_t v = (axis + 2) % 3;
            Cell a = cell;
            if (upper) ++a[axis];
            Cell b = a, c = a, d = a;
            ++b[u], ++c[u], ++c[v], ++d[v];
            if (upper) {
              add_quad(shape, point_id(a), point_id(b), point_id(c), point_id(d));
            } else {
              add_quad(shape, point_id(a), point_id(d), point_id(c), point_id(b));
            }
          }
        }
      }
    }
  }
  return shape;
}

Shape lathe(std::span<const dvec2> profile, int segments) {
  assert(profile.size() >= 3 && profile.front().x == 0.0 && profile.back().x == 0.0);
  Shape shape;
  const auto n = static_cast<std::uint32_t>(segments);
  const std::uint32_t first_pole = add_point(shape, {0.0, profile.front().y, 0.0});
  for (std::size_t ring = 1; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * pi * (i + 0.5) / n;
      add_point(shape, {profile[ring].x * std::cos(angle), profile[ring].y, profile[ring].x * std::sin(angle)});
    }
  }
  const std::uint32_t last_pole = add_point(shape, {0.0, profile.back().y, 0.0});
  const auto id = [&](std::size_t ring, std::uint32_t i) { return 1 + static_cast<std::uint32_t>(ring) * n + i % n; };
  const std::size_t rings = profile.size() - 2;
  for (std::uint32_t i = 0; i < n; ++i) {
    shape.faces.push_back({first_pole, id(0, i), id(0, i + 1)});
    for (std::size_t ring = 0; ring + 1 < rings; ++ring) {
      add_quad(shape, id(ring, i), id(ring + 1, i), id(ring + 1, i + 1), id(ring, i + 1));
    }
    shape.faces.push_back({last_pole, id(rings - 1, i + 1), id(rings - 1, i)});
  }
  return turned_outwards(std::move(shape));
}

Shape sphere(double radius, int segments) {
  const int stacks = segments / 2;
  std::vector<dvec2> profile{{0.0, -radius}};
  for (int i = 1; i < stacks; ++i) {
    const double angle = pi * i / stacks;
    profile.emplace_back(radius * std::sin(angle), -radius * std::cos(angle));
  }
  profile.emplace_back(0.0, radius);
  return lathe(profile, segments);
}

Shape band(std::span<const dvec2> lower, std::span<const dvec2> upper, double depth) {
  assert(lower.size() == upper.size() && lower.size() >= 2);
  Shape shape;
  for (const double z : {0.0, depth}) {
    for (std::size_t i = 0; i < lower.size(); ++i) {
      add_point(shape, {lower[i], z});
      add_point(shape, {upper[i], z});
    }
  }
  const auto count = static_cast<std::uint32_t>(lower.size());
  const std::uint32_t back = 2 * count;
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 2, c = 2 * i + 3, d = 2 * i + 1;
    add_quad(shape, a, d, c, b);
    add_quad(shape, back + a, back + b, back + c, back + d);
    add_quad(shape, a, b, back + b, back + a);
    add_quad(shape, d, back + d, back + c, c);
  }
  const std::uint32_t last = 2 * (count - 1);
  add_quad(shape, 0, back, back + 1, 1);
  add_quad(shape, last, last + 1, back + last + 1, back + last);
  return turned_outwards(std::move(shape));
}

Shape tube(std::span<const dvec3> path, std::span<const double> radii, int sides) {
  assert(path.size() == radii.size() && path.size() >= 2);
  Shape shape;
  const auto n = static_cast<std::uint32_t>(sides);
  const auto tangent = [&](std::size_t i) {
    return glm::normalize(path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]);
  };
  // Carried along the path, so that the rod does not twist.
  const dvec3 start = tangent(0);
  dvec3 right = std::abs(start.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  for (std::size_t ring = 0; ring < path.size(); ++ring) {
    const dvec3 forward = tangent(ring);
    right = glm::normalize(right - forward * glm::dot(right, forward));
    const dvec3 up = glm::cross(forward, right);
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * pi * i / n;
      add_point(shape, path[ring] + radii[ring] * (right * std::cos(angle) + up * std::sin(angle)));
    }
  }
  const std::uint32_t first = add_point(shape, path.front());
  const std::uint32_t last = add_point(shape, path.back());
  const auto rings = static_cast<std::uint32_t>(path.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      add_quad(shape, ring * n + i, ring * n + next, (ring + 1) * n + next, (ring + 1) * n + i);
    }
    shape.faces.push_back({first, next, i});
    shape.faces.push_back({last, (rings - 1) * n + i, (rings - 1) * n + next});
  }
  return turned_outwards(std::move(shape));
}

}  // namespace umbrameter::builtin
