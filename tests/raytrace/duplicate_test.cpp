// Surfaces that lie in the same place twice: neither copy may shadow the other.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/random.h"
#include "raytrace/tracer.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

enum class Copy { none, instance, mesh, other_side, within_the_mesh, decal };
constexpr Copy copies[] = {Copy::none,       Copy::instance,        Copy::mesh,
                           Copy::other_side, Copy::within_the_mesh, Copy::decal};

// A plane of 2 × 2 units in quads of irregular sides, front up.
Mesh plane() {
  Mesh mesh;
  const float steps[] = {-1.0f, -0.37f, 0.11f, 0.52f, 1.0f};
  for (const float x : steps) {
    for (const float z : steps) mesh.positions.emplace_back(x, 0.0f, z);
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (std::uint32_t j = 0; j < 4; ++j) {
      const std::uint32_t a = 5 * i + j;
      mesh.triangles.emplace_back(a, a + 1, a + 6);
      mesh.triangles.emplace_back(a, a + 6, a + 5);
    }
  }
  return mesh;
}

// In the same plane, of other triangles: a fan about a point that is no vertex of the plane.
Mesh decal() {
  Mesh mesh;
  mesh.positions.emplace_back(0.0731f, 0.0f, -0.0417f);
  constexpr std::uint32_t corners = 7;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * pi * i / corners + 0.2;
    mesh.positions.push_back(vec3(dvec3(0.83 * std::cos(angle), 0.0, 0.71 * std::sin(angle))));
    mesh.triangles.emplace_back(0u, 1 + i, 1 + (i + 1) % corners);
  }
  return mesh;
}

void turn_over(Mesh& mesh) {
  for (uvec3& t : mesh.triangles) std::swap(t.y, t.z);
}

Scene make_scene(Copy copy, const dmat4& place) {
  Scene scene = shapes::empty_scene();
  Mesh mesh = plane();
  if (copy == Copy::within_the_mesh) {
    const std::vector<uvec3> triangles = mesh.triangles;
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
    for (const uvec3& t : triangles) mesh.triangles.emplace_back(t.y, t.x, t.z);  // and turned over
  }
  shapes::add_mesh(scene, mesh, place);
  if (copy == Copy::instance) scene.instances.push_back(scene.instances[0]);
  if (copy == Copy::mesh) shapes::add_mesh(scene, mesh, place);
  if (copy == Copy::other_side) {
    turn_over(mesh);
    shapes::add_mesh(scene, mesh, place);
  }
  if (copy == Copy::decal) {
    shapes::add_mesh(scene, decal(), place);
    Mesh lower = decal();
    turn_over(lower);
    shapes::add_mesh(scene, lower, place);
  }
  return scene;
}

// Points on every triangle of every instance, edges and corners among them, as a rasteriser rounds them.
GBuffer surfels(const Scene& scene, const dvec3& up) {
  struct Point {
    std::uint32_t instance;
    std::uint32_t triangle;
    dvec3 position;
  };
  std::vector<Point> points;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle corners = world_triangle(scene, i, t);
      for (std::uint32_t k = 0; k < 8; ++k) {
        double u = static_cast<double>(to_unit_float(hash(i, t, k, 0u)));
        double v = static_cast<double>(to_unit_float(hash(i, t, k, 1u)));
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        if (k == 6) v = 0.0;
        if (k == 7) u = v = 0.0;
        points.push_back({i, t, corners.a + u * (corners.b - corners.a) + v * (corners.c - corners.a)});
      }
    }
  }
  GBuffer gbuffer(static_cast<int>(points.size()), 1);
  for (std::size_t p = 0; p < points.size(); ++p) {
    gbuffer.instance[p] = points[p].instance;
    gbuffer.triangle[p] = points[p].triangle;
    gbuffer.position[p] = vec3(points[p].position);
    gbuffer.geometric_normal[p] = gbuffer.shading_normal[p] = vec3(up);
  }
  return gbuffer;
}

struct Place {
  const char* name;
  double scale;
  dvec3 at;
};

// Scaled, turned so that no coordinate is exact, and moved.
dmat4 matrix_of(const Place& place) {
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  dmat4 matrix(1.0);
  matrix[0] = place.scale * dvec4(c, s, 0, 0);
  matrix[1] = place.scale * dvec4(-s * c, c * c, s, 0);
  matrix[2] = place.scale * dvec4(s * s, -s * c, c, 0);
  matrix[3] = dvec4(place.at, 1);
  return matrix;
}

