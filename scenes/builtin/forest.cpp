#include "scenes/builtin/forest.h"

#include <algorithm>
#include <cmath>

#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

enum Kind : std::uint32_t {
  old_oak,
  oak,
  beech,
  young_beech,
  birch,
  young_birch,
  tall_spruce,
  spruce_tree,
  young_spruce,
  hazel,
  holly,
  fern,
  small_fern,
  grass,
  tall_grass,
  daisies,
  foxgloves,
  grey_rock,
  mossy_rock,
  fallen_trunk,
  kinds
};

constexpr double smooth = 180.0;  // crease of leaves: none

// What stands in many places: one mesh per material.
struct Species {
  std::vector<Mesh> parts;
  std::uint64_t triangles = 0;
};

struct Stand {
  std::uint32_t species = 0;
  dmat4 world_from_plant{1.0};
};

void add_part(Species& species, Mesh mesh) {
  species.triangles += mesh.triangles.size();
  species.parts.push_back(std::move(mesh));
}

Species species_of(const std::string& name, const Plant& plant, std::uint32_t bark, std::uint32_t leaf) {
  Species species;
  add_part(species, to_mesh(name + " wood", plant.wood, bark, 60.0));
  add_part(species, to_mesh(name + " leaves", plant.leaves, leaf, smooth));
  return species;
}

Species species_of(Mesh mesh) {
  Species species;
  add_part(species, std::move(mesh));
  return species;
}

std::vector<Species> all_species(Scene& scene) {
  const std::uint32_t grey_bark = add_material(scene, "grey bark", {0.17f, 0.15f, 0.125f});
  const std::uint32_t brown_bark = add_material(scene, "brown bark", {0.15f, 0.105f, 0.07f});
  const std::uint32_t white_bark = add_material(scene, "white bark", {0.62f, 0.60f, 0.55f});
  const std::uint32_t stone = add_material(scene, "grey stone", {0.33f, 0.32f, 0.30f});
  const std::uint32_t moss = add_material(scene, "mossy stone", {0.20f, 0.24f, 0.12f});
  const auto leaf = [&](const char* name, const vec3& color) { return add_sheet_material(scene, name, color); };
  const std::uint32_t oak_leaf = leaf("oak leaf", {0.182f, 0.311f, 0.0743f});
  const std::uint32_t beech_leaf = leaf("beech leaf", {0.243f, 0.419f, 0.0945f});
  const std::uint32_t birch_leaf = leaf("birch leaf", {0.365f, 0.486f, 0.121f});
  const std::uint32_t needle = leaf("spruce needles", {0.0878f, 0.182f, 0.0945f});
  const std::uint32_t hazel_leaf = leaf("hazel leaf", {0.27f, 0.405f, 0.115f});
  const std::uint32_t holly_leaf = leaf("holly leaf", {0.0945f, 0.203f, 0.081f});
  const std::uint32_t frond = leaf("fern frond", {0.27f, 0.459f, 0.108f});
  const std::uint32_t blade = leaf("grass blade", {0.338f, 0.472f, 0.149f});
  const std::uint32_t white = leaf("white petal", {0.8f, 0.78f, 0.7f});
  const std::uint32_t purple = leaf("purple petal", {0.46f, 0.16f, 0.44f});

  BroadleafStyle big;
  big.seed = 5, big.height = 14.5, big.crown_start = 0.3, big.spread = 6.2, big.trunk_radius = 0.46, big.rise = 0.35;
  big.limbs = 17, big.twigs = 6, big.leaves = 34, big.leaf = 0.3, big.clump = 0.85;
  BroadleafStyle middling = big;
  middling.seed = 11, middling.height = 12.5, middling.spread = 4.4, middling.trunk_radius = 0.3;
  middling.limbs = 14, middling.twigs = 5, middling.leaves = 26, middling.clump = 0.75;
  BroadleafStyle slender;
  slender.seed = 23, slender.height = 16.5, slender.crown_start = 0.38, slender.spread = 3.9;
  slender.trunk_radius = 0.27, slender.rise = 0.9, slender.limbs = 17, slender.twigs = 5, slender.leaves = 24;
  slender.leaf = 0.27, slender.clump = 0.7;
  BroadleafStyle young = slender;
  young.seed = 31, young.height = 8.0, young.crown_start = 0.22, young.spread = 2.3, young.trunk_radius = 0.09;
  young.limbs = 10, young.twigs = 3, young.leaves = 20, young.clump = 0.55;
  BroadleafStyle drooping;
  drooping.seed = 47, drooping.height = 13.5, drooping.crown_start = 0.32, drooping.spread = 2.5;
  drooping.trunk_radius = 0.16, drooping.rise = -0.2, drooping.limbs = 18, drooping.twigs = 4, drooping.leaves = 20;
  drooping.leaf = 0.19, drooping.clump = 0.6;
  BroadleafStyle sapling = drooping;
  sapling.seed = 53, sapling.height = 6.5, sapling.spread = 1.5, sapling.trunk_radius = 0.07, sapling.limbs = 11;
  sapling.twigs = 2, sapling.leaves = 18, sapling.clump = 0.45;

  std::vector<Species> species(kinds);
  species[old_oak] = species_of("old oak", broadleaf(big), grey_bark, oak_leaf);
  species[oak] = species_of("oak", broadleaf(middling), grey_bark, oak_leaf);
  species[beech] = species_of("beech", broadleaf(slender), grey_bark, beech_leaf);
  species[young_beech] = species_of("young beech", broadleaf(young), grey_bark, beech_leaf);
  species[birch] = species_of("birch", broadleaf(drooping), white_bark, birch_leaf);
  species[young_birch] = species_of("young birch", broadleaf(sapling), white_bark, birch_leaf);
  species[tall_spruce] = species_of("tall spruce", spruce(61, 17.0, 3.1, 24, 9), brown_bark, needle);
  species[spruce_tree] = species_of("spruce", spruce(67, 11.0, 2.4, 18, 8), brown_bark, needle);
  species[young_spruce] = species_of("young spruce", spruce(71, 3.2, 1.05, 10, 7), brown_bark, needle);
  species[hazel] = species_of("hazel", bush(83, 1.15, 11, 22), brown_bark, hazel_leaf);
  species[holly] = species_of("holly", bush(89, 0.75, 8, 18), brown_bark, holly_leaf);
  species[fern] = species_of(to_mesh("fern", fern_fronds(97, 11, 0.85), frond, smooth));
  species[small_fern] = species_of(to_mesh("small fern", fern_fronds(101, 7, 0.5), frond, smooth));
  species[grass] = species_of(to_mesh("grass", grass_tuft(103, 26, 0.24), blade, smooth));
  species[tall_grass] = species_of(to_mesh("tall grass", grass_tuft(107, 30, 0.5), blade, smooth));
  species[daisies] = species_of(to_mesh("daisies", blossoms(109, 14, 0.2), white, smooth));
  species[foxgloves] = species_of(to_mesh("foxgloves", blossoms(113, 10, 0.4), purple, smooth));
  species[grey_rock] = species_of(to_mesh("rock", rock(127, {0.62, 0.42, 0.5}, 14), stone, 40.0));
  species[mossy_rock] = species_of(to_mesh("mossy rock", rock(131, {0.95, 0.55, 0.7}, 16), moss, 40.0));
  species[fallen_trunk] = species_of(to_mesh("fallen log", fallen_log(5.2, 0.34), brown_bark, 60.0));
  return species;
}

