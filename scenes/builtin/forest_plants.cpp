#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/builtin/forest.h"

namespace umbrameter::builtin {
namespace {

void add_triangle(Shape& shape, const dvec3& a, const dvec3& b, const dvec3& c) {
  const auto first = static_cast<std::uint32_t>(shape.points.size());
  shape.points.insert(shape.points.end(), {a, b, c});
  shape.faces.push_back({first, first + 1, first + 2});
}

}  // namespace

void add_quad(Shape& shape, const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  const auto first = static_cast<std::uint32_t>(shape.points.size());
  shape.points.insert(shape.points.end(), {a, b, c, d});
  shape.faces.push_back({first, first + 1, first + 2});
  shape.faces.push_back({first, first + 2, first + 3});
}

Shape fern_fronds(std::uint32_t seed, int fronds, double length) {
  Shape shape;
  for (int i = 0; i < fronds; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double azimuth = 2.0 * pi * (i + chance(index, 0, -0.3, 0.3)) / fronds;
    const dvec3 out{std::cos(azimuth), 0.0, std::sin(azimuth)};
    const dvec3 across{-out.z, 0.0, out.x};
    const double own = length * chance(index, 1, 0.75, 1.1);
    const double steep = chance(index, 2, 0.9, 1.4);
    const auto at = [&](double t) { return own * (t * out + dvec3(0, steep * t - 0.85 * steep * t * t, 0)); };
    add_triangle(shape, at(0.0) - 0.012 * across, at(0.0) + 0.012 * across, at(0.55));
    constexpr int pairs = 9;
    for (int k = 0; k < pairs; ++k) {
      const double t = 0.22 + 0.76 * k / pairs;
      const double wide = own * 0.3 * std::sqrt(1.0 - t) * (k == 0 ? 0.7 : 1.0);
      const double step = 0.36 / pairs;
      for (const double hand : {-1.0, 1.0}) {
        const dvec3 tip = at(t + 1.1 * step) + wide * hand * across - dvec3(0, 0.2 * wide, 0);
        if (hand > 0.0) {
          add_triangle(shape, at(t - step), tip, at(t + step));
        } else {
          add_triangle(shape, at(t - step), at(t + step), tip);
        }
      }
    }
    add_triangle(shape, at(0.9) - 0.02 * across, at(0.9) + 0.02 * across, at(1.02));
  }
  return shape;
}

Shape grass_tuft(std::uint32_t seed, int blades, double height) {
  Shape shape;
  for (int i = 0; i < blades; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double azimuth = chance(index, 0, 0.0, 2.0 * pi);
    const dvec3 out{std::cos(azimuth), 0.0, std::sin(azimuth)};
    const dvec3 across{-out.z, 0.0, out.x};
    const dvec3 root = 0.3 * height * std::sqrt(chance(index, 1)) * out - dvec3(0, 0.03, 0);
    const double tall = height * chance(index, 2, 0.6, 1.15);
    const double lean = tall * chance(index, 3, 0.1, 0.6);
    const double half = 0.02 * height + 0.003;
    const dvec3 bend = root + 0.35 * lean * out + dvec3(0, 0.62 * tall, 0);
    add_quad(shape, root - half * across, root + half * across, bend + 0.8 * half * across, bend - 0.8 * half * across);
    add_triangle(shape, bend - 0.8 * half * across, bend + 0.8 * half * across, root + lean * out + dvec3(0, tall, 0));
  }
  return shape;
}

Shape blossoms(std::uint32_t seed, int flowers, double height) {
  Shape shape;
  for (int i = 0; i < flowers; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double azimuth = chance(index, 0, 0.0, 2.0 * pi), reach = 0.9 * std::sqrt(chance(index, 1));
    const dvec3 foot{reach * std::cos(azimuth), 0.0, reach * std::sin(azimuth)};
    const dvec3 top = foot + dvec3(chance(index, 2, -0.05, 0.05), height * chance(index, 3, 0.6, 1.1), 0.0);
    for (int k = 0; k < 6; ++k) {
      const double a = 2.0 * pi * k / 6.0, b = a + 0.75;
      add_triangle(shape, top, top + 0.045 * dvec3(std::cos(b), 0.35, std::sin(b)),
                   top + 0.045 * dvec3(std::cos(a), 0.35, std::sin(a)));
    }
  }
  return shape;
}

Shape rock(std::uint32_t seed, const dvec3& radii, int segments) {
  Shape shape = sphere(1.0, segments);
  for (dvec3& point : shape.points) {
    // Few and large bulges, flattened where it stands.
    double swell = 1.0;
    for (std::uint32_t k = 0; k < 5; ++k) {
      const dvec3 way = glm::normalize(
          dvec3(chance(seed, 3 * k, -1, 1), chance(seed, 3 * k + 1, -1, 1), chance(seed, 3 * k + 2, -1, 1)));
      swell += 0.16 * std::sin(2.2 * glm::dot(way, point) + 1.7 * k);
    }
    point = radii * point * swell;
    point.y = std::max(point.y, -0.6 * radii.y + 0.1 * point.y);
  }
  return shape;
}

Shape fallen_log(double length, double radius) {
  Shape shape;
  const std::array<dvec3, 5> path{dvec3(-0.5 * length, radius, 0.0), dvec3(-0.25 * length, 0.95 * radius, 0.03),
                                  dvec3(0.0, 0.9 * radius, 0.05), dvec3(0.25 * length, 0.95 * radius, -0.02),
                                  dvec3(0.5 * length, radius, -0.08)};
  const std::array<double, 5> radii{1.0 * radius, 0.97 * radius, 0.9 * radius, 0.84 * radius, 0.76 * radius};
  append(shape, tube(path, radii, 16));
  for (int i = 0; i < 3; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const double along = length * (-0.3 + 0.27 * i);
    const double angle = chance(91, index, 0.5, 2.6);
    const dvec3 out{0.25, std::sin(angle), std::cos(angle)};
    const dvec3 foot{along, 0.9 * radius, 0.0};
    const std::array<dvec3, 2> stub{foot, foot + radius * chance(92, index, 1.2, 1.9) * out};
    const std::array<double, 2> thin{0.22 * radius, 0.1 * radius};
    append(shape, tube(stub, thin, 7));
  }
  return shape;
}

Shape lantern_post() {
  Shape shape = chamfered_box({-0.06, -0.4, -0.06}, {0.06, 2.95, 0.06}, 0.015);
  append(shape, chamfered_box({-0.045, 2.74, -0.045}, {0.75, 2.83, 0.045}, 0.012));
  const std::array<dvec3, 2> brace{dvec3(0.03, 2.25, 0.0), dvec3(0.5, 2.76, 0.0)};
  const std::array<double, 2> radii{0.025, 0.025};
  append(shape, tube(brace, radii, 6));
  return shape;
}

}  // namespace umbrameter::builtin
