// Grounds of kilometres: rays leave them as near to the surface as they leave a floor of a few metres.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "raytrace/casters.h"
#include "raytrace/huge_triangles.h"
#include "raytrace/tracer.h"
#include "tests/support/reference_caster.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

constexpr float half_sizes[] = {5.0f, 100.0f, 500.0f, 2000.0f};

// How the plane y = 0 is turned, and where that is done.
enum class Turn { none, by_the_node, in_the_file };
constexpr Turn turns[] = {Turn::none, Turn::by_the_node, Turn::in_the_file};

dmat4 matrix_of(Turn turn) {
  if (turn == Turn::none) return dmat4(1.0);
  const double c = std::cos(0.35);
  const double s = std::sin(0.35);
  return {dvec4(c, s, 0, 0), dvec4(-s * c, c * c, s, 0), dvec4(s * s, -s * c, c, 0), dvec4(0, 0, 0, 1)};
}

std::uint32_t add(Scene& scene, Mesh mesh, Turn turn) {
  if (turn != Turn::in_the_file) return shapes::add_mesh(scene, mesh, matrix_of(turn));
  for (vec3& p : mesh.positions) p = vec3(matrix_of(turn) * dvec4(dvec3(p), 1.0));
  return shapes::add_mesh(scene, mesh);
}

// A square ground and surfels on it, given in its own plane. Its diagonal runs from (−, +) to (+, −).
Mesh ground(float half) { return shapes::quad({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}); }
std::uint32_t triangle_at(vec3 p) { return p.x > -p.z ? 0u : 1u; }

GBuffer surfels_on(const std::vector<vec3>& points, std::uint32_t instance, Turn turn) {
  GBuffer gbuffer = shapes::surfels(points, vec3(dvec3(matrix_of(turn)[1])), instance, triangle_at);
  for (std::size_t i = 0; i < points.size(); ++i) {
    gbuffer.triangle[i] = triangle_at(points[i]);
    gbuffer.position[i] = vec3(matrix_of(turn) * dvec4(dvec3(points[i]), 1.0));
  }
  return gbuffer;
}

std::vector<vec3> around(vec3 middle) {
  std::vector<vec3> points;
  for (int i = 0; i < 16; ++i) {
    const auto step = static_cast<float>(i);
    points.push_back(middle + vec3(0.1f * step - 0.77f, 0, 0.07f * step - 0.33f));
  }
  return points;
}

TEST(HugeTriangles, A_ceiling_over_a_ground_of_any_size_closes_as_much_of_the_sky) {
  // O_cos = 1 − (h/D)²: AO 4/9 for h = 2, D = 3. An offset δ changes it by 2/3 · 2/3 · 5/9 δ, less than 2·10⁻⁵ up to
  // δ = 0.08 mm.
  for (const float half : half_sizes) {
    Scene scene = shapes::empty_scene();
    shapes::add_mesh(scene, ground(half));
    shapes::add_mesh(scene, shapes::quad({-7, 2, -7}, {14, 0, 0}, {0, 0, 14}));
    const TracedAo traced =
        trace_ao(Tracer(scene), surfels_on(around({0, 0, 0}), 0, Turn::none), {1 << 18, AoWeight::cosine, 3.0}, 1);
    double sum = 0.0;
    double variance = 0.0;
    for (const float ao : traced.ao.pixels) sum += ao;
    for (const float v : traced.variance.pixels) variance += v;
    const double error = std::sqrt(variance) / 16.0;
    EXPECT_LT(error, 8e-6);
    EXPECT_NEAR(sum / 16.0, 4.0 / 9.0, 2e-5 + 4.0 * error) << "half size " << half;
    EXPECT_LT(traced.statistics.largest_offset, 8e-5) << "half size " << half;
    EXPECT_GT(traced.statistics.largest_offset, 0.0);
  }
}

