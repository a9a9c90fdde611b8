#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/builtin/forest.h"

namespace umbrameter::builtin {
namespace {

constexpr double golden_angle = 2.399963;  // radians: neighbours on a stem never line up

dvec3 heading(double azimuth, double slope) {
  return glm::normalize(dvec3(std::cos(azimuth), slope, std::sin(azimuth)));
}

// Two triangles about the midrib, a little folded. `face` is about where the upper side looks.
void add_blade(Shape& shape, const dvec3& root, const dvec3& direction, const dvec3& face, double length,
               double width) {
  const dvec3 side = glm::normalize(glm::cross(direction, face));
  const dvec3 up = glm::cross(side, direction);
  const dvec3 middle = root + 0.45 * length * direction + 0.12 * width * up;
  add_quad(shape, root, middle + 0.5 * width * side, root + length * direction, middle - 0.5 * width * side);
}

dvec3 anywhere(std::uint32_t index) {
  return {chance(index, 0, -1.0, 1.0), chance(index, 1, -1.0, 1.0), chance(index, 2, -1.0, 1.0)};
}

// Leaves lie more flat than steep, and point outwards and down.
void add_clump(Shape& shape, std::uint32_t seed, const dvec3& center, const dvec3& outwards, int leaves, double radius,
               double leaf) {
  for (int i = 0; i < leaves; ++i) {
    const std::uint32_t index = hash(seed, i);
    const dvec3 offset = anywhere(index) * dvec3(1.0, 0.6, 1.0);
    const dvec3 direction =
        glm::normalize(0.7 * outwards + 0.9 * offset + anywhere(hash(index, 1)) * 0.5 + dvec3(0, -0.35, 0));
    const dvec3 face = glm::normalize(dvec3(0, 1, 0) + 0.8 * anywhere(hash(index, 2)) + 0.25 * outwards);
    const double length = leaf * chance(index, 3, 0.75, 1.25);
    add_blade(shape, center + radius * offset, direction, face, length, 0.55 * length);
  }
}

struct Stem {
  std::vector<dvec3> path;
  std::vector<double> radii;
  // t runs from 0 to 1 along the points.
  dvec3 at(double t) const { return along(path, t); }
  double radius(double t) const { return along(radii, t); }
  template <class T>
  static T along(const std::vector<T>& values, double t) {
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(values.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), values.size() - 2);
    return values[i] + (values[i + 1] - values[i]) * (place - static_cast<double>(i));
  }
};

// Rooted a little below the ground, with a flare, so that it may stand on a slope.
Stem trunk(std::uint32_t seed, double height, double radius, double wander, int pieces) {
  Stem stem;
  stem.path = {{0, -0.5, 0}, {0, 0.12, 0}};
  stem.radii = {1.75 * radius, 1.3 * radius};
  dvec3 point(0.0, 0.12, 0.0);
  for (int i = 1; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const std::uint32_t index = hash(seed, i);
    point += wander * dvec3(chance(index, 0, -1, 1), 0.0, chance(index, 1, -1, 1));
    point.y = 0.12 + t * height;
    stem.path.push_back(point);
    stem.radii.push_back(radius * (1.0 - 0.86 * t));
  }
  return stem;
}

}  // namespace

Plant broadleaf(const BroadleafStyle& style) {
  Plant plant;
  const Stem stem = trunk(style.seed, 0.86 * style.height, style.trunk_radius, 0.018 * style.height, 6);
  append(plant.wood, tube(stem.path, stem.radii, style.trunk_radius > 0.2 ? 11 : 7));
  for (int i = 0; i < style.limbs; ++i) {
    const std::uint32_t seed = hash(style.seed, 100 + i);
    const double share = (i + chance(seed, 0)) / style.limbs;
    const double t = style.crown_start + (1.0 - style.crown_start) * share;
    // The crown is widest a third of its way up.
    const double reach = style.spread * std::sqrt(std::max(0.1, 1.0 - 1.9 * (share - 0.33) * (share - 0.33))) *
                         (1.0 - 0.45 * share) * chance(seed, 1, 0.8, 1.15);
    const double azimuth = golden_angle * i + chance(seed, 2, -0.3, 0.3);
    const double slope = style.rise + 0.9 * share * std::abs(style.rise) + chance(seed, 3, -0.15, 0.15);
    const dvec3 foot = stem.at(t);
    const double thick = std::min(0.6 * stem.radius(t), 0.045 * reach + 0.01);
    const dvec3 middle = foot + 0.5 * reach * heading(azimuth, 1.15 * std::abs(slope));
    const dvec3 tip = middle + 0.55 * reach * heading(azimuth + chance(seed, 4, -0.4, 0.4), 0.6 * slope);
    const Stem limb{{foot, middle, tip}, {thick, 0.6 * thick, 0.2 * thick}};
    append(plant.wood, tube(limb.path, limb.radii, 5));
    for (int j = 0; j < style.twigs; ++j) {
      const std::uint32_t twig = hash(seed, 200 + j);
      const double from = 0.4 + 0.6 * (j + 0.5) / style.twigs;
      const double turn = (j % 2 == 0 ? 1.0 : -1.0) * chance(twig, 0, 0.4, 1.1);
      const double length = reach * (0.42 - 0.2 * from) * chance(twig, 1, 0.8, 1.2);
      const dvec3 way = heading(azimuth + turn, 0.6 * slope + chance(twig, 2, -0.2, 0.35));
      const dvec3 end = limb.at(from) + length * way;
      const std::array<dvec3, 2> path{limb.at(from), end};
      const std::array<double, 2> radii{0.55 * limb.radius(from), 0.25 * limb.radius(from)};
      append(plant.wood, tube(path, radii, 3));
      add_clump(plant.leaves, twig, end, way, style.leaves, style.clump, style.leaf);
    }
    add_clump(plant.leaves, hash(seed, 300), tip, heading(azimuth, slope), style.leaves, style.clump, style.leaf);
  }
  add_clump(plant.leaves, hash(style.seed, 400), stem.path.back(), dvec3(0, 1, 0), 2 * style.leaves, 1.2 * style.clump,
            style.leaf);
  return plant;
}

