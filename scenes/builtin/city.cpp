#include "scenes/builtin/city.h"

#include <algorithm>
#include <cmath>

#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

// Between the axes of two streets, metres.
constexpr double pitch_x = 70.0, pitch_z = 47.0;
constexpr double avenue = 17.0, street = 12.0;
constexpr double pavement = 3.6;

// Index of each fabric's materials; a house takes one of them.
struct Paints {
  std::array<std::vector<std::uint32_t>, fabrics> of;
  std::uint32_t choose(std::size_t fabric, std::uint32_t seed) const {
    const auto& list = of[fabric];
    return list[static_cast<std::size_t>(chance(seed, static_cast<std::uint32_t>(60 + fabric)) *
                                         static_cast<double>(list.size()))];
  }
};

Paints all_paints(Scene& scene) {
  Paints paints;
  const auto add = [&](Fabric fabric, const char* name, const vec3& color) {
    paints.of[fabric].push_back(add_material(scene, name, color));
  };
  add(wall, "red brick", {0.36f, 0.135f, 0.085f});
  add(wall, "brown brick", {0.30f, 0.185f, 0.12f});
  add(wall, "yellow brick", {0.55f, 0.42f, 0.25f});
  add(wall, "sandstone", {0.56f, 0.47f, 0.34f});
  add(wall, "limestone", {0.62f, 0.58f, 0.50f});
  add(wall, "rose plaster", {0.58f, 0.36f, 0.27f});
  add(wall, "grey stone", {0.40f, 0.40f, 0.39f});
  add(wall, "ochre plaster", {0.60f, 0.42f, 0.20f});
  add(trim, "pale stone", {0.62f, 0.59f, 0.52f});
  add(trim, "white paint", {0.72f, 0.71f, 0.67f});
  add(glass, "window", {0.07f, 0.095f, 0.115f});
  add(glass, "dark window", {0.045f, 0.06f, 0.075f});
  add(iron, "black iron", {0.04f, 0.042f, 0.045f});
  add(iron, "grey iron", {0.13f, 0.14f, 0.145f});
  add(roofing, "tar", {0.14f, 0.135f, 0.13f});
  add(roofing, "gravel", {0.30f, 0.28f, 0.25f});
  add(roofing, "copper", {0.19f, 0.37f, 0.31f});
  add(timber, "weathered wood", {0.25f, 0.18f, 0.12f});
  add(timber, "brown wood", {0.20f, 0.12f, 0.07f});
  add(paint, "green paint", {0.07f, 0.19f, 0.12f});
  add(paint, "red paint", {0.45f, 0.07f, 0.05f});
  add(paint, "blue paint", {0.08f, 0.17f, 0.31f});
  add(paint, "mustard paint", {0.55f, 0.36f, 0.06f});
  add(paving, "flagstones", {0.43f, 0.415f, 0.385f});
  paints.of[foliage].push_back(add_sheet_material(scene, "street tree leaf", {0.20f, 0.33f, 0.085f}));
  return paints;
}

void place_block(Scene& scene, Block&& block, const Paints& paints, const std::string& name, std::uint32_t seed) {
  constexpr std::array<const char*, fabrics> names{"wall",   "trim",  "glass",  "iron",   "roofs",
                                                   "timber", "paint", "paving", "foliage"};
  for (std::size_t i = 0; i < fabrics; ++i) {
    Mesh& mesh = block.meshes[i];
    if (mesh.triangles.empty()) continue;
    mesh.name = name + " " + names[i];
    mesh.material = paints.choose(i, seed);
    place_once(scene, std::move(mesh));
  }
}

// A block of the street grid; i counts along x from the avenue, j along −z.
struct Quarter {
  Lot lot;
  double distance = 0.0;
  std::uint32_t seed = 0;
};