// Groves: what stands together is of a kind.
Kind tree_at(double x, double z, std::uint32_t index) {
  const double grove = noise(139, x / 13.0, z / 13.0) + chance(index, 3, -0.22, 0.22);
  const double age = chance(index, 4);
  if (grove < 0.36) return age < 0.45 ? tall_spruce : age < 0.75 ? spruce_tree : young_spruce;
  if (grove < 0.52) return age < 0.6 ? birch : young_birch;
  if (grove < 0.74) return age < 0.65 ? beech : young_beech;
  return age < 0.3 ? old_oak : age < 0.8 ? oak : young_beech;
}

Kind undergrowth_at(double x, double z, double open, std::uint32_t index) {
  const double draw = chance(index, 3);
  // Ferns line the open ground.
  if (open < 1.8 && draw > 0.25) return draw < 0.7 ? fern : draw < 0.9 ? tall_grass : foxgloves;
  const double damp = noise(149, x / 6.0, z / 6.0);
  if (draw < 0.07) return hazel;
  if (draw < 0.12) return holly;
  if (draw < 0.16) return grey_rock;
  if (draw < 0.18) return mossy_rock;
  if (draw < 0.19) return fallen_trunk;
  if (draw < 0.24) return young_spruce;
  if (damp > 0.45) return draw < 0.7 ? fern : small_fern;
  return draw < 0.55 ? tall_grass : draw < 0.7 ? foxgloves : small_fern;
}

struct Site {
  double x, z;
  Kind kind;
  double from_middle() const { return std::max(std::abs(x), std::abs(z)); }
};

