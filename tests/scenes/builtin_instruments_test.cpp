// What the built-in scenes that each fail in one known way promise: the dimensions in the names of their objects.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "scenes/builtin.h"
#include "techniques/shadow/map_layout.h"
#include "tests/support/reference_caster.h"

namespace umbrameter {
namespace {

constexpr double far_away = 1e3;

const Light& lamp_named(const Scene& scene, const std::string& name) {
  for (const Light& light : scene.lights) {
    if (light.name == name) return light;
  }
  throw std::runtime_error("no light " + name);
}

const std::string& name_of(const Scene& scene, const Instance& instance) { return scene.objects[instance.object].name; }

Bounds bounds_of_object(const Scene& scene, const std::string& name) {
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    if (name_of(scene, instance) != name) continue;
    for (const vec3& position : scene.meshes[instance.mesh].positions) {
      bounds.include(dvec3(instance.world_from_mesh * dvec4(dvec3(position), 1.0)));
    }
  }
  return bounds;
}

std::string nearest_object(const Scene& scene, const ReferenceCaster& caster, const dvec3& from, const dvec3& towards) {
  const auto hit = caster.nearest(from, glm::normalize(towards), 1e-9, far_away, false);
  return hit ? name_of(scene, scene.instances[hit->instance]) : std::string("nothing");
}

// Of the directions above a floor, by their cosine, those in which nothing lies: Malley's method on an even grid.
double open_share(const ReferenceCaster& caster, const dvec3& point, int side) {
  int open = 0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double r = std::sqrt((i + 0.5) / side);
      const double angle = 2.0 * pi * (j + 0.5) / side;
      const dvec3 direction{r * std::cos(angle), std::sqrt(1.0 - r * r), r * std::sin(angle)};
      if (!caster.nearest(point, direction, 1e-9, far_away, false)) ++open;
    }
  }
  return static_cast<double>(open) / (side * side);
}

struct Slot {
  int width = 0, depth = 0;  // centimetres
  double x = 0.0;
};

std::vector<Slot> slots_of(const Scene& scene) {
  std::vector<Slot> slots;
  for (const Object& object : scene.objects) {
    Slot slot;
    if (std::sscanf(object.name.c_str(), "floor %d cm wide %d cm deep", &slot.width, &slot.depth) != 2) continue;
    slot.x = bounds_of_object(scene, object.name).center().x;
    slots.push_back(slot);
  }
  return slots;
}

TEST(Trench, Has_slots_of_the_widths_and_depths_in_their_names) {
  const Scene scene = load_scene("trench");
  const ReferenceCaster caster(scene);
  std::set<std::pair<int, int>> kinds;
  for (const Slot& slot : slots_of(scene)) {
    kinds.insert({slot.width, slot.depth / slot.width});
    const auto down = caster.nearest(dvec3(slot.x, 0.1, 0.3), dvec3(0, -1, 0), 0.0, far_away, false);
    ASSERT_TRUE(down);
    EXPECT_NEAR(down->t - 0.1, 0.01 * slot.depth, 1e-7) << slot.width;
    for (const double side : {-1.0, 1.0}) {
      const auto wall =
          caster.nearest(dvec3(slot.x, -0.004 * slot.depth, 0.3), dvec3(side, 0, 0), 0.0, far_away, false);
      ASSERT_TRUE(wall);
      EXPECT_NEAR(wall->t, 0.005 * slot.width, 1e-7) << slot.width;
    }
  }
  std::set<std::pair<int, int>> expected;
  for (const int width : {2, 5, 10, 20}) {
    for (const int ratio : {1, 2, 4}) expected.insert({width, ratio});
  }
  EXPECT_EQ(kinds, expected);
}

// Two infinite walls of height h, each d = w/2 away: AO = 1 − 2·½(1 − d/√(d² + h²)) = d/√(d² + h²); TRUTH of a wall,
// cosine weight, no limit. The ends of a slot, 15 widths away, take or give less than 0.004.
TEST(Trench, Has_the_ambient_occlusion_of_an_infinite_trench_in_the_middle_of_each_slot) {
  const Scene scene = load_scene("trench");
  const ReferenceCaster caster(scene);
  for (const Slot& slot : slots_of(scene)) {
    const double ratio = static_cast<double>(slot.depth) / slot.width;
    const double expected = ratio == 1.0 ? 0.447214 : ratio == 2.0 ? 0.242536 : 0.124035;
    EXPECT_NEAR(open_share(caster, dvec3(slot.x, -0.01 * slot.depth + 1e-7, 0.0), 160), expected, 0.006)
        << slot.width << " cm wide, " << slot.depth << " cm deep";
  }
}

