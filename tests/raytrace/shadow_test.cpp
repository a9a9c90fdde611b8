#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "raytrace/tracer.h"
#include "scenes/builtin.h"
#include "scenes/gltf.h"
#include "scenes/light.h"
#include "tests/support/reference_caster.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

// The reference's surface point: the stored position moved onto its own triangle's plane, in double precision.
dvec3 on_plane(const Scene& scene, const GBuffer& gbuffer, std::size_t i) {
  const Triangle t = world_triangle(scene, gbuffer.instance[i], gbuffer.triangle[i]);
  const dvec3 n = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
  const dvec3 p(gbuffer.position[i]);
  return p - glm::dot(p - t.a, n) * n;
}

struct Agreement {
  int compared = 0;
  int different = 0;
  int fine = 0;  ///< that differ on an edge finer than a pixel
  int blocked = 0;
};

// Whether the caster's own answer changes when the point is moved by what the tracer's offset may be: then it lies on
// the edge of a shadow, or of a gap in one, that is narrower than the pixels around it show.
bool is_on_fine_edge(const ReferenceCaster& caster, const GBuffer& gbuffer, std::size_t i, const dvec3& point,
                     const Light& light, double gap, double offset) {
  const dvec3 normal(gbuffer.geometric_normal[i]);
  const dvec3 across = glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
  bool first = false;
  for (int k = 0; k < 16; ++k) {
    const double angle = 2.0 * pi * k / 16.0;
    const dvec3 step = std::cos(angle) * across + std::sin(angle) * glm::cross(normal, across);
    const dvec3 moved = point + 4.0 * offset * step + offset * normal;
    const bool blocked = caster.is_blocked(moved, gbuffer.instance[i], gbuffer.triangle[i], light, gap);
    if (k == 0) first = blocked;
    if (blocked != first) return true;
  }
  return false;
}

// Every pixel that is not within one pixel of a shadow edge. Neighbouring facets that share an edge to float rounding
// may block within micrometres of the start in exact arithmetic; the scene's coordinates bound that distance.
Agreement compare_with_caster(const Scene& scene, const View& view, const Light& light) {
  const Tracer tracer(scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const TracedVisibility traced = trace_visibility(tracer, gbuffer, light);
  const ReferenceCaster caster(scene);
  const double gap = 1e-6 * (1.0 + bounds_of(scene).radius());
  Image<float> expected(view.width, view.height, 1.0f);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    const dvec3 point = on_plane(scene, gbuffer, i);
    const dvec3 normal(gbuffer.geometric_normal[i]);
    const double cosine = glm::dot(normal, to_light(light, dvec3(gbuffer.position[i])));
    expected[i] = cosine > 0.0 && !caster.is_blocked(point, gbuffer.instance[i], gbuffer.triangle[i], light,
                                                     gap / std::max(cosine, 1e-3))
                      ? 1.0f
                      : 0.0f;
  }
  const Image<std::uint8_t> edges = near_edges(expected);
  Agreement agreement;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!gbuffer.is_surface(i) || edges[i] != 0) continue;
    ++agreement.compared;
    agreement.blocked += expected[i] == 0.0f ? 1 : 0;
    if (expected[i] == traced.visibility[i]) continue;
    const dvec3 point = on_plane(scene, gbuffer, i);
    const bool fine = is_on_fine_edge(caster, gbuffer, i, point, light, gap, traced.statistics.largest_offset);
    agreement.different += fine ? 0 : 1;
    agreement.fine += fine ? 1 : 0;
  }
  return agreement;
}

void expect_agreement(const Scene& scene) {
  for (const Camera& camera : scene.cameras) {
    for (const Light& light : scene.lights) {
      const Agreement a = compare_with_caster(scene, {192, 108, camera}, light);
      EXPECT_EQ(a.different, 0) << scene.name << ", camera " << camera.name << ", light " << light.name << ": of "
                                << a.compared;
      // One, where most pixels border on the shadow of some leaf and few are left to compare.
      EXPECT_LE(a.fine, 1 + a.compared / 10000) << scene.name << ", camera " << camera.name << ", light " << light.name;
      EXPECT_GT(a.compared, 192 * 108 / 10) << scene.name << ", camera " << camera.name << ", light " << light.name;
    }
  }
}

class BuiltinShadow : public testing::TestWithParam<std::size_t> {};

TEST_P(BuiltinShadow, Agrees_with_the_second_implementation_in_every_pixel_off_the_edges) {
  const BuiltinScene& tested = builtin_scenes()[GetParam()];
  expect_agreement(tested.counted == "triangles" ? tested.make(tested.fewest) : make(tested));
}