// A site in each cell of a square grid, moved about in it by chance.
template <class Choose>
void for_each_cell(double half, double cell, std::uint32_t seed, const Choose& choose) {
  const int reach = static_cast<int>(half / cell);
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const std::uint32_t index = hash(seed, i, j);
      choose(cell * (i + chance(index, 0, -0.4, 0.4)), cell * (j + chance(index, 1, -0.4, 0.4)), index);
    }
  }
}

std::vector<Site> sites_within(double half) {
  std::vector<Site> sites;
  for_each_cell(half, 4.1, 151, [&](double x, double z, std::uint32_t index) {
    const Kind kind = tree_at(x, z, index);
    const double room = kind == old_oak ? 2.2 : kind == young_spruce || kind == young_birch ? 0.7 : 1.1;
    if (beyond_open_ground(x, z) > room) sites.push_back({x, z, kind});
  });
  for_each_cell(half, 1.4, 157, [&](double x, double z, std::uint32_t index) {
    const double open = beyond_open_ground(x, z);
    const Kind kind = undergrowth_at(x, z, open, index);
    if (open > 0.0) sites.push_back({x, z, kind});
  });
  // The open ground is grown over more closely.
  for_each_cell(half, 0.9, 159, [&](double x, double z, std::uint32_t index) {
    const double open = beyond_open_ground(x, z);
    const bool sandy = std::abs(beyond_path(x, z)) < 0.85;
    if (open < 0.4 && !sandy) sites.push_back({x, z, chance(index, 3) < 0.72 ? grass : daisies});
  });
  std::ranges::stable_sort(sites, [](const Site& a, const Site& b) { return a.from_middle() < b.from_middle(); });
  return sites;
}

dmat4 pose(const Ground& ground, const Site& site, std::uint32_t seed) {
  const double size = chance(seed, 0, 0.82, 1.22);
  const double tilt = site.kind <= spruce_tree ? 2.5 : 9.0;
  return moved({site.x, ground.height(site.x, site.z), site.z}) * turned(chance(seed, 1, 0.0, 360.0)) *
         turned(chance(seed, 2, -tilt, tilt), {1, 0, 0}) * scaled(dvec3(size, size * chance(seed, 3, 0.9, 1.12), size));
}

// What the first camera's picture is composed of.
std::vector<Stand> composition(const Ground& ground) {
  const auto at = [&](Kind kind, double x, double z, double turn, double size) {
    return Stand{kind, moved({x, ground.height(x, z), z}) * turned(turn) * scaled(dvec3(size))};
  };
  return {
      at(old_oak, -7.6, -8.2, 40.0, 1.05), at(fallen_trunk, 4.6, -0.8, 24.0, 1.0), at(mossy_rock, 6.4, 1.4, 70.0, 1.1),
      at(grey_rock, 5.2, 2.3, 10.0, 0.9),  at(grey_rock, -3.4, 5.4, 130.0, 0.8),   at(fern, -5.9, 1.3, 0.0, 1.1),
      at(fern, -4.6, 0.5, 50.0, 0.9),      at(fern, -6.9, 0.9, 120.0, 1.2),        at(fern, -4.2, 2.2, 80.0, 0.8),
      at(fern, -3.4, 3.2, 200.0, 1.0),     at(fern, -5.3, 2.3, 160.0, 0.7),        at(fern, 3.6, 8.6, 30.0, 1.1),
      at(fern, 4.6, 8.0, 90.0, 1.2),       at(fern, -2.3, 8.9, 70.0, 1.2),         at(fern, -3.4, 8.2, 10.0, 1.0),
      at(tall_grass, 3.0, 9.2, 0.0, 1.0),  at(tall_grass, -1.6, 9.5, 0.0, 1.0)};
}

constexpr dvec3 first_eye{1.3, 2.2, 12.2};
constexpr dvec3 low_eye{-6.6, 1.0, 3.6};