// The sun falls 1.6 on 1 across the slots: of a floor as deep as wide 1 − 1/1.6 is lit, of a deeper one nothing.
TEST(Trench, Has_three_eighths_of_the_shallow_floors_in_the_sun_and_nothing_of_the_others) {
  const Scene scene = load_scene("trench");
  const ReferenceCaster caster(scene);
  const dvec3 to_sun = -lamp_named(scene, "sun").axis();
  for (const Slot& slot : slots_of(scene)) {
    int lit = 0;
    for (int i = 0; i < 800; ++i) {
      const double x = slot.x + 0.01 * slot.width * ((i + 0.5) / 800 - 0.5);
      if (!caster.nearest(dvec3(x, -0.01 * slot.depth + 1e-7, -1.0), to_sun, 1e-6, far_away, false)) ++lit;
    }
    EXPECT_NEAR(lit, slot.depth == slot.width ? 300 : 0, 1) << slot.width << ", " << slot.depth;
  }
}

TEST(Spheres, Have_every_vertex_at_the_radius_in_their_name_and_touch_the_ground) {
  const Scene scene = load_scene("spheres");
  std::set<int> radii, facets;
  for (const Instance& instance : scene.instances) {
    const std::string& name = name_of(scene, instance);
    const Mesh& mesh = scene.meshes[instance.mesh];
    int number = 0;
    double radius = 0.2;
    if (name.ends_with(" mm") && std::sscanf(name.c_str(), "ball %d mm", &number) == 1) {
      radii.insert(number);
      radius = 0.001 * number;
    } else if (name.ends_with(" facets") && std::sscanf(name.c_str(), "ball %d facets", &number) == 1) {
      facets.insert(number);
      EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(number));
    } else {
      continue;
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      ASSERT_NEAR(glm::length(dvec3(mesh.positions[i])), radius, 2e-7 * radius) << name;
      ASSERT_GT(glm::dot(glm::normalize(mesh.positions[i]), mesh.normals[i]), 0.999f) << name;  // smooth
    }
    EXPECT_NEAR(bounds_of_object(scene, name).min.y, 0.0, 2e-7 * radius) << name;
  }
  EXPECT_EQ(radii, (std::set<int>{2, 4, 8, 16, 32, 64, 128, 256, 512, 1024}));
  EXPECT_EQ(facets, (std::set<int>{80, 320, 1280, 5120}));
}

TEST(Spheres, Do_not_reach_into_one_another) {
  const Scene scene = load_scene("spheres");
  std::vector<std::pair<dvec3, double>> balls;
  for (const Instance& instance : scene.instances) {
    if (!name_of(scene, instance).starts_with("ball ")) continue;
    const Bounds bounds = bounds_of_object(scene, name_of(scene, instance));
    balls.emplace_back(dvec3(instance.world_from_mesh[3]), 0.5 * bounds.extent().y);
  }
  ASSERT_EQ(balls.size(), 14u);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(glm::length(balls[i].first - balls[j].first), balls[i].second + balls[j].second) << i << ", " << j;
    }
  }
}

TEST(Ramp, Has_slopes_of_the_angles_in_their_names_under_a_sun_at_the_zenith) {
  const Scene scene = load_scene("ramp");
  EXPECT_EQ(scene.lights.front().name, "zenith");
  EXPECT_NEAR(scene.lights.front().axis().y, -1.0, 1e-15);
  std::set<int> found;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    int angle = 0;
    if (std::sscanf(name_of(scene, scene.instances[i]).c_str(), "slope %d", &angle) != 1) continue;
    found.insert(angle);
    double area = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle corners = world_triangle(scene, i, t);
      const dvec3 normal = glm::cross(corners.b - corners.a, corners.c - corners.a);
      if (normal.y <= 1e-6) continue;  // all else stands or lies beneath
      area += 0.5 * glm::length(normal);
      EXPECT_NEAR(std::atan2(normal.z, normal.y) * 180.0 / pi, angle, 2e-5) << angle;
      EXPECT_NEAR(normal.x / normal.y, 0.0, 1e-6) << angle;
    }
    EXPECT_NEAR(area, 1.5 * 0.52, 1e-6) << angle;
  }
  std::set<int> expected;
  for (int angle = 0; angle <= 85; angle += 5) expected.insert(angle);
  EXPECT_EQ(found, expected);
}

