#include <cmath>

#include "scenes/builtin/parts.h"
#include "scenes/builtin/placing.h"

namespace umbrameter::builtin {
namespace {

void add(std::vector<dvec2>& profile, const std::vector<dvec2>& more) {
  profile.insert(profile.end(), more.begin(), more.end());
}

// A half-round moulding between two heights, that stands out from `radius`.
std::vector<dvec2> torus(double radius, double low, double high, int pieces) {
  std::vector<dvec2> points;
  const double half = 0.5 * (high - low);
  for (int i = 0; i <= pieces; ++i) {
    const double angle = pi * (static_cast<double>(i) / pieces - 0.5);
    points.emplace_back(radius + half * std::cos(angle), low + half + half * std::sin(angle));
  }
  return points;
}

constexpr double voussoir_inner = arch_radius - 0.025;
constexpr double voussoir_outer = arch_radius + 0.28;
constexpr double proud = 0.03;

}  // namespace

Shape column() {
  Shape shape = chamfered_box(dvec3(-0.27, -0.02, -0.27), dvec3(0.27, 0.12, 0.27), 0.008);
  std::vector<dvec2> profile{{0.0, 0.11}, {0.25, 0.11}};
  add(profile, torus(0.21, 0.115, 0.195, 5));
  profile.emplace_back(0.212, 0.21);
  add(profile, torus(0.19, 0.225, 0.275, 4));
  // The shaft keeps its width for a third of its height, then tapers by a sixth (Vignola).
  constexpr double low = 0.3;
  constexpr double high = 2.4;
  for (int i = 0; i <= 7; ++i) {
    const double t = i / 7.0;
    const double past = std::max(0.0, (t - 1.0 / 3.0) * 1.5);
    profile.emplace_back(0.18 - 0.03 * past * past, low + (high - low) * t);
  }
  add(profile, torus(0.15, 2.405, 2.445, 4));
  profile.emplace_back(0.152, 2.46);
  profile.emplace_back(0.152, 2.55);
  add(profile, bezier({0.165, 2.56}, {0.20, 2.58}, {0.245, 2.60}, {0.25, 2.66}, 4));
  profile.emplace_back(0.0, 2.665);
  append(shape, lathe(profile, 20));
  append(shape, chamfered_box(dvec3(-0.27, 2.655, -0.27), dvec3(0.27, 2.74, 0.27), 0.006));
  // The impost widens towards the wall's depth.
  append(shape,
         chamfered({dvec3(-0.235, 2.73, -0.235), dvec3(0.235, 2.73, -0.235), dvec3(-0.30, springing + 0.01, -0.29),
                    dvec3(0.30, springing + 0.01, -0.29), dvec3(-0.235, 2.73, 0.235), dvec3(0.235, 2.73, 0.235),
                    dvec3(-0.30, springing + 0.01, 0.29), dvec3(0.30, springing + 0.01, 0.29)},
                   0.006));
  return shape;
}

Shape arcade_wall(int bays) {
  constexpr int pieces = 28;
  std::vector<dvec2> lower{{-0.25, springing}};
  for (int i = 0; i < bays; ++i) {
    const double center = bay * (i + 0.5);
    for (int j = 0; j <= pieces; ++j) {
      const double angle = pi * (1.0 - static_cast<double>(j) / pieces);
      lower.emplace_back(center + arch_radius * std::cos(angle), springing + arch_radius * std::sin(angle));
    }
  }
  lower.emplace_back(bay * bays + 0.25, springing);
  std::vector<dvec2> upper;
  for (const dvec2& point : lower) upper.emplace_back(point.x, arcade_wall_top);
  return band(lower, upper, arcade_wall_depth);
}

Shape voussoir(int count) {
  const double half = 0.5 * pi / count;
  const double joint = 0.003;
  std::array<dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const double radius = (i & 1u) != 0 ? voussoir_outer : voussoir_inner;
    const double side = (i & 2u) != 0 ? 1.0 : -1.0;
    const double angle = side * (half - joint / radius);
    const double z = (i & 4u) != 0 ? 0.5 * arcade_wall_depth + proud : -0.5 * arcade_wall_depth - proud;
    corners[i] = {radius * std::cos(angle), radius * std::sin(angle), z};
  }
  return chamfered(corners, 0.01);
}

Shape keystone() {
  const double z = 0.5 * arcade_wall_depth + 0.075;
  return chamfered(
      {dvec3(-0.09, arch_radius - 0.06, -z), dvec3(0.09, arch_radius - 0.06, -z), dvec3(-0.145, arch_radius + 0.44, -z),
       dvec3(0.145, arch_radius + 0.44, -z), dvec3(-0.09, arch_radius - 0.06, z), dvec3(0.09, arch_radius - 0.06, z),
       dvec3(-0.145, arch_radius + 0.44, z), dvec3(0.145, arch_radius + 0.44, z)},
      0.012);
}

Shape cornice(double length) {
  std::vector<dvec2> edge{{0.03, 0.0}, {0.04, 0.05}, {0.065, 0.055}, {0.065, 0.085}};
  add(edge, bezier({0.07, 0.09}, {0.09, 0.14}, {0.16, 0.13}, {0.18, 0.19}, 6));
  add(edge, {{0.215, 0.195}, {0.215, 0.255}, {0.23, 0.26}, {0.24, 0.30}});
  std::vector<dvec2> inner;
  for (const dvec2& point : edge) inner.emplace_back(-0.02, point.y);
  // Drawn in (z, y), so that x becomes the length.
  Shape shape;
  append(shape, band(inner, edge, length),
         dmat4(dvec4(0, 0, 1, 0), dvec4(0, 1, 0, 0), dvec4(1, 0, 0, 0), dvec4(0, 0, 0, 1)));
  return shape;
}