INSTANTIATE_TEST_SUITE_P(Scenes, BuiltinShadow, testing::Range(std::size_t{0}, builtin_scenes().size()));

TEST(Shadow, Agrees_with_the_second_implementation_on_a_real_model) {
  const char* folder = std::getenv("UMBRAMETER_ASSETS");
  if (folder == nullptr) GTEST_SKIP() << "UMBRAMETER_ASSETS names no folder with temple.glb";
  expect_agreement(load_gltf(std::filesystem::path(folder) / "temple.glb"));
}

TEST(Shadow, Agrees_where_instances_are_stretched_turned_and_mirrored) {
  Scene scene = shapes::empty_scene();
  scene.name = "instances";
  shapes::add_mesh(scene, shapes::quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}));
  const std::uint32_t first = shapes::add_mesh(scene, shapes::sphere(vec3(0, 1, 0), 1.0f, 24, 32));
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.7 * i;
    dmat4 transform(1.0);
    transform[0] = dvec4(std::cos(angle), 0.3 * std::sin(angle), std::sin(angle), 0) * (i % 2 == 0 ? 0.6 : -1.4);
    transform[1] = dvec4(0.1 * i, 0.5 + 0.3 * i, 0, 0);
    transform[2] = dvec4(-std::sin(angle), 0, std::cos(angle), 0) * 0.4;
    transform[3] = dvec4(2.0 * i - 8.0, 0.2, 1.5 * (i % 3) - 2.0, 1);
    scene.instances.push_back({scene.instances[first].mesh, 0, transform});
  }
  Camera camera;
  camera.name = "front";
  camera.world_from_camera[3] = dvec4(0, 2.5, 14, 1);
  scene.cameras.push_back(camera);
  scene.lights.push_back(shapes::directional({0.6, 1, 0.5}));
  scene.lights.push_back(shapes::directional({1, 0.05, 0.3}));  // grazing: three degrees
  Light lamp;
  lamp.name = "lamp";
  lamp.shape = PointLight{};
  lamp.world_from_light[3] = dvec4(1, 5, 3, 1);
  scene.lights.push_back(lamp);
  expect_agreement(scene);
}

struct Ground {
  Scene scene = shapes::empty_scene();
  std::uint32_t ground = 0;
  explicit Ground(float half_size = 20.0f, vec3 at = vec3(0)) {
    ground = shapes::add_mesh(
        scene, shapes::quad(at + vec3(-half_size, 0, half_size), {2 * half_size, 0, 0}, {0, 0, -2 * half_size}));
  }
  GBuffer surfels(const std::vector<vec3>& points) const {
    // The quad's diagonal runs from its first corner (−, +) to the third (+, −).
    const vec3 corner = scene.meshes[ground].positions[0];
    return shapes::surfels(points, {0, 1, 0}, ground,
                           [corner](vec3 p) { return p.x - corner.x > -(p.z - corner.z) ? 0u : 1u; });
  }
};

std::vector<vec3> grid(float half_size, int steps) {
  std::vector<vec3> points;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      points.emplace_back(half_size * (2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(steps) - 1.0f), 0.0f,
                          half_size * (2.0f * (static_cast<float>(j) + 0.5f) / static_cast<float>(steps) - 1.0f));
    }
  }
  return points;
}

TEST(Shadow, A_sphere_throws_an_ellipse) {
  // Directional light along unit L, sphere (C, R): an ellipse centred at C − L·C_y/L_y with semi-axes R/|L_y| along
  // L's horizontal part and R across it. R = 1 at (2, 1.5, 0), light towards (1, −2, 0.5): centre (2.75, 0.375),
  // semi-axes 1.145644 and 1.
  Ground g;
  shapes::add_mesh(g.scene, shapes::sphere({2, 1.5f, 0}, 1.0f, 200, 400));
  const Tracer tracer(g.scene);
  const std::vector<vec3> points = grid(6.0f, 400);
  const TracedVisibility traced = trace_visibility(tracer, g.surfels(points), shapes::directional({-1, 2, -0.5}));
  const dvec2 along = glm::normalize(dvec2(1.0, 0.5));
  // Facets lie inside of the sphere by at most R(1 − cos(π/400) cos(π/400)) = 6.2e-5 m; twice that is left out.
  constexpr double margin = 2e-4;
  int inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const dvec2 d = dvec2(points[i].x, points[i].z) - dvec2(2.75, 0.375);
    const double a = glm::dot(d, along) / 1.1456439;
    const double b = (d.y * along.x - d.x * along.y) / 1.0;
    const double r = std::sqrt(a * a + b * b);
    if (r < 1.0 - margin) {
      ++inside;
      ASSERT_EQ(traced.visibility[i], 0.0f) << points[i].x << ", " << points[i].z;
    } else if (r > 1.0 + margin) {
      ASSERT_EQ(traced.visibility[i], 1.0f) << points[i].x << ", " << points[i].z;
    }
  }
  EXPECT_GT(inside, 3500);  // π · 1.1456 · 1 / (12/400)² = 3999
}