TEST(Ramp, Has_nothing_but_pegs_above_its_slopes) {
  const Scene scene = load_scene("ramp");
  const ReferenceCaster caster(scene);
  for (int angle = 0; angle <= 85; angle += 5) {
    const Bounds bounds = bounds_of_object(scene, "slope " + std::to_string(angle));
    for (int i = 1; i < 40; ++i) {
      const dvec3 point(bounds.center().x, 5.0, bounds.min.z + i * 0.025 * bounds.extent().z);
      const std::string first = nearest_object(scene, caster, point, dvec3(0, -1, 0));
      EXPECT_TRUE(first == "slope " + std::to_string(angle) || first == "peg " + std::to_string(angle)) << first;
    }
  }
}

TEST(LongPosts, Have_the_thickness_and_the_distance_in_their_names_and_stand_in_the_ground) {
  const Scene scene = load_scene("long-posts");
  std::set<std::pair<int, int>> found;
  for (const Instance& instance : scene.instances) {
    int thickness = 0, distance = 0;
    if (std::sscanf(name_of(scene, instance).c_str(), "post %d mm at %d m", &thickness, &distance) != 2) continue;
    found.insert({thickness, distance});
    Bounds bounds;
    for (const vec3& local : scene.meshes[instance.mesh].positions) {
      const dvec3 p(instance.world_from_mesh * dvec4(dvec3(local), 1.0));
      bounds.include(p);
      const double from_axis = std::hypot(p.x - instance.world_from_mesh[3].x, p.z + distance);
      EXPECT_TRUE(from_axis < 1e-9 || std::abs(from_axis - 0.0005 * thickness) < 1e-8) << from_axis;
    }
    EXPECT_LT(bounds.min.y, 0.0);
    EXPECT_EQ(bounds.max.y, 4.0);
  }
  std::set<std::pair<int, int>> expected;
  for (const int thickness : {20, 50, 100, 200}) {
    for (int i = 0; i < 32; ++i) expected.insert({thickness, 5 * i});
  }
  EXPECT_EQ(found, expected);
}

// One map over the whole road: a texel is wider than the posts of 2, 5 and 10 cm, at the viewer's feet as far away.
TEST(LongPosts, Are_thinner_than_the_texels_of_a_single_map) {
  const Scene scene = load_scene("long-posts");
  const MapLayout frame = fit_light(lamp_named(scene, "sun"), bounds_of(scene), 1024);
  EXPECT_GT(texel_at(frame, dvec3(0, 0, 5)), 0.1);
  EXPECT_LT(texel_at(frame, dvec3(0, 0, 5)), 0.25);
  EXPECT_EQ(texel_at(frame, dvec3(0, 0, 5)), texel_at(frame, dvec3(0, 0, -155)));
}

TEST(TwoOccluders, Have_the_edge_of_the_roofs_shadow_across_the_middle_of_each_plates_shadow) {
  const Scene scene = load_scene("two-occluders");
  const ReferenceCaster caster(scene);
  const dvec3 to_sun = -lamp_named(scene, "sun").axis();
  for (const int gap : {10, 20, 40, 80, 160}) {
    const std::string plate = "plate " + std::to_string(gap) + " cm";
    const Bounds bounds = bounds_of_object(scene, plate);
    EXPECT_NEAR(bounds.min.y, 0.01 * gap, 1e-7) << plate;
    // Down along the light from the middle of the underside to the floor, off the stem.
    const dvec3 under(bounds.center().x + 0.15, bounds.min.y, bounds.center().z);
    const dvec3 middle = under - to_sun * (under.y / to_sun.y);
    const dvec3 step(0, 0, 0.01);
    EXPECT_NEAR(middle.y, 0.0, 1e-12);
    // The sun sees the roof first on one side of the line and the plate on the other; both are in the plate's shadow.
    const dvec3 up = far_away * 0.5 * to_sun;
    EXPECT_EQ(nearest_object(scene, caster, middle - step + up, -to_sun), "roof") << plate;
    EXPECT_EQ(nearest_object(scene, caster, middle + step + up, -to_sun), plate);
    EXPECT_EQ(nearest_object(scene, caster, middle - step + 1e-6 * to_sun, to_sun), plate);
  }
  EXPECT_GE(bounds_of_object(scene, "roof").min.y, 2.0 * 1.6);
}