// Nearest first, to a point down the avenue.
std::vector<Quarter> quarters_within(int rings) {
  std::vector<Quarter> quarters;
  for (int j = -rings; j <= rings; ++j) {
    for (int i = -rings; i < rings; ++i) {
      // From the third row on the avenue is built over: it leads up to a front.
      const double offset = j >= 2 ? 0.45 * pitch_x : 0.0;
      const double x = offset + pitch_x * i + (i >= 0 ? 0.5 * (avenue - street) : -0.5 * (avenue - street));
      const double z = -pitch_z * j;
      Quarter quarter;
      quarter.lot.x0 = x + 0.5 * street, quarter.lot.x1 = x + pitch_x - 0.5 * street;
      quarter.lot.z0 = z - pitch_z + 0.5 * street, quarter.lot.z1 = z - 0.5 * street;
      quarter.distance =
          std::hypot(0.5 * (quarter.lot.x0 + quarter.lot.x1), 0.55 * (0.5 * (quarter.lot.z0 + quarter.lot.z1) + 45.0));
      // The front that the avenue leads up to comes before what lies beside it.
      if (j == 2 && i == -1) quarter.distance *= 0.5;
      quarter.seed = hash(167, i, j);
      quarters.push_back(quarter);
    }
  }
  std::ranges::stable_sort(quarters, [](const Quarter& a, const Quarter& b) { return a.distance < b.distance; });
  return quarters;
}

// Two rows of houses, back to back. Houses at the avenue come first.
std::vector<House> houses_of(const Quarter& quarter) {
  std::vector<House> houses;
  const Lot& q = quarter.lot;
  const double depth = 0.5 * (q.z1 - q.z0) - pavement - 1.5;
  for (const bool faces_back : {false, true}) {
    double x = q.x0 + pavement;
    const double end = q.x1 - pavement;
    for (std::uint32_t i = 0; end - x > 9.0; ++i) {
      House house;
      house.seed = hash(quarter.seed, faces_back ? 2 : 1, i);
      double width = chance(house.seed, 1, 11.5, 18.5);
      const bool is_last = end - x - width < 10.5;
      if (is_last) width = end - x;
      house.lot = {x + 0.01, x + width - 0.01, 0.0, 0.0, faces_back, i == 0, is_last};
      // Set back by chance, so that neighbours' fronts do not lie in one plane.
      const double back = chance(house.seed, 2, 0.0, 0.35);
      house.lot.z1 = faces_back ? q.z0 + pavement + depth : q.z1 - pavement - back;
      house.lot.z0 = faces_back ? q.z0 + pavement + back : q.z1 - pavement - depth;
      const double far = glm::smoothstep(70.0, 150.0, -0.5 * (q.z0 + q.z1)) + 0.35 * chance(house.seed, 3);
      const double draw = chance(house.seed, 4);
      const bool ends_avenue = std::abs(0.5 * (house.lot.x0 + house.lot.x1) + 3.0) < 8.5 && q.x0 < 0.0 && q.x1 > 0.0;
      if ((draw < 0.1 + 0.45 * far && far > 0.3) || ends_avenue) {
        house.style = Style::tower;
        house.floors = static_cast<int>(chance(house.seed, 5, 11.0, 17.0) + 13.0 * far * chance(house.seed, 6));
      } else if (draw < 0.6) {
        house.style = Style::palace;
        house.floors = static_cast<int>(chance(house.seed, 5, 5.0, 8.6));
      } else {
        house.floors = static_cast<int>(chance(house.seed, 5, 4.0, 7.4));
      }
      houses.push_back(house);
      x += width;
    }
  }
  return houses;
}

// Finest near the first camera; finer everywhere the more triangles there are.
int detail_at(double distance, double triangles) {
  const double near = distance < 50.0 ? 1.0 : 0.0;
  return std::clamp(static_cast<int>(std::floor(0.5 * std::log2(triangles / 4e4) + near)), 0, 4);
}

void add_lamp_light(Scene& scene) {
  const dvec3 head{0.5 * avenue * -1.0 + 0.8, 5.7, -0.5 * street - 3.0};
  scene.lights.push_back({"street lamp", looking(head, head - dvec3(0, 1, 0), dvec3(0, 0, 1)), vec3(1.0f, 0.80f, 0.52f),
                          40.0, SpotLight{24.0, degrees(48.0), degrees(68.0)}});
}

}  // namespace

std::uint64_t triangles_of(const Block& block) {
  std::uint64_t sum = 0;
  for (const Mesh& mesh : block.meshes) sum += mesh.triangles.size();
  return sum;
}