TEST(HugeTriangles, The_offset_follows_the_place_on_the_ground_and_not_its_size) {
  // Turned by its node the plane is exact in the file; a float's rounding at 2 m is 10⁻⁷ m, at 1.9 km 10⁻⁴ m.
  for (const bool is_shared : {false, true}) {
    Scene scene = shapes::empty_scene();
    const std::uint32_t id = add(scene, ground(2000.0f), Turn::by_the_node);
    if (is_shared) {
      scene.instances.push_back(scene.instances[id]);
      scene.instances.back().world_from_mesh[3] = dvec4(0, -5000, 0, 1);
    }
    const Tracer tracer(scene);
    const auto offset_at = [&](vec3 middle) {
      const GBuffer gbuffer = surfels_on(around(middle), id, Turn::by_the_node);
      return trace_ao(tracer, gbuffer, {16}, 1).statistics.largest_offset;
    };
    EXPECT_LT(offset_at({0, 0, 0}), 1e-5);
    EXPECT_GT(offset_at({1900, 0, 0}), 1e-4);
    EXPECT_LT(offset_at({1900, 0, 0}), 1e-2);
  }
}

// The plane once, twice, as two instances of one mesh, and under patches of ordinary size around each place.
enum class CopyOf { none, mesh, instance, patches };

TEST(HugeTriangles, An_open_plane_is_open_and_lit_whatever_its_size_and_tilt) {
  for (const float half : half_sizes) {
    const float far = 0.9f * half;
    const vec3 middles[] = {{0, 0, 0}, {0.4f * half, 0, -0.4f * half}, {far, 0, 0.3f * half}};
    for (const Turn turn : turns) {
      for (const CopyOf copy : {CopyOf::none, CopyOf::mesh, CopyOf::instance, CopyOf::patches}) {
        Scene scene = shapes::empty_scene();
        add(scene, ground(half), turn);
        if (copy == CopyOf::mesh) add(scene, ground(half), turn);
        if (copy == CopyOf::instance) scene.instances.push_back(scene.instances[0]);
        for (const vec3& middle : middles) {
          if (copy != CopyOf::patches) break;
          add(scene, shapes::quad(middle + vec3(-1.3f, 0, 1.1f), {2.9f, 0, 0.2f}, {0.1f, 0, -2.7f}), turn);
          add(scene, shapes::quad(middle + vec3(-13, 0, 14), {31, 0, 1}, {2, 0, -29}), turn);
        }
        const Tracer tracer(scene);
        const std::string what = "half size " + std::to_string(half) + ", turn " +
                                 std::to_string(static_cast<int>(turn)) + ", copy " +
                                 std::to_string(static_cast<int>(copy));
        for (const vec3& middle : middles) {
          const GBuffer gbuffer = surfels_on(around(middle), 0, turn);
          for (const TruthParams& params :
               {TruthParams{.spp = 256}, TruthParams{.spp = 64, .ao_layers = AoLayers::all}}) {
            for (const float ao : trace_ao(tracer, gbuffer, params, 1).ao.pixels) ASSERT_EQ(ao, 1.0f) << what;
          }
          for (int k = 0; k < 6; ++k) {  // one degree over the plane
            const dvec3 local(std::cos(1.1 * k), std::tan(pi / 180.0), std::sin(1.1 * k));
            const Light light = shapes::directional(dmat3(matrix_of(turn)) * local);
            for (const float lit : trace_visibility(tracer, gbuffer, light).visibility.pixels) {
              ASSERT_EQ(lit, 1.0f) << what << ", sun " << k;
            }
          }
        }
      }
    }
  }
}

View view_from(const dvec3& eye, const dvec3& at, int width, int height) {
  const dvec3 z = glm::normalize(eye - at);
  const dvec3 x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
  View view{width, height, {}};
  view.camera.world_from_camera = dmat4(dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(eye, 1));
  return view;
}

TEST(HugeTriangles, The_foot_of_a_wall_is_dark_where_exact_geometry_is) {
  // A wall without thickness beside the ground's diagonal, x + z = 0: origins keep off that edge by four offsets, and
  // must not come out on the other side of the wall, one centimetre away.
  constexpr double wall = 0.015;  // x + z
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, ground(2000.0f));
  shapes::add_mesh(scene, shapes::quad({-3 + static_cast<float>(wall), 0, 3}, {6, 0, -6}, {0, 3, 0}));
  const Light light = shapes::directional({1, 0.6, 0.7});
  const View view = view_from({-0.25, 0.2, -0.3}, {0, 0, 0}, 320, 180);
  const Tracer tracer(scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const TracedVisibility traced = trace_visibility(tracer, gbuffer, light);
  const ReferenceCaster exact(scene);
  int foot = 0;
  int different = 0;
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    if (!gbuffer.is_surface(i) || gbuffer.instance[i] != 0) continue;
    dvec3 point(gbuffer.position[i]);
    point.y = 0.0;
    const bool is_blocked = exact.is_blocked(point, 0, gbuffer.triangle[i], light, 0.0);
    foot += is_blocked && gbuffer.triangle[i] == 0 && point.x + point.z < wall ? 1 : 0;
    different += is_blocked == (traced.visibility[i] == 0.0f) ? 0 : 1;
  }
  EXPECT_GT(foot, 100);
  EXPECT_EQ(different, 0);
}

