#include <algorithm>
#include <cmath>

#include "scenes/builtin/forest.h"

namespace umbrameter::builtin {
namespace {

double smooth_step(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Where a mirrored repeat of the ground's picture takes the coordinate.
double folded(double coordinate) {
  const double u = coordinate / ground_tile + 0.5;
  const double turn = u - 2.0 * std::floor(u / 2.0);
  return ground_tile * ((turn > 1.0 ? 2.0 - turn : turn) - 0.5);
}

double path_middle(double z) { return 2.3 * std::sin(z / 8.5) - 0.5; }

// Hills, and a valley along the path.
double relief(double x, double z) {
  const double hills = 0.35 * std::sin(x / 9.0 + 0.4) + 0.3 * std::sin(z / 11.0 + 1.3) +
                       0.12 * std::sin(x / 4.1 + z / 5.3) + 0.05 * std::sin(x / 1.7 - z / 2.3);
  const double outside = std::hypot(x, z);
  return 0.7 * hills + 9.0 * smooth_step(13.0, 52.0, outside) +
         2.5 * std::sin(outside / 47.0) * smooth_step(40.0, 120.0, outside);
}

constexpr double floor_depth = -3.0;

}  // namespace

double noise(std::uint32_t seed, double x, double z) {
  const double left = std::floor(x), near = std::floor(z);
  const auto value = [&](double i, double j) {
    return chance(seed, hash(static_cast<std::uint32_t>(static_cast<std::int64_t>(left + i)),
                             static_cast<std::uint32_t>(static_cast<std::int64_t>(near + j))));
  };
  const double u = smooth_step(0.0, 1.0, x - left), v = smooth_step(0.0, 1.0, z - near);
  return (value(0, 0) * (1.0 - u) + value(1, 0) * u) * (1.0 - v) + (value(0, 1) * (1.0 - u) + value(1, 1) * u) * v;
}

double beyond_path(double x, double z) {
  const double fx = folded(x), fz = folded(z);
  return std::abs(fx - path_middle(fz)) - 0.9 + 0.5 * (noise(71, 0.5 * fx, 0.5 * fz) - 0.5);
}

double beyond_open_ground(double x, double z) {
  const double fx = folded(x), fz = folded(z);
  const double ragged = 1.6 * (noise(71, 0.5 * fx, 0.5 * fz) - 0.5);
  const double clearing = std::hypot(fx / 1.2, fz + 1.0) - 9.0 + ragged;
  return std::min(clearing, beyond_path(x, z));
}

Texture forest_ground() {
  constexpr int size = 512;
  Texture texture;
  texture.name = "forest ground";
  texture.texels = Image<glm::u8vec4>(size, size);
  texture.wrap_u = Wrap::mirrored_repeat;
  texture.wrap_v = Wrap::mirrored_repeat;
  const dvec3 litter(112, 88, 58), moss(92, 104, 52), grass(116, 134, 62), sand(176, 150, 112);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = ground_tile * ((column + 0.5) / size - 0.5);
      const double z = ground_tile * ((row + 0.5) / size - 0.5);
      const double rough = noise(72, 2.5 * x, 2.5 * z), broad = noise(73, 0.35 * x, 0.35 * z);
      dvec3 color = glm::mix(litter, moss, smooth_step(0.35, 0.75, 0.75 * broad + 0.25 * rough));
      color = glm::mix(grass, color, smooth_step(-1.2, 0.8, beyond_open_ground(x, z)));
      const double path = beyond_path(x, z) + 0.15 + 0.4 * (rough - 0.5);
      color = glm::mix(sand, color, smooth_step(-0.35, 0.25, path));
      color *= 0.86 + 0.2 * rough + 0.08 * chance(hash(74, row), static_cast<std::uint32_t>(column), -1.0, 1.0);
      texture.texels.at(column, row) = glm::u8vec4(glm::clamp(color, dvec3(0.0), dvec3(255.0)), 255);
    }
  }
  return texture;
}

double Ground::height(double x, double z) const {
  const double step = 2.0 * half / cells;
  const auto cell = [&](double coordinate) {
    return std::clamp(std::floor((coordinate + half) / step), 0.0, static_cast<double>(cells - 1));
  };
  const double i = cell(x), j = cell(z);
  const double left = -half + i * step, near = -half + j * step;
  const double u = (x - left) / step, v = (z - near) / step;
  const double a = relief(left, near), c = relief(left + step, near + step);
  // The diagonal runs from the corner of least x and z to the opposite one.
  if (u >= v) return a + (relief(left + step, near) - a) * u + (c - relief(left + step, near)) * v;
  return a + (c - relief(left, near + step)) * u + (relief(left, near + step) - a) * v;
}

std::uint64_t triangles_of(const Ground& ground) {
  const auto n = static_cast<std::uint64_t>(ground.cells);
  return 2 * n * n + 12 * n + 4 * (8 * n + 4);  // above, four sides and a fan below; the bands about it
}

Mesh ground_sides(const Ground& ground, std::uint32_t material) {
  Shape shape;
  for (int side = 0; side < 4; ++side) {
    const dmat4 turn = turned(90.0 * side);
    std::vector<dvec2> lower, upper;
    for (int i = 0; i <= ground.cells; ++i) {
      const double along = ground.half * (2.0 * i / ground.cells - 1.0);
      const dvec3 at(turn * dvec4(along, 0.0, ground.half, 1.0));
      lower.emplace_back(along, floor_depth - 0.1);
      upper.emplace_back(along, relief(at.x, at.z) - 0.04);
    }
    append(shape, band(lower, upper, 0.12), turn * moved({0.0, 0.0, ground.half - 0.02}));
  }
  return to_mesh("soil", shape, material, 50.0);
}

Mesh ground_mesh(const Ground& ground, std::uint32_t material) {
  Shape shape;
  const auto n = static_cast<std::uint32_t>(ground.cells);
  const double step = 2.0 * ground.half / ground.cells;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = -ground.half + i * step, z = -ground.half + j * step;
      shape.points.emplace_back(x, relief(x, z), z);
    }
  }
  const auto id = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      shape.faces.push_back({id(i, j), id(i + 1, j + 1), id(i + 1, j)});
      shape.faces.push_back({id(i, j), id(i, j + 1), id(i + 1, j + 1)});
    }
  }
  // Around the border, so that the ground lies on the left.
  std::vector<std::uint32_t> border;
  for (std::uint32_t i = 0; i < n; ++i) border.push_back(id(i, 0));
  for (std::uint32_t j = 0; j < n; ++j) border.push_back(id(n, j));
  for (std::uint32_t i = 0; i < n; ++i) border.push_back(id(n - i, n));
  for (std::uint32_t j = 0; j < n; ++j) border.push_back(id(0, n - j));
  const auto below = static_cast<std::uint32_t>(shape.points.size());
  for (const std::uint32_t point : border) {
    shape.points.emplace_back(shape.points[point].x, floor_depth, shape.points[point].z);
  }
  const auto middle = static_cast<std::uint32_t>(shape.points.size());
  shape.points.emplace_back(0.0, floor_depth, 0.0);
  for (std::uint32_t i = 0; i < 4 * n; ++i) {
    const std::uint32_t next = (i + 1) % (4 * n);
    shape.faces.push_back({border[i], border[next], below + next});
    shape.faces.push_back({border[i], below + next, below + i});
    shape.faces.push_back({middle, below + i, below + next});
  }
  return to_mesh("forest ground", shape, material, 50.0,
                 [](const dvec3& point) { return vec2(dvec2(point.x, point.z) / ground_tile + 0.5); });
}

}  // namespace umbrameter::builtin
