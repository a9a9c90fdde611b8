#include <gtest/gtest.h>

#include "raytrace/tracer.h"
#include "scenes/view.h"
#include "tests/support/reference_caster.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

// From (0, 0, 5) along −Z.
View front_view(int width, int height) {
  View view{width, height, {}};
  view.camera.world_from_camera[3] = dvec4(0, 0, 5, 1);
  return view;
}

TEST(Primary, Surfels_are_where_the_pixel_centres_meet_the_quad) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}));
  const Tracer tracer(scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, front_view(8, 4));
  // The half height of the image plane at 5 m is 5·tan 0.4 = 2.1139661; pixel (0, 0) is 3/4 of it up, 7/4 of it left.
  EXPECT_NEAR(gbuffer.position.at(0, 0).y, 0.75 * 2.1139661, 1e-5);
  EXPECT_NEAR(gbuffer.position.at(0, 0).x, -1.75 * 2.1139661, 1e-5);
  EXPECT_EQ(gbuffer.position.at(0, 0).z, 0.0f);
  EXPECT_NEAR(gbuffer.depth.at(3, 2), 5.0f, 1e-6f);
  EXPECT_EQ(gbuffer.geometric_normal.at(3, 2), vec3(0, 0, 1));
  EXPECT_EQ(gbuffer.albedo.at(3, 2), vec3(0.5f));
}

TEST(Primary, Normals_turn_to_the_viewer_on_either_side_of_a_double_sided_quad) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-10, -10, 0}, {0, 20, 0}, {20, 0, 0}));  // looks along −Z, away
  const GBuffer gbuffer = trace_gbuffer(Tracer(scene), front_view(3, 3));
  EXPECT_EQ(gbuffer.geometric_normal.at(1, 1), vec3(0, 0, 1));
  EXPECT_EQ(gbuffer.shading_normal.at(1, 1), vec3(0, 0, 1));
}

TEST(Primary, Back_faces_of_single_sided_materials_are_not_seen_mirrored_or_not) {
  for (const double mirror : {1.0, -1.0}) {
    Scene scene = shapes::empty_scene();
    scene.materials[0].double_sided = false;
    dmat4 transform(1.0);
    transform[0][0] = mirror;
    // Looks along −Z, away from the viewer; mirroring x keeps the side that is its front.
    shapes::add_mesh(scene, shapes::quad({-10, -10, 0}, {0, 20, 0}, {20, 0, 0}), transform);
    shapes::add_mesh(scene, shapes::quad({-10, -10, -1}, {20, 0, 0}, {0, 20, 0}), transform);
    const GBuffer gbuffer = trace_gbuffer(Tracer(scene), front_view(3, 3));
    EXPECT_EQ(gbuffer.instance.at(1, 1), 1u) << "mirror " << mirror;
  }
}

TEST(Primary, Hits_equal_the_second_implementation_where_instances_are_stretched_turned_and_mirrored) {
  Scene scene = shapes::empty_scene();
  const std::uint32_t first = shapes::add_mesh(scene, shapes::sphere(vec3(0), 1.0f, 12, 16));
  for (int i = 0; i < 6; ++i) {
    dmat4 transform(1.0);
    const double angle = 0.7 * i;
    transform[0] = dvec4(std::cos(angle), std::sin(angle), 0, 0) * (i % 2 == 0 ? 0.5 : -0.8);
    transform[1] = dvec4(-std::sin(angle), std::cos(angle), 0, 0) * 0.3;
    transform[2] = dvec4(0.1 * i, 0, 1, 0);
    transform[3] = dvec4(i - 2.5, 0.4 * (i % 3) - 0.4, 0.2 * i, 1);
    scene.instances.push_back({scene.instances[first].mesh, 0, transform});
  }
  const View view = front_view(96, 64);
  const Tracer tracer(scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const ReferenceCaster caster(scene);
  int surfaces = 0;
  int others = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Ray ray = pixel_ray(view, x, y);
      const auto hit = caster.nearest(ray.origin, ray.direction, 0.0, 1e9, true);
      surfaces += hit ? 1 : 0;
      const std::size_t i = gbuffer.instance.index(x, y);
      ASSERT_TRUE(!hit || gbuffer.is_surface(i) || others < 2) << x << ", " << y;
      if (hit && gbuffer.is_surface(i)) {
        const dvec3 position = ray.origin + hit->t * ray.direction;
        const bool same = hit->instance == gbuffer.instance[i] && hit->triangle == gbuffer.triangle[i];
        others += same ? 0 : 1;
        if (!same) continue;
        EXPECT_LT(glm::length(position - dvec3(gbuffer.position[i])), 2e-6);
      }
    }
  }
  EXPECT_GT(surfaces, 500);
  EXPECT_LE(others, surfaces / 200) << "only centres that lie on an edge to rounding may fall on either side";
}

TEST(Primary, Every_thread_count_gives_the_same_bits) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::sphere(vec3(0), 1.5f, 32, 48));
  const Tracer tracer(scene);
  const View view = front_view(101, 67);
  const ThreadLimit one(1);
  const GBuffer first = trace_gbuffer(tracer, view);
  const ThreadLimit seven(7);
  EXPECT_EQ(first, trace_gbuffer(tracer, view));
}

}  // namespace
}  // namespace umbrameter