// A ground whose triangles come first and last, with small ones of the same mesh between them that rise from it.
Mesh ground_with_tents(float half) {
  Mesh mesh = ground(half);
  const uvec3 last = mesh.triangles.back();
  mesh.triangles.pop_back();
  for (int i = 0; i < 12; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const vec3 at(static_cast<float>(i % 4) * 2 - 3, 0, static_cast<float>(i / 4) * 2 - 2);
    for (const vec3& p : {vec3(0, 0, 0), vec3(1, 0, 0), vec3(0.5f, 1, 0.5f)}) mesh.positions.push_back(at + p);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  mesh.triangles.push_back(last);
  mesh.texcoords.clear();
  return mesh;
}

TEST(HugeTriangles, Hits_report_the_triangles_of_the_file) {
  for (const bool is_shared : {false, true}) {
    Scene scene = shapes::empty_scene();
    shapes::add_mesh(scene, shapes::box({40, 0, 40}, {41, 1, 41}));
    const std::uint32_t id = shapes::add_mesh(scene, ground_with_tents(1500.0f));
    if (is_shared) {
      scene.instances.push_back(scene.instances[id]);
      scene.instances.back().world_from_mesh[3] = dvec4(0, -300, 0, 1);
    }
    const Tracer tracer(scene);
    const View view = view_from({1, 6, 9}, {0, 0, 0}, 160, 90);
    const GBuffer gbuffer = trace_gbuffer(tracer, view);
    const ReferenceCaster exact(scene);
    int seen[14] = {};
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const Ray ray = pixel_ray(view, x, y);
        const auto hit = exact.nearest(ray.origin, ray.direction, 0.0, 1e30, true);
        ASSERT_EQ(gbuffer.instance.at(x, y), hit ? hit->instance : no_id) << x << ", " << y;
        if (!hit) continue;
        ASSERT_EQ(gbuffer.triangle.at(x, y), hit->triangle) << x << ", " << y;
        if (hit->instance == id) ++seen[hit->triangle];
      }
    }
    for (const int count : seen) EXPECT_GT(count, 0);
    // Seen from below, it is the ground that blocks a tent's light.
    const TracedCasters casters = trace_casters(tracer, gbuffer, shapes::directional({0.1, -1, 0.2}));
    for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
      if (casters.instance[i] != no_id) {
        EXPECT_EQ(casters.instance[i], id);
      }
    }
  }
}

TEST(HugeTriangles, Back_faces_of_single_sided_grounds_are_not_seen_and_masked_points_are_open) {
  Scene scene = shapes::empty_scene();
  scene.materials[0].double_sided = false;
  shapes::add_mesh(scene, ground(2000.0f));
  EXPECT_EQ(trace_gbuffer(Tracer(scene), view_from({0, -2, 1}, {0, 0, 0}, 3, 3)).instance.at(1, 1), no_id);
  EXPECT_EQ(trace_gbuffer(Tracer(scene), view_from({0, 2, 1}, {0, 0, 0}, 3, 3)).instance.at(1, 1), 0u);

  // Bilinear alpha falls from 1 at u = 1/4 to 0 at u = 3/4 and repeats, 4000 times on 4 km: of each metre the first
  // half blocks.
  Texture texture;
  texture.texels = Image<glm::u8vec4>(2, 1, glm::u8vec4(255, 255, 255, 255));
  texture.texels.at(1, 0).w = 0;
  scene.textures.push_back(texture);
  Material leaf;
  leaf.base_color_texture = 0;
  leaf.alpha_mode = AlphaMode::mask;
  scene.materials.push_back(leaf);
  Mesh roof = shapes::quad({-2000, 3, 2000}, {4000, 0, 0}, {0, 0, -4000});
  for (vec2& texcoord : roof.texcoords) texcoord *= 4000.0f;
  roof.material = 1;
  shapes::add_mesh(scene, roof);
  const std::vector<vec3> points = {{0.25f, 0, 0.1f}, {0.75f, 0, 0.1f}, {-6.75f, 0, 3.3f}, {-6.25f, 0, 3.3f}};
  const TracedVisibility traced =
      trace_visibility(Tracer(scene), surfels_on(points, 0, Turn::none), shapes::directional({0, 1, 0}));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(traced.visibility[i], i % 2 == 0 ? 0.0f : 1.0f) << i;
}