Plant spruce(std::uint32_t seed, double height, double reach, int whorls, int branches) {
  Plant plant;
  const double radius = 0.016 * height;
  const Stem stem = trunk(seed, height, radius, 0.004 * height, 5);
  append(plant.wood, tube(stem.path, stem.radii, 8));
  for (int i = 0; i < whorls; ++i) {
    const double share = static_cast<double>(i) / whorls;
    const double y = height * (0.12 + 0.86 * share);
    const double length = reach * (1.0 - 0.94 * share) * (i == 0 ? 0.8 : 1.0);
    for (int j = 0; j < branches; ++j) {
      const std::uint32_t index = hash(seed, 1000 + i * 64 + j);
      const double azimuth = 2.0 * pi * (j + 0.5 * (i % 2)) / branches + chance(index, 0, -0.25, 0.25);
      const double own = length * chance(index, 1, 0.75, 1.15);
      const dvec3 out{std::cos(azimuth), 0.0, std::sin(azimuth)};
      const dvec3 across{-out.z, 0.0, out.x};
      const dvec3 foot{0.0, y + chance(index, 2, -0.1, 0.1), 0.0};
      // Hangs, and lifts its tip.
      const auto at = [&](double t) { return foot + own * (t * out + dvec3(0, -0.42 * t + 0.2 * t * t, 0)); };
      const std::array<dvec3, 3> path{at(0.0), at(0.5), at(1.0)};
      const std::array<double, 3> radii{0.3 * stem.radius(share) + 0.008, 0.012, 0.004};
      if (i % 2 == 0) append(plant.wood, tube(path, radii, 3));
      const int sprays = std::max(3, static_cast<int>(own / 0.24));
      for (int k = 0; k < sprays; ++k) {
        const double t = 0.12 + 0.88 * k / sprays;
        const double wide = (0.62 - 0.4 * t) * std::min(1.0, own) * chance(hash(index, k), 3, 0.8, 1.2);
        for (const double hand : {-1.0, 1.0}) {
          const dvec3 way = glm::normalize(0.75 * out + hand * across + dvec3(0, -0.25, 0));
          add_blade(plant.leaves, at(t), way, dvec3(0, 1, 0) + 0.3 * hand * across, wide, 0.34 * wide + 0.05);
        }
      }
      add_blade(plant.leaves, at(0.75), glm::normalize(out + dvec3(0, 0.05, 0)), dvec3(0, 1, 0), 0.36 * own + 0.1,
                0.14 * own + 0.04);
    }
  }
  return plant;
}

Plant bush(std::uint32_t seed, double radius, int stems, int leaves) {
  Plant plant;
  for (int i = 0; i < stems; ++i) {
    const std::uint32_t index = hash(seed, i);
    const double azimuth = golden_angle * i;
    const dvec3 way = heading(azimuth, chance(index, 0, 0.6, 2.6));
    const double length = radius * chance(index, 1, 0.8, 1.25);
    const dvec3 foot = 0.08 * radius * dvec3(way.x, -2.0, way.z);
    const std::array<dvec3, 3> path{foot, foot + 0.55 * length * way + dvec3(0, 0.1 * length, 0),
                                    foot + length * way + dvec3(0, 0.12 * length, 0)};
    const std::array<double, 3> radii{0.022, 0.014, 0.006};
    append(plant.wood, tube(path, radii, 4));
    add_clump(plant.leaves, index, path[2], way, leaves, 0.42 * radius, 0.13 * radius + 0.04);
    add_clump(plant.leaves, hash(index, 5), path[1], way, leaves / 2, 0.36 * radius, 0.12 * radius + 0.04);
  }
  return plant;
}

}  // namespace umbrameter::builtin