TEST(Shadow, A_box_throws_the_hull_of_its_projected_corners) {
  // Box [−3,−1] × [0,2] × [−1,1], light towards (1, −2, 0.5): polygon (−3,−1) (−1,−1) (0,−.5) (0,1.5) (−2,1.5) (−3,1).
  Ground g;
  shapes::add_mesh(g.scene, shapes::box({-3, 0, -1}, {-1, 2, 1}));
  const std::vector<vec3> points = grid(5.0f, 300);
  const TracedVisibility traced =
      trace_visibility(Tracer(g.scene), g.surfels(points), shapes::directional({-1, 2, -0.5}));
  const dvec2 hull[] = {{-3, -1}, {-1, -1}, {0, -0.5}, {0, 1.5}, {-2, 1.5}, {-3, 1}};
  int blocked = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = 1e9;
    for (int k = 0; k < 6; ++k) {
      const dvec2 edge = hull[(k + 1) % 6] - hull[k];
      const dvec2 d = dvec2(points[i].x, points[i].z) - hull[k];
      nearest = std::min(nearest, (edge.x * d.y - edge.y * d.x) / glm::length(edge));
    }
    if (std::abs(nearest) < 1e-4) continue;
    blocked += traced.visibility[i] == 0.0f ? 1 : 0;
    ASSERT_EQ(traced.visibility[i], nearest > 0.0 ? 0.0f : 1.0f) << points[i].x << ", " << points[i].z;
  }
  // Area 7 with the footprint, on a grid of cells of (10/300)² m²: 6300, give or take the cells on the outline of 10 m.
  EXPECT_NEAR(blocked, 6300, 150);
}

TEST(Shadow, A_sheet_of_one_millimetre_casts_its_shadow_also_a_millimetre_above_the_ground_and_far_from_the_origin) {
  // Coordinates of 1000 m are stored in steps of 6e-5 m.
  for (const float distance : {0.0f, 10.0f, 1000.0f}) {
    Ground g(20.0f, vec3(distance, 0, 0));
    shapes::add_mesh(g.scene, shapes::box({distance - 1, 0.001f, -1}, {distance + 1, 0.002f, 1}));
    std::vector<vec3> points = grid(0.99f, 50);
    for (vec3& p : points) p.x += distance;
    const Tracer tracer(g.scene);
    const TracedVisibility under = trace_visibility(tracer, g.surfels(points), shapes::directional({0, 1, 0.01}));
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(under.visibility[i], 0.0f) << distance;
    for (vec3& p : points) p.x += 3.0f;
    const TracedVisibility beside = trace_visibility(tracer, g.surfels(points), shapes::directional({0, 1, 0.01}));
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(beside.visibility[i], 1.0f) << distance;
    EXPECT_LT(under.statistics.largest_offset, 0.001);
    EXPECT_GT(under.statistics.largest_offset, 0.0);
  }
}