// Directions of 0.5, 20 and 85 degrees over the plane, at three azimuths each.
std::vector<dvec3> directions(const dmat3& axes) {
  std::vector<dvec3> all;
  for (const double elevation : {0.5, 20.0, 85.0}) {
    for (int k = 0; k < 3; ++k) {
      const double e = elevation * pi / 180.0;
      const double a = 0.4 + 2.0 * pi * k / 3.0;
      all.push_back(glm::normalize(axes * dvec3(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a))));
    }
  }
  return all;
}

void expect_lit(const Tracer& tracer, const GBuffer& gbuffer, const Light& light, const std::string& what) {
  const TracedVisibility traced = trace_visibility(tracer, gbuffer, light, {{.spp = 8}, 1});
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    ASSERT_EQ(traced.visibility[i], 1.0f)
        << what << ", instance " << gbuffer.instance[i] << ", triangle " << gbuffer.triangle[i] << ", surfel " << i;
  }
}

TEST(Duplicates, A_lone_plane_that_is_there_twice_is_open_and_lit_as_if_it_were_there_once) {
  const Place places[] = {{"at the origin", 1.0, {0, 0, 0}},
                          {"a kilometre off", 1.0, {1000.3, 100.1, -700.7}},
                          {"of millimetres", 0.001, {0, 0, 0}},
                          {"of millimetres, some metres off", 0.001, {3.1, 1.7, -2.3}},
                          {"of a hundred metres", 100.0, {12.3, -4.5, 6.7}}};
  for (const Place& place : places) {
    const dmat4 matrix = matrix_of(place);
    const dmat3 axes = dmat3(matrix) / place.scale;
    const dvec3 up = glm::normalize(glm::cross(axes[2], axes[0]));
    for (const Copy copy : copies) {
      const Scene scene = make_scene(copy, matrix);
      const Tracer tracer(scene);
      for (const dvec3& normal : {up, -up}) {
        const GBuffer gbuffer = surfels(scene, normal);
        const std::string what = std::string(place.name) + ", copy " + std::to_string(static_cast<int>(copy));
        for (const TruthParams& params :
             {TruthParams{.spp = 64}, TruthParams{.ao_weight = AoWeight::uniform, .tolerance = 0.1},
              TruthParams{.spp = 64, .ao_layers = AoLayers::all}}) {
          const TracedAo traced = trace_ao(tracer, gbuffer, params, 3);
          for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
            ASSERT_EQ(traced.ao[i], 1.0f) << what << ", instance " << gbuffer.instance[i] << ", triangle "
                                          << gbuffer.triangle[i] << ", surfel " << i;
          }
        }
        for (const dvec3& direction : directions({axes[0], normal, axes[2]})) {
          Light light = shapes::directional(direction);
          expect_lit(tracer, gbuffer, light, what + ", sun");
          light.emitter = DistantEmitter{0.5 * pi / 180.0};
          expect_lit(tracer, gbuffer, light, what + ", soft sun");
          light.emitter = {};
          // So far off that it is above the plane's horizon everywhere by a good part of the elevation.
          light.world_from_light[3] = dvec4(place.at + 500.0 * place.scale * direction, 1);
          light.shape = PointLight{};
          expect_lit(tracer, gbuffer, light, what + ", point light");
          light.shape = SpotLight{};
          expect_lit(tracer, gbuffer, light, what + ", spot light");
          light.emitter = SphereEmitter{0.5 * place.scale};
          expect_lit(tracer, gbuffer, light, what + ", sphere");
          light.emitter = DiskEmitter{0.5 * place.scale};
          expect_lit(tracer, gbuffer, light, what + ", disk");
          light.emitter = RectangleEmitter{place.scale, 0.5 * place.scale};
          expect_lit(tracer, gbuffer, light, what + ", rectangle");
        }
      }
    }
  }
}

TEST(Duplicates, Two_copies_still_cast_one_shadow_and_close_the_sky) {
  for (const Copy copy : copies) {
    Scene scene = make_scene(copy, dmat4(1.0));
    const std::uint32_t floor = shapes::add_mesh(scene, shapes::quad({-8, -0.001f, 8}, {16, 0, 0}, {0, 0, -16}));
    const GBuffer gbuffer =
        shapes::surfels({{0.2f, -0.001f, 0.1f}}, {0, 1, 0}, floor, [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
    const Tracer tracer(scene);
    EXPECT_EQ(trace_visibility(tracer, gbuffer, shapes::directional({0.1, 1, 0.2})).visibility[0], 0.0f);
    TruthParams params;
    params.ao_distance = 0.05;
    // c = h/D = 1/50: O_cos = 1 − c².
    const TracedAo traced = trace_ao(tracer, gbuffer, params, 1);
    EXPECT_NEAR(traced.ao[0], 0.0004, 0.012 + 0.0004) << "three of 256 rays at most";
  }
}

}  // namespace
}  // namespace umbrameter