TEST(HugeTriangles, Rays_do_not_slip_between_them_nor_between_them_and_others) {
  // A tunnel of 400 m whose ends are of ordinary size: the origins are a centimetre from its edges.
  Scene scene = shapes::empty_scene();
  const dmat4 place = matrix_of(Turn::by_the_node);
  shapes::add_mesh(scene, shapes::box({-4, 0, -200}, {4, 5, 200}), place);
  std::vector<vec3> points;
  for (int i = 0; i < 16; ++i) points.emplace_back(-3.99f + 0.532f * static_cast<float>(i), 0.0f, 199.99f);
  const Tracer tracer(scene);
  GBuffer gbuffer = surfels_on(points, 0, Turn::by_the_node);
  const Mesh& box = scene.meshes[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::uint32_t t = 0; t < box.triangles.size(); ++t) {
      const auto corner = [&](int c) { return box.positions[box.triangles[t][c]]; };
      if (corner(0).y > 0 || corner(1).y > 0 || corner(2).y > 0) continue;
      const auto side = [&](vec3 a, vec3 b) { return glm::cross(b - a, points[i] - a).y > 0; };
      const bool s = side(corner(0), corner(1));
      if (s == side(corner(1), corner(2)) && s == side(corner(2), corner(0))) gbuffer.triangle[i] = t;
    }
  }
  for (const float ao : trace_ao(tracer, gbuffer, {1 << 16}, 1).ao.pixels) EXPECT_EQ(ao, 0.0f);
}

Mesh terrain(int cells, float cell) {
  Mesh mesh;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      mesh.positions.emplace_back(cell * static_cast<float>(i), 0.1f * cell * static_cast<float>((i * j) % 3),
                                  cell * static_cast<float>(j));
    }
  }
  const auto n = static_cast<std::uint32_t>(cells);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      mesh.triangles.emplace_back(a, a + 1, a + n + 2);
      mesh.triangles.emplace_back(a, a + n + 2, a + n + 1);
    }
  }
  return mesh;
}

StoredMesh stored(const Mesh& mesh) {
  return {&mesh, dmat4(1.0), 1.0, longest_edge(mesh, dmat4(1.0), std::numeric_limits<double>::infinity())};
}

TEST(HugeTriangles, A_terrain_of_large_triangles_is_ordinary_and_only_what_is_larger_is_huge) {
  const Mesh hills = terrain(100, 100.0f);  // 20,000 triangles of 141 m and more, less than 200
  const Mesh plane = ground(2000.0f);
  const Mesh house = shapes::box({0, 0, 0}, {10, 10, 10});
  EXPECT_EQ(huge_edge({stored(house)}), min_huge_edge);
  EXPECT_EQ(huge_edge({stored(house), stored(plane)}), min_huge_edge);
  const double limit = huge_edge({stored(hills), stored(plane), stored(house)});
  EXPECT_EQ(limit, 4.0 * min_huge_edge);
  EXPECT_TRUE(huge_triangles(stored(hills), limit).empty());
  EXPECT_EQ(huge_triangles(stored(plane), limit).size(), 2u);
  EXPECT_EQ(longest_edge(plane, dmat4(1.0), limit), 0.0);
  // Memory is that of a small terrain, with and without the ground.
  const auto bytes = [](float cell, bool has_ground) {
    Scene scene = shapes::empty_scene();
    shapes::add_mesh(scene, terrain(100, cell));
    if (has_ground) shapes::add_mesh(scene, ground(20.0f * cell));
    return static_cast<double>(Tracer(scene).build_statistics().bytes);
  };
  EXPECT_LT(bytes(100.0f, true), 1.1 * bytes(0.1f, true) + 1e5);
  EXPECT_LT(bytes(60.0f, false), 1.1 * bytes(0.06f, false) + 1e5);
}

}  // namespace
}  // namespace umbrameter
