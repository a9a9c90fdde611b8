#include <algorithm>
#include <cmath>

#include "scenes/builtin/parts.h"
#include "scenes/builtin/placing.h"

namespace umbrameter::builtin {

Shape crate() {
  constexpr double x = 0.34, z = 0.24, height = 0.36;
  Shape shape = box(dvec3(-x + 0.003, 0.012, -z + 0.003), dvec3(x - 0.003, 0.03, z - 0.003));
  for (const double sx : {-1.0, 1.0}) {
    for (const double sz : {-1.0, 1.0}) {
      const dvec3 middle{sx * (x - 0.022), 0.0, sz * (z - 0.022)};
      append(shape, box(middle + dvec3(-0.02, 0.0, -0.02), middle + dvec3(0.02, height, 0.02)));
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double low = 0.015 + 0.117 * i;
    for (const double side : {-1.0, 1.0}) {
      const double a = side * (z - 0.004), b = side * (z + 0.010);
      append(shape, box(dvec3(-x - 0.01, low, std::min(a, b)), dvec3(x + 0.01, low + 0.1, std::max(a, b))));
      const double c = side * (x - 0.004), d = side * (x + 0.009);
      append(shape, box(dvec3(std::min(c, d), low + 0.001, -z + 0.001), dvec3(std::max(c, d), low + 0.099, z - 0.001)));
    }
  }
  return shape;
}

Shape barrel_staves() {
  std::vector<dvec2> profile{{0.0, -0.005}, {0.24, -0.005}};
  const auto side = bezier({0.25, 0.0}, {0.34, 0.25}, {0.34, 0.6}, {0.25, 0.85}, 12);
  profile.insert(profile.end(), side.begin(), side.end());
  profile.insert(profile.end(), {{0.225, 0.85}, {0.222, 0.81}, {0.0, 0.81}});
  return lathe(profile, 18);
}

Shape barrel_hoops() {
  Shape shape;
  for (const auto& [low, radius] : {std::pair{0.07, 0.278}, {0.22, 0.309}, {0.59, 0.309}, {0.74, 0.278}}) {
    const dvec2 profile[] = {{0.0, low + 0.01}, {radius, low}, {radius, low + 0.04}, {0.0, low + 0.03}};
    append(shape, lathe(profile, 18));
  }
  return shape;
}

Shape bench() {
  Shape shape;
  for (const double x : {-0.72, 0.72}) {
    append(shape, chamfered_box(dvec3(x - 0.045, -0.005, -0.2), dvec3(x + 0.045, 0.43, -0.11), 0.006));
    append(shape, chamfered_box(dvec3(x - 0.045, -0.005, 0.13), dvec3(x + 0.045, 0.43, 0.22), 0.006));
    append(shape, chamfered_box(dvec3(x - 0.04, 0.36, -0.22), dvec3(x + 0.04, 0.435, 0.235), 0.006));
    append(shape, chamfered({dvec3(x - 0.035, 0.40, -0.21), dvec3(x + 0.035, 0.40, -0.21), dvec3(x - 0.035, 0.9, -0.33),
                             dvec3(x + 0.035, 0.9, -0.33), dvec3(x - 0.035, 0.40, -0.15), dvec3(x + 0.035, 0.40, -0.15),
                             dvec3(x - 0.035, 0.9, -0.28), dvec3(x + 0.035, 0.9, -0.28)},
                            0.006));
  }
  for (int i = 0; i < 4; ++i) {
    const double z = -0.13 + 0.1 * i;
    append(shape, chamfered_box(dvec3(-0.9, 0.43, z - 0.043), dvec3(0.9, 0.468, z + 0.043), 0.006));
  }
  for (int i = 0; i < 3; ++i) {
    append(shape, chamfered_box(dvec3(-0.9, 0.54 + 0.115 * i, -0.016), dvec3(0.9, 0.625 + 0.115 * i, 0.016), 0.005),
           moved(dvec3(0, 0, -0.175 - 0.024 * i)) * turned(-13.0, dvec3(1, 0, 0)) * moved(dvec3(0, 0.013 * i, 0.12)));
  }
  return shape;
}

Shape stall_table() {
  Shape shape;
  for (int i = 0; i < 5; ++i) {
    const double z = -0.4 + 0.2 * i;
    append(shape, chamfered_box(dvec3(-1.0, 0.76, z - 0.096), dvec3(1.0, 0.8, z + 0.096), 0.006));
  }
  for (const double x : {-0.85, 0.85}) {
    for (const double z : {-0.38, 0.38}) {
      append(shape, chamfered_box(dvec3(x - 0.04, -0.005, z - 0.04), dvec3(x + 0.04, 0.765, z + 0.04), 0.005));
    }
    append(shape, box(dvec3(x - 0.025, 0.68, -0.42), dvec3(x + 0.025, 0.763, 0.42)));
  }
  append(shape, box(dvec3(-0.83, 0.2, -0.02), dvec3(0.83, 0.26, 0.02)));
  for (const double x : {-0.85, 0.85}) append(shape, box(dvec3(x - 0.022, 0.19, -0.36), dvec3(x + 0.022, 0.27, 0.36)));
  return shape;
}

namespace {

constexpr double front_height = 2.15;
constexpr double back_height = 2.6;
constexpr double inset = 0.07;

}  // namespace

Shape awning_poles(double width, double depth) {
  Shape shape;
  for (const double x : {-0.5 * width + inset, 0.5 * width - inset}) {
    for (const bool front : {false, true}) {
      const double z = front ? 0.5 * depth - inset : -0.5 * depth + inset;
      const double top = (front ? front_height : back_height) + 0.06;
      const dvec3 path[] = {{x, -0.01, z}, {x, top, z}};
      const double radii[] = {0.028, 0.022};
      append(shape, tube(path, radii, 8));
      append(shape, sphere(0.04, 8), moved(dvec3(x, top, z)));
    }
  }
  for (const double z : {-0.5 * depth + inset, 0.5 * depth - inset}) {
    const double y = (z < 0 ? back_height : front_height) - 0.05;
    const dvec3 path[] = {{-0.5 * width + inset, y, z}, {0.5 * width - inset, y, z}};
    const double radii[] = {0.017, 0.017};
    append(shape, tube(path, radii, 8));
  }
  return shape;
}

Shape awning_cloth(double width, double depth) {
  constexpr double thickness = 0.005;
  constexpr double roof_share = 0.72;
  const auto surface = [&](double u, double v) {
    const double x = (u - 0.5) * width;
    const double slope = (front_height - back_height) / depth;
    // Bulges down between the poles.
    const auto sag = [&](double t) { return 0.09 * 4.0 * t * (1.0 - t) * (0.35 + 0.65 * 4.0 * u * (1.0 - u)); };
    if (v <= roof_share) {
      const double t = v / roof_share;
      return dvec3(x, back_height + slope * depth * t - sag(t), (t - 0.5) * depth);
    }
    // The valance bends over a radius of 4 cm and ends in scallops.
    const double t = (v - roof_share) / (1.0 - roof_share);
    const double scallop = std::abs(std::sin(pi * u * 9.0));
    const double length = 0.16 + 0.1 * std::sqrt(scallop);
    constexpr double radius = 0.04;
    constexpr double start = 0.2;
    const double bend = std::min(t / 0.4, 1.0) * (0.5 * pi - start) + start;
    const double y = front_height - radius * (std::cos(start) - std::cos(bend)) - std::max(0.0, t - 0.4) / 0.6 * length;
    return dvec3(x, y,
                 0.5 * depth + radius * (std::sin(bend) - std::sin(start)) +
                     0.012 * std::max(0.0, t - 0.4) * std::sin(pi * u * 18.0));
  };
  return thick_sheet(45, 16, thickness, surface);
}

Shape basin() {
  const dvec2 profile[] = {{0.0, -0.05}, {1.62, -0.05}, {1.62, 0.10}, {1.58, 0.14}, {1.42, 0.15},
                           {1.40, 0.19}, {1.40, 0.50},  {1.44, 0.53}, {1.52, 0.56}, {1.52, 0.62},
                           {1.50, 0.64}, {1.24, 0.64},  {1.22, 0.62}, {1.22, 0.2},  {0.0, 0.18}};
  return lathe(profile, 8);
}

Shape basin_bowl() {
  std::vector<dvec2> profile{{0.0, 0.15}, {0.3, 0.15}, {0.3, 0.3}};
  for (const auto& part : {bezier({0.26, 0.33}, {0.12, 0.4}, {0.1, 0.6}, {0.14, 0.85}, 7),
                           bezier({0.18, 0.87}, {0.2, 0.9}, {0.16, 0.93}, {0.12, 0.96}, 4),
                           bezier({0.1, 1.05}, {0.3, 1.08}, {0.6, 1.12}, {0.68, 1.3}, 8),
                           bezier({0.7, 1.32}, {0.7, 1.35}, {0.66, 1.36}, {0.63, 1.34}, 3),
                           bezier({0.55, 1.22}, {0.4, 1.17}, {0.2, 1.17}, {0.1, 1.19}, 6),
                           bezier({0.07, 1.25}, {0.05, 1.4}, {0.09, 1.45}, {0.1, 1.52}, 6),
                           bezier({0.1, 1.58}, {0.08, 1.62}, {0.03, 1.64}, {0.0, 1.70}, 4)}) {
    profile.insert(profile.end(), part.begin(), part.end());
  }
  return lathe(profile, 24);
}

Shape water_disk(double radius, int segments) {
  const dvec2 profile[] = {{0.0, 0.0}, {radius, 0.0}, {radius, 0.06}, {0.0, 0.06}};
  return lathe(profile, segments);
}

Shape lantern_frame() {
  const dvec2 crown[] = {{0.0, 0.34}, {0.17, 0.34}, {0.17, 0.36}, {0.1, 0.42}, {0.04, 0.48}, {0.0, 0.49}};
  const dvec2 foot[] = {{0.0, -0.03}, {0.05, -0.02}, {0.13, 0.0}, {0.13, 0.025}, {0.0, 0.025}};
  Shape shape = lathe(crown, 12);
  append(shape, lathe(foot, 12));
  for (int i = 0; i < 6; ++i) {
    const double angle = 2.0 * pi * i / 6.0;
    const dvec3 side{std::cos(angle), 0.0, std::sin(angle)};
    const dvec3 path[] = {0.11 * side + dvec3(0, 0.01, 0), 0.145 * side + dvec3(0, 0.35, 0)};
    const double radii[] = {0.009, 0.009};
    append(shape, tube(path, radii, 6));
  }
  const dvec3 chain[] = {{0, 0.47, 0}, {0, 1.6, 0}};
  const double radii[] = {0.008, 0.008};
  append(shape, tube(chain, radii, 6));
  return shape;
}

Shape lantern_light() {
  const dvec2 profile[] = {{0.0, 0.02}, {0.035, 0.02}, {0.035, 0.12}, {0.012, 0.15}, {0.0, 0.19}};
  return lathe(profile, 12);
}

}  // namespace umbrameter::builtin