Shape baluster() {
  Shape shape = box(dvec3(-0.065, -0.01, -0.065), dvec3(0.065, 0.05, 0.065));
  std::vector<dvec2> profile{{0.0, 0.045}, {0.055, 0.045}, {0.055, 0.06}};
  add(profile, bezier({0.035, 0.075}, {0.03, 0.11}, {0.075, 0.13}, {0.075, 0.2}, 4));
  add(profile, bezier({0.073, 0.23}, {0.07, 0.33}, {0.028, 0.37}, {0.03, 0.48}, 5));
  add(profile, torus(0.032, 0.485, 0.515, 2));
  add(profile, {{0.034, 0.525}, {0.056, 0.555}, {0.056, 0.575}, {0.0, 0.575}});
  append(shape, lathe(profile, 10));
  append(shape, box(dvec3(-0.065, 0.57, -0.065), dvec3(0.065, 0.63, 0.065)));
  return shape;
}

Shape barrel_tile() {
  constexpr int pieces = 4;
  std::vector<dvec2> inner, outer;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = pi * (1.0 - static_cast<double>(i) / pieces);
    inner.emplace_back(0.088 * std::cos(angle), 0.078 * std::sin(angle));
    outer.emplace_back(0.102 * std::cos(angle), 0.092 * std::sin(angle));
  }
  return band(inner, outer, 0.52);
}

Shape finial(double radius) {
  std::vector<dvec2> profile{{0.0, -0.01}, {0.8 * radius, -0.01}, {0.8 * radius, 0.12 * radius}};
  add(profile, bezier({0.7 * radius, 0.18 * radius}, {0.4 * radius, 0.25 * radius}, {0.35 * radius, 0.4 * radius},
                      {0.45 * radius, 0.6 * radius}, 4));
  for (int i = 2; i <= 7; ++i) {
    const double angle = pi * (i / 8.0 - 0.5);
    profile.emplace_back(radius * std::cos(angle), 1.3 * radius + radius * std::sin(angle));
  }
  profile.emplace_back(0.0, 2.3 * radius);
  return lathe(profile, 14);
}

Shape window_frame(double width, double height) {
  Shape shape = chamfered_box(dvec3(-0.5 * width - 0.2, -0.14, -0.06), dvec3(0.5 * width + 0.2, 0.006, 0.14), 0.012);
  for (const double side : {-1.0, 1.0}) {
    // A little into the opening, so that no face lies in the reveal's.
    const double a = side * (0.5 * width - 0.008);
    const double b = side * (0.5 * width + 0.13);
    append(shape,
           chamfered_box(dvec3(std::min(a, b), -0.01, -0.05), dvec3(std::max(a, b), height + 0.005, 0.05), 0.008));
  }
  append(shape, chamfered_box(dvec3(-0.5 * width - 0.17, height - 0.008, -0.055),
                              dvec3(0.5 * width + 0.17, height + 0.18, 0.08), 0.012));
  return shape;
}

Shape shutter(double width, double height) {
  Shape shape;
  for (const double x : {0.0, width - 0.06}) append(shape, box(dvec3(x, 0.0, 0.0), dvec3(x + 0.06, height, 0.04)));
  for (const double y : {0.002, 0.5 * height - 0.04, height - 0.082}) {
    append(shape, box(dvec3(0.053, y, 0.003), dvec3(width - 0.053, y + 0.08, 0.037)));
  }
  const int slats = static_cast<int>(height / 0.07);
  for (int i = 0; i < slats; ++i) {
    const double y = 0.08 + (height - 0.16) * (i + 0.5) / slats;
    append(shape, box(dvec3(0.05, -0.035, -0.005), dvec3(width - 0.05, 0.035, 0.005)),
           moved(dvec3(0.0, y, 0.02)) * turned(-38.0, dvec3(1, 0, 0)));
  }
  return shape;
}

Shape door_surround(double width, double height) {
  Shape shape;
  // The stones reach a little into the opening, so that no face lies in the reveal's.
  for (const double x : {-0.16, width - 0.008}) {
    append(shape, chamfered_box(dvec3(x, -0.01, -0.1), dvec3(x + 0.168, height + 0.06, 0.05), 0.01));
  }
  append(shape, chamfered_box(dvec3(-0.22, height - 0.01, -0.105), dvec3(width + 0.22, height + 0.24, 0.08), 0.012));
  return shape;
}

Shape plank_door(double width, double height) {
  Shape shape = box(dvec3(-0.02, -0.02, -0.06), dvec3(width + 0.02, height + 0.02, 0.0));
  constexpr int planks = 6;
  for (int i = 0; i < planks; ++i) {
    const double x = width * i / planks;
    append(shape, chamfered_box(dvec3(x + 0.004, 0.01, -0.02), dvec3(x + width / planks - 0.004, height - 0.005, 0.035),
                                0.007));
  }
  for (const double y : {0.3, height - 0.5}) {
    append(shape, chamfered_box(dvec3(0.03, y, 0.03), dvec3(width - 0.03, y + 0.14, 0.065), 0.01));
  }
  return shape;
}

}  // namespace umbrameter::builtin
