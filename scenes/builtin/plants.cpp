#include <algorithm>
#include <cmath>

#include "scenes/builtin/parts.h"
#include "scenes/builtin/placing.h"

namespace umbrameter::builtin {
namespace {

dvec3 random_direction(std::uint32_t seed, std::uint32_t index) {
  const double y = chance(seed, 2 * index, -1.0, 1.0);
  const double angle = chance(seed, 2 * index + 1, 0.0, 2.0 * pi);
  const double radius = std::sqrt(std::max(0.0, 1.0 - y * y));
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

dvec3 across(const dvec3& direction) {
  return glm::normalize(glm::cross(direction, std::abs(direction.y) < 0.95 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
}

// Folded along its midrib and bent down towards its tip: four triangles.
void add_leaf(Sheet& sheet, const dvec3& root, const dvec3& direction, const dvec3& side, double length) {
  const dvec3 up = glm::cross(side, direction);
  const auto first = static_cast<std::uint32_t>(sheet.points.size());
  const double width = 0.2 * length;
  const dvec3 middle = root + 0.5 * length * direction;
  for (const dvec3& point :
       {root, middle + width * side + 0.06 * length * up, middle, middle - width * side + 0.06 * length * up,
        root + length * direction - 0.12 * length * up}) {
    sheet.points.push_back(point);
  }
  for (const uvec3& face : {uvec3(0, 1, 2), uvec3(0, 2, 3), uvec3(2, 1, 4), uvec3(3, 2, 4)}) {
    sheet.faces.push_back(face + first);
  }
}

}  // namespace

Shape flower_pot() {
  std::vector<dvec2> profile{{0.0, -0.005}, {0.15, -0.005}, {0.16, 0.01}};
  for (const auto& part :
       {bezier({0.165, 0.05}, {0.2, 0.15}, {0.22, 0.25}, {0.225, 0.32}, 5), std::vector<dvec2>{{0.25, 0.325},
                                                                                               {0.255, 0.335},
                                                                                               {0.255, 0.385},
                                                                                               {0.25, 0.395},
                                                                                               {0.225, 0.395},
                                                                                               {0.215, 0.385},
                                                                                               {0.21, 0.33},
                                                                                               {0.0, 0.33}}}) {
    profile.insert(profile.end(), part.begin(), part.end());
  }
  return lathe(profile, 14);
}

Shape urn() {
  std::vector<dvec2> profile{{0.0, -0.005}, {0.17, -0.005}, {0.17, 0.04}};
  for (const auto& part : {bezier({0.13, 0.06}, {0.07, 0.08}, {0.06, 0.13}, {0.09, 0.17}, 6),
                           bezier({0.13, 0.18}, {0.3, 0.22}, {0.3, 0.4}, {0.24, 0.5}, 10),
                           bezier({0.22, 0.54}, {0.22, 0.56}, {0.27, 0.57}, {0.29, 0.60}, 5),
                           std::vector<dvec2>{{0.29, 0.625}, {0.265, 0.63}, {0.21, 0.56}, {0.0, 0.555}}}) {
    profile.insert(profile.end(), part.begin(), part.end());
  }
  return lathe(profile, 22);
}

Shape soil(double radius) {
  const dvec2 profile[] = {{0.0, 0.0}, {radius, 0.0}, {radius, 0.02}, {0.5 * radius, 0.035}, {0.0, 0.04}};
  return lathe(profile, 12);
}

Shape tree_trunk() {
  Shape shape;
  const dvec3 stem[] = {{0, -0.02, 0},      {0.03, 0.4, 0.02}, {-0.04, 0.85, 0.03},
                        {0.02, 1.3, -0.02}, {0.0, 1.75, 0.0},  {0.05, 2.15, 0.04}};
  const double radii[] = {0.085, 0.068, 0.06, 0.052, 0.038, 0.015};
  append(shape, tube(stem, radii, 12));
  for (std::uint32_t i = 0; i < 7; ++i) {
    const double angle = 2.4 * i;
    const dvec3 out{std::cos(angle), 0.0, std::sin(angle)};
    const double start = 1.15 + 0.09 * i;
    const double reach = chance(11, i, 0.4, 0.65);
    const dvec3 foot{0.0, start, 0.0};
    const dvec3 branch[] = {foot, foot + 0.45 * reach * out + dvec3(0, 0.22, 0), foot + reach * out + dvec3(0, 0.6, 0)};
    const double thin[] = {0.03, 0.02, 0.007};
    append(shape, tube(branch, thin, 7));
  }
  return shape;
}

Sheet leaf_cloud(std::uint32_t seed, int leaves, const dvec3& radii, double leaf_length) {
  Sheet sheet;
  for (int i = 0; i < leaves; ++i) {
    const std::uint32_t index = hash(seed, i);
    const dvec3 out = random_direction(index, 0);
    const double depth = std::cbrt(chance(index, 7, 0.04, 1.0));
    const dvec3 direction = glm::normalize(out + 0.8 * random_direction(index, 1) + dvec3(0, 0.1, 0));
    const dvec3 side = glm::normalize(glm::cross(direction, random_direction(index, 2)));
    add_leaf(sheet, depth * out * radii, direction, side, leaf_length * chance(index, 8, 0.75, 1.25));
  }
  return sheet;
}

Sheet fern(std::uint32_t seed, int cards, double length) {
  Sheet sheet;
  for (int i = 0; i < cards; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double azimuth = 2.0 * pi * (i + chance(index, 0, -0.3, 0.3)) / cards * 2.0;
    const double rise = degrees(chance(index, 1, 28.0, 78.0));
    const dvec3 up{std::cos(azimuth) * std::cos(rise), std::sin(rise), std::sin(azimuth) * std::cos(rise)};
    const double half = 0.5 * length * chance(index, 2, 0.7, 1.1);
    const dvec3 right = across(up);
    add_card(sheet, half * up, 0.7 * half * right, half * up);
  }
  return sheet;
}

Sheet ivy(std::uint32_t seed, int cards, double width, double height) {
  Sheet sheet;
  for (int i = 0; i < cards; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double y = height * std::pow(chance(index, 0), 1.3);
    const double reach = 0.5 * width * (1.0 - 0.6 * y / height);
    const dvec3 center{chance(index, 1, -reach, reach) + 0.25 * std::sin(3.0 * y), y, chance(index, 2, 0.03, 0.1)};
    const double lean = degrees(chance(index, 3, -70.0, 70.0));
    const double tip = degrees(chance(index, 4, 5.0, 40.0));
    const double size = chance(index, 5, 0.13, 0.22);
    const dvec3 right{std::cos(lean), -std::sin(lean), 0.0};
    const dvec3 up{std::sin(lean) * std::cos(tip), std::cos(lean) * std::cos(tip), std::sin(tip)};
    add_card(sheet, center + dvec3(0, 0, size * std::sin(tip)), size * right, size * up);
  }
  return sheet;
}

Shape agave(std::uint32_t seed, int blades, double length) {
  Shape shape;
  for (int i = 0; i < blades; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double azimuth = 2.399963 * i;
    const double steep = degrees(20.0 + 62.0 * i / blades);
    const double reach = length * (1.0 - 0.25 * i / blades) * chance(index, 0, 0.9, 1.1);
    const auto blade = [&](double u, double v) {
      const double along = 0.03 + 0.97 * v;
      const double half = reach * 0.11 * std::sqrt(1.0 - 0.985 * along) * (0.6 + 0.9 * along);
      const double side = (2.0 * u - 1.0) * half;
      const double bend = steep - degrees(18.0) * along * along;
      return dvec3(reach * along * std::cos(bend), reach * along * std::sin(bend) + 1.6 * side * side / (half + 0.01),
                   side);
    };
    append(shape, thick_sheet(2, 6, 0.008, blade), turned(azimuth * 180.0 / pi));
  }
  return shape;
}

Sheet cypress_leaves(std::uint32_t seed, double height) {
  Sheet sheet;
  const int cards = 340;
  for (int i = 0; i < cards; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double t = (i + chance(index, 0)) / cards;
    const double radius = 0.42 * std::pow(1.0 - t, 0.7) * std::min(1.0, 0.45 + 4.0 * t);
    const double azimuth = 2.399963 * i;
    const dvec3 out{std::cos(azimuth), 0.0, std::sin(azimuth)};
    const double size = chance(index, 1, 0.16, 0.25);
    const dvec3 up = glm::normalize(0.38 * out + dvec3(0.0, 1.0, 0.0));
    const dvec3 right = glm::normalize(dvec3(-out.z, 0.0, out.x) + chance(index, 2, -0.9, 0.9) * out);
    add_card(sheet, radius * out * chance(index, 3, 0.75, 1.0) + dvec3(0, height * t, 0), 0.8 * size * right,
             size * up);
  }
  return sheet;
}

}  // namespace umbrameter::builtin