TEST(Shadow, Neighbours_in_one_plane_do_not_shadow_one_another_under_grazing_light) {
  // A plane of many triangles, turned and moved so that no coordinate is exact.
  Scene scene = shapes::empty_scene();
  Mesh mesh;
  constexpr int n = 64;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j)
      mesh.positions.emplace_back(0.37f * static_cast<float>(i), 0.0f, 0.29f * static_cast<float>(j));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      mesh.triangles.emplace_back(a, a + 1, a + n + 2);
      mesh.triangles.emplace_back(a, a + n + 2, a + n + 1);
    }
  }
  const double angle = 0.3;
  const dmat4 turn(dvec4(std::cos(angle), std::sin(angle), 0, 0), dvec4(-std::sin(angle), std::cos(angle), 0, 0),
                   dvec4(0, 0, 1, 0), dvec4(100.3, 7.7, -50.1, 1));
  for (const bool shared : {false, true}) {
    Scene placed = scene;
    const std::uint32_t id = shapes::add_mesh(placed, mesh, turn);
    if (shared) {
      dmat4 far_away(1.0);
      far_away[3] = dvec4(0, -500, 0, 1);
      placed.instances.push_back({placed.instances[id].mesh, 0, far_away});
    }
    GBuffer gbuffer(n * n, 1);
    for (std::uint32_t t = 0; t < n * n; ++t) {
      const Triangle corners = world_triangle(placed, id, 2 * t);
      gbuffer.instance[t] = id;
      gbuffer.triangle[t] = 2 * t;
      gbuffer.position[t] = vec3(0.4 * corners.a + 0.35 * corners.b + 0.25 * corners.c);
      gbuffer.geometric_normal[t] = vec3(dvec3(turn[1]));
    }
    // One degree above the plane, every azimuth.
    for (int k = 0; k < 12; ++k) {
      const double azimuth = 2.0 * pi * k / 12.0;
      const dvec3 local(std::cos(azimuth), std::tan(pi / 180.0), std::sin(azimuth));
      const TracedVisibility traced =
          trace_visibility(Tracer(placed), gbuffer, shapes::directional(dmat3(turn) * local));
      for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
        ASSERT_EQ(traced.visibility[i], 1.0f) << "shared " << shared << ", azimuth " << k << ", triangle " << i;
      }
    }
  }
}

TEST(Shadow, Surfels_turned_away_are_blocked_and_background_is_lit) {
  Ground g;
  GBuffer gbuffer = g.surfels({{0, 0, 0}, {1, 0, 0}});
  gbuffer.instance[1] = no_id;
  gbuffer.triangle[1] = no_id;
  const TracedVisibility traced = trace_visibility(Tracer(g.scene), gbuffer, shapes::directional({0, -1, 0}));
  EXPECT_EQ(traced.visibility[0], 0.0f);
  EXPECT_EQ(traced.visibility[1], 1.0f);
  EXPECT_EQ(traced.statistics.rays, 0u);
}

TEST(Shadow, What_stands_behind_a_point_light_does_not_block_it) {
  Ground g;
  shapes::add_mesh(g.scene, shapes::quad({-1, 3, 1}, {2, 0, 0}, {0, 0, -2}));
  Light light;
  light.shape = PointLight{};
  light.world_from_light[3] = dvec4(0, 2, 0, 1);
  const GBuffer gbuffer = g.surfels({{0.1f, 0, 0.2f}});
  EXPECT_EQ(trace_visibility(Tracer(g.scene), gbuffer, light).visibility[0], 1.0f);
  light.world_from_light[3] = dvec4(0, 4, 0, 1);
  EXPECT_EQ(trace_visibility(Tracer(g.scene), gbuffer, light).visibility[0], 0.0f);
}

TEST(Shadow, A_masked_texture_casts_only_where_its_alpha_reaches_the_cutoff) {
  Ground g;
  // Two columns of texels: the left one opaque, the right one clear. The bilinear alpha falls from 1 at u = 1/4 to 0 at
  // u = 3/4 and repeats; it is 1/2 at u = 1/2 and u = 0 ≡ 1: points with u in (0, 1/2) cast.
  Texture texture;
  texture.texels = Image<glm::u8vec4>(2, 1, glm::u8vec4(255, 255, 255, 255));
  texture.texels.at(1, 0).w = 0;
  g.scene.textures.push_back(texture);
  Material leaf;
  leaf.base_color_texture = 0;
  leaf.alpha_mode = AlphaMode::mask;
  g.scene.materials.push_back(leaf);
  Mesh quad = shapes::quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2});
  quad.material = 1;
  shapes::add_mesh(g.scene, quad);
  const std::vector<vec3> points = grid(0.95f, 80);
  const TracedVisibility traced = trace_visibility(Tracer(g.scene), g.surfels(points), shapes::directional({0, 1, 0}));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points[i].x) < 1e-3) continue;
    ASSERT_EQ(traced.visibility[i], points[i].x < 0.0f ? 0.0f : 1.0f) << points[i].x;
  }
}

TEST(Shadow, Every_thread_count_gives_the_same_bits) {
  Ground g;
  shapes::add_mesh(g.scene, shapes::sphere({0, 2, 0}, 1.0f, 40, 60));
  const GBuffer gbuffer = g.surfels(grid(5.0f, 100));
  const Tracer tracer(g.scene);
  std::vector<Image<float>> images;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    images.push_back(trace_visibility(tracer, gbuffer, shapes::directional({1, 1, 1})).visibility);
  }
  EXPECT_EQ(images[0], images[1]);
  EXPECT_EQ(images[0], images[2]);
}

}  // namespace
}  // namespace umbrameter