// Chebyshev's bound of a floor point whose filter sees half roof, a metres away, and half plate, b metres away: the
// mean lies (a + b)/2 before the floor, the variance is ((a − b)/2)², so that the bound is (a − b)²/(2(a² + b²)). Along
// this light a = 3.2·√(1 + 0.65² + 0.35²) and b = (gap + 0.04)·√(1 + 0.65² + 0.35²).
TEST(TwoOccluders, Bleed_by_the_less_the_higher_the_plate) {
  const Scene scene = load_scene("two-occluders");
  const ReferenceCaster caster(scene);
  const dvec3 to_sun = -lamp_named(scene, "sun").axis();
  for (const auto& [gap, expected] : {std::pair{10, 0.4563}, {20, 0.4254}, {40, 0.3651}, {80, 0.2544}, {160, 0.0941}}) {
    const Bounds bounds = bounds_of_object(scene, "plate " + std::to_string(gap) + " cm");
    const dvec3 under(bounds.center().x + 0.15, bounds.min.y, bounds.center().z);
    const dvec3 middle = under - to_sun * (under.y / to_sun.y);
    const auto distance = [&](double z) {
      const auto hit = caster.nearest(middle + dvec3(0, 0, z) + 100.0 * to_sun, -to_sun, 0.0, far_away, false);
      return 100.0 - hit.value().t;
    };
    const double a = distance(-1e-4);
    const double b = distance(1e-4);
    EXPECT_NEAR((a - b) * (a - b) / (2.0 * (a * a + b * b)), expected, 2e-4) << gap;
  }
}

class RoomRays : public testing::Test {
 protected:
  Scene scene = load_scene("room");
  ReferenceCaster caster{scene};
};

// Directions spread evenly over the sphere.
std::vector<dvec3> directions(int count) {
  std::vector<dvec3> made;
  for (int i = 0; i < count; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / count;
    const double angle = pi * (3.0 - std::sqrt(5.0)) * i;
    made.emplace_back(std::sqrt(1.0 - y * y) * std::cos(angle), y, std::sqrt(1.0 - y * y) * std::sin(angle));
  }
  return made;
}

TEST_F(RoomRays, Leave_by_the_window_only) {
  int left = 0;
  for (const dvec3& from : {dvec3(0.3, 2.6, 3.9), dvec3(2.0, 1.4, 3.3), dvec3(4.95, 1.62, 3.95), dvec3(2.6, 1.2, 1.0),
                            dvec3(1.2, 0.3, 2.2)}) {
    for (const dvec3& direction : directions(20000)) {
      if (caster.nearest(from, direction, 1e-9, far_away, false)) continue;
      ++left;
      // Where they pass the wall's outer face, x = −0.3: within the opening of 1.5 m by 1.8 m.
      ASSERT_LT(direction.x, 0.0);
      const dvec3 out = from - direction * ((from.x + 0.3) / direction.x);
      EXPECT_TRUE(out.y > 0.85 && out.y < 2.35 && out.z > 1.1 && out.z < 2.9) << out.y << ", " << out.z;
    }
  }
  EXPECT_GT(left, 500);
}

TEST_F(RoomRays, Find_walls_30_cm_thick_all_round) {
  const dvec3 middle(4.9, 2.5, 3.7);
  for (const dvec3& direction : {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(0, 0, -1)}) {
    double t = 0.0;
    std::vector<double> passed;
    while (const auto hit = caster.nearest(middle, direction, t, far_away, false)) {
      t = hit->t + 1e-9;
      if (name_of(scene, scene.instances[hit->instance]) == "shell") passed.push_back(hit->t);
    }
    ASSERT_EQ(passed.size(), 2u);
    EXPECT_NEAR(passed[1] - passed[0], 0.3, 1e-6);
  }
}

TEST_F(RoomRays, Find_a_patch_of_sun_on_the_floor) {
  const dvec3 to_sun = -lamp_named(scene, "sun").axis();
  int lit = 0;
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 40; ++j) {
      const dvec3 point(0.1 * i + 0.15, 0.0125, 0.1 * j + 0.15);
      if (!caster.nearest(point, to_sun, 1e-9, far_away, false)) ++lit;
    }
  }
  // The opening alone would let 1.5 m · 1.8 m · to_sun.x/to_sun.y = 3.1 m² through; its frame and the table take most.
  EXPECT_GT(0.01 * lit, 0.5);
  EXPECT_LT(0.01 * lit, 3.1);
}

TEST_F(RoomRays, Leave_both_lamps_in_most_directions) {
  for (const char* name : {"lamp", "reading-lamp"}) {
    const dvec3 lamp = lamp_named(scene, name).position();
    int open = 0;
    for (const dvec3& direction : directions(4000)) {
      if (caster.nearest(lamp, direction, 0.0, 0.3, false)) continue;
      ++open;
    }
    // The bracket stands 14 cm from a wall, which alone takes ½(1 − 0.14/0.3) = 27 % of them; a saucer takes 10 %.
    EXPECT_GT(open, 2400) << name;
  }
}

}  // namespace
}  // namespace umbrameter