void add_solid(Mesh& mesh, const std::array<dvec3, 8>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const dvec3& corner : corners) mesh.positions.emplace_back(corner);
  const double handed = glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), corners[4] - corners[0]);
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : sides) {
    if (handed > 0.0) {
      mesh.triangles.push_back(uvec3(a, b, c) + first);
      mesh.triangles.push_back(uvec3(a, c, d) + first);
    } else {
      mesh.triangles.push_back(uvec3(a, c, b) + first);
      mesh.triangles.push_back(uvec3(a, d, c) + first);
    }
  }
}

void add_box(Mesh& mesh, const dvec3& low, const dvec3& high) {
  std::array<dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = {(i & 1u) != 0 ? high.x : low.x, (i & 2u) != 0 ? high.y : low.y, (i & 4u) != 0 ? high.z : low.z};
  }
  add_solid(mesh, corners);
}

void add_box(Mesh& mesh, const Face& face, const dvec3& low, const dvec3& high) {
  const dvec3 a = face.at(low.x, low.y, low.z), b = face.at(high.x, high.y, high.z);
  add_box(mesh, glm::min(a, b), glm::max(a, b));
}

void add_shape(Mesh& mesh, const Shape& shape, const dvec3& offset) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const dvec3& point : shape.points) mesh.positions.emplace_back(point + offset);
  for (const uvec3& face : shape.faces) mesh.triangles.push_back(face + first);
}

Scene make_city(std::uint64_t triangles) {
  Scene scene;
  scene.name = "city";
  const std::uint32_t asphalt = add_material(scene, "asphalt", {0.16f, 0.16f, 0.165f});
  const Paints paints = all_paints(scene);
  const double asked = static_cast<double>(triangles);
  std::uint64_t left = triangles - 12;
  Bounds bounds{{-30, -1, -30}, {30, 0, 30}};
  int count = 0, houses = 0;
  // Far more quarters than the finest detail fills; those at the end find nothing left.
  const int rings = 4 + static_cast<int>(std::sqrt(asked / 4e4));
  for (const Quarter& quarter : quarters_within(rings)) {
    if (left < 150) break;
    const int detail = detail_at(quarter.distance, asked);
    Block paved;
    int finest = detail;
    do {
      paved = pave(quarter.lot, quarter.seed, finest);
    } while (triangles_of(paved) > left / 3 && finest-- > 0);
    if (triangles_of(paved) > left) break;
    std::uint64_t rest = left - triangles_of(paved);
    bool is_built = false;
    for (const House& house : houses_of(quarter)) {
      for (int finer = detail; finer >= 0; --finer) {
        Block block = build(house, finer);
        if (triangles_of(block) > rest) continue;
        rest -= triangles_of(block);
        is_built = true;
        place_block(scene, std::move(block), paints, "house " + std::to_string(++houses), house.seed);
        break;
      }
    }
    if (!is_built) break;
    left = rest;
    place_block(scene, std::move(paved), paints, "quarter " + std::to_string(++count), quarter.seed);
    bounds.include({quarter.lot.x0 - avenue, -1, quarter.lot.z0 - street});
    bounds.include({quarter.lot.x1 + avenue, -1, quarter.lot.z1 + street});
  }
  place_once(scene, to_mesh("streets", box(bounds.min, bounds.max), asphalt));

  add_camera(scene, "avenue", looking(dvec3(4.2, 9.0, 21.0), dvec3(-2.0, 12.5, -60.0)), 52.0);
  add_camera(scene, "pavement", looking(dvec3(-10.9, 1.75, -10.4), dvec3(-7.4, 4.2, -40.0)), 58.0);
  add_camera(scene, "roofs", looking(dvec3(80.0, 76.0, 78.0), dvec3(2.0, 15.0, -58.0)), 46.0);
  const double elevation = degrees(38.0);
  const dvec3 to_sun{0.75 * std::cos(elevation), std::sin(elevation), 0.66 * std::cos(elevation)};
  add_sun(scene, "sun", dvec3(0, 0, -50), to_sun, 300.0, 3.0);
  add_lamp_light(scene);
  return scene;
}

}  // namespace umbrameter::builtin