bool is_taken(const std::vector<Stand>& stands, const Site& site) {
  // Nothing is to hang before a lens.
  const bool is_tree = site.kind <= spruce_tree;
  const double near_first = std::hypot(site.x - first_eye.x, site.z - first_eye.z);
  const double near_low = std::hypot(site.x - low_eye.x, site.z - low_eye.z);
  if (near_first < (is_tree ? 5.0 : 1.6) || near_low < (is_tree ? 4.0 : 1.0)) return true;
  return std::ranges::any_of(stands, [&](const Stand& stand) {
    const dvec4& foot = stand.world_from_plant[3];
    return std::hypot(foot.x - site.x, foot.z - site.z) < (is_tree ? 3.6 : 1.1);
  });
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

void add_lantern(Scene& scene, const Ground& ground) {
  const dvec3 foot{1.0, ground.height(1.0, -4.6), -4.6};
  const std::uint32_t wood = add_material(scene, "post", {0.12f, 0.075f, 0.045f});
  const std::uint32_t iron = add_material(scene, "iron", {0.035f, 0.038f, 0.038f});
  const std::uint32_t candle = add_material(scene, "candle", {0.80f, 0.74f, 0.60f});
  place_once(scene, to_mesh("lantern post", lantern_post(), wood), moved(foot));
  const dvec3 hook = foot + dvec3(0.66, 1.18, 0.0);
  place_once(scene, to_mesh("lantern", lantern_frame(), iron), moved(hook));
  place_once(scene, to_mesh("candle", lantern_light(), candle), moved(hook));
  scene.lights.push_back({"lantern", looking(hook + dvec3(0, 0.27, 0), hook + dvec3(0, 0.27, 1)),
                          vec3(1.0f, 0.72f, 0.40f), 7.0, PointLight{14.0}});
}

}  // namespace

Scene make_forest(std::uint64_t triangles) {
  Scene scene;
  scene.name = "forest";
  const std::uint32_t floor = add_material(scene, "forest ground", vec3(1.0f));
  scene.materials[floor].base_color_texture = 0;
  scene.textures.push_back(forest_ground());
  const std::uint32_t soil = add_material(scene, "soil", {0.13f, 0.085f, 0.055f});
  const std::vector<Species> species = all_species(scene);

  // Three hundred triangles a square metre, give or take the clearings; the last stand decides where the ground ends.
  const double asked = static_cast<double>(triangles);
  Ground ground;
  ground.half = 0.5 * std::sqrt(asked / 300.0) * 1.3 + 12.0;
  ground.cells = std::clamp(static_cast<int>(std::sqrt(asked / 60.0)), 24, 180);
  // The fewest that may be asked for are several times what the composition needs.
  std::uint64_t left = triangles - triangles_of(ground);
  const std::vector<Stand> composed = composition(ground);
  for (const Stand& stand : composed) left -= species[stand.species].triangles;
  double reach = 14.0;
  std::vector<Site> kept;
  for (const Site& site : sites_within(ground.half)) {
    if (left < species[grass].triangles) break;
    if (species[site.kind].triangles > left || is_taken(composed, site)) continue;
    left -= species[site.kind].triangles;
    reach = std::max(reach, site.from_middle());
    kept.push_back(site);
  }
  ground.half = std::min(ground.half, reach + 2.0);
  std::vector<Stand> stands = composition(ground);
  for (std::uint32_t i = 0; i < kept.size(); ++i) stands.push_back({kept[i].kind, pose(ground, kept[i], hash(163, i))});

  place_once(scene, ground_mesh(ground, floor));
  place_once(scene, ground_sides(ground, soil));
  std::ranges::stable_sort(stands, [](const Stand& a, const Stand& b) { return a.species < b.species; });
  for (auto first = stands.begin(); first != stands.end();) {
    const auto last = std::find_if(first, stands.end(), [&](const Stand& s) { return s.species != first->species; });
    // Neighbours share a mesh, so that they are drawn together.
    for (const Mesh& part : species[first->species].parts) {
      const std::uint32_t mesh = add_mesh(scene, part);
      for (auto stand = first; stand != last; ++stand) place(scene, mesh, part.name, stand->world_from_plant);
    }
    first = last;
  }

  const auto stand_at = [&](const dvec3& eye) { return eye + dvec3(0, ground.height(eye.x, eye.z), 0); };
  add_camera(scene, "clearing", looking(stand_at(first_eye), dvec3(-1.2, 3.3, -6.0)), 54.0);
  add_camera(scene, "undergrowth", looking(stand_at(low_eye), dvec3(1.5, 1.2, -4.0)), 50.0);
  const double far = ground.half;
  add_camera(scene, "above", looking(dvec3(1.3 * far, 1.15 * far + 14.0, 1.8 * far), dvec3(0.0, 3.0, 0.08 * far)),
             42.0);

  const double elevation = degrees(48.0);
  const dvec3 to_sun{-0.72 * std::cos(elevation), std::sin(elevation), 0.69 * std::cos(elevation)};
  add_sun(scene, "sun", dvec3(0.0), to_sun, 60.0, 3.0);
  add_lantern(scene, ground);
  return scene;
}

}  // namespace umbrameter::builtin
