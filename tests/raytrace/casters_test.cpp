#include "raytrace/casters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/surfel.h"
#include "scenes/builtin.h"
#include "scenes/light.h"
#include "scenes/view.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

// A box of one metre on level ground, seen from above, the sun at 45° beyond it.
struct BoxFromAbove {
  Scene scene = shapes::empty_scene();
  View view{64, 64, {}};
  Light light;
  BoxFromAbove() {
    shapes::add_mesh(scene, shapes::quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}));
    shapes::add_mesh(scene, shapes::box({-1, 0, -1}, {0, 1, 1}));
    view.camera.world_from_camera = dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(0, 10, 0, 1));
    view.camera.projection = OrthographicProjection{2.0, 2.0, 0.0, 100.0};
    const dvec3 z = glm::normalize(dvec3(-1, 1, 0));
    const dvec3 x(0, 0, 1);
    light.world_from_light = dmat4(dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(0, 0, 0, 1));
  }
};

TEST(Casters, Are_there_exactly_where_the_truth_is_blocked) {
  const BoxFromAbove box;
  const Tracer tracer(box.scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, box.view);
  const Image<float> truth = trace_visibility(tracer, gbuffer, box.light).visibility;
  const TracedCasters casters = trace_casters(tracer, gbuffer, box.light);
  std::size_t blocked = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(casters.instance[i] != no_id, truth[i] == 0.0f) << i;
    if (truth[i] == 0.0f) ++blocked;
  }
  EXPECT_GT(blocked, 100u);
  // Floor and lid fill the image, and both are turned to the sun.
  EXPECT_EQ(casters.rays, 64u * 64u);
}

// Two ways to the same answer: here triangles are described one by one and rays go to their nearest hits; the truth
// describes all triangles of a strip together, and on some processors tells Embree that its rays are alike.
TEST(Casters, Are_there_exactly_where_the_truth_is_blocked_in_rich_scenes) {
  std::size_t most_triangles = 0;
  for (const char* name : {"courtyard", "foliage", "city:100k"}) {
    const Scene scene = load_scene(name);
    const Tracer tracer(scene);
    std::vector<std::string> notes;
    const GBuffer gbuffer = trace_gbuffer(tracer, {320, 180, select_camera(scene, "", 16.0 / 9.0, notes)});
    for (const Light& light : scene.lights) {
      const Image<float> truth = trace_visibility(tracer, gbuffer, light).visibility;
      const TracedCasters casters = trace_casters(tracer, gbuffer, light);
      std::size_t different = 0;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        if (!gbuffer.is_surface(i) || !faces(light, dvec3(gbuffer.position[i]), dvec3(gbuffer.geometric_normal[i]))) {
          continue;
        }
        different += (casters.instance[i] != no_id) == (truth[i] == 0.0f) ? 0u : 1u;
      }
      EXPECT_EQ(different, 0u) << name << ", " << light.name;
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> triangles;
    for (int y = 64; y < 128; ++y) {
      for (int x = 64; x < 128; ++x) triangles.emplace(gbuffer.instance.at(x, y), gbuffer.triangle.at(x, y));
    }
    most_triangles = std::max(most_triangles, triangles.size());
  }
  EXPECT_GT(most_triangles, TriangleCache::capacity);  // or no tile has more triangles than the cache holds
}

TEST(Casters, What_is_turned_away_takes_no_ray_and_has_no_caster) {
  BoxFromAbove box;
  box.light.world_from_light = shapes::directional({-1, -1, 0}).world_from_light;
  const Tracer tracer(box.scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, box.view);
  const TracedCasters casters = trace_casters(tracer, gbuffer, box.light);
  EXPECT_EQ(casters.rays, 0u);
  EXPECT_EQ(casters.instance, Image<std::uint32_t>(64, 64, no_id));
}

// Rays start a step of a fortieth of a millimetre above a floor of 16 m.
constexpr double step = 5e-5;

// A mesh of several instances is hit as an instance, with an id of another kind than that of a mesh of one.
TEST(Casters, Of_shared_meshes_each_instance_is_told) {
  Scene scene = shapes::empty_scene();
  const std::uint32_t floor = shapes::add_mesh(scene, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
  const std::uint32_t pane = shapes::add_mesh(scene, shapes::quad({-0.2f, 1, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f}));
  std::vector<vec3> points = {{0, 0, 0.1f}};
  for (int i = 1; i < 12; ++i) {
    dmat4 place(1.0);
    place[1][1] = 1.0 + 0.25 * i;  // its height, too
    place[3] = dvec4(0.5 * i, 0, 0, 1);
    scene.instances.push_back({scene.instances[pane].mesh, scene.instances[pane].object, place});
    points.emplace_back(0.5f * static_cast<float>(i), 0.0f, 0.1f);
  }
  const GBuffer gbuffer = shapes::surfels(points, {0, 1, 0}, floor, [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
  const TracedCasters casters = trace_casters(Tracer(scene), gbuffer, shapes::directional({0, 1, 0}));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(casters.instance[i], pane + i);
    EXPECT_NEAR(casters.distance[i], 1.0 + 0.25 * static_cast<double>(i), step) << i;
  }
}

// Of a light with extent the way is that to its middle, and what is beyond the light casts nothing.
TEST(Casters, The_way_to_a_light_in_the_scene_ends_at_its_middle) {
  Scene scene = shapes::empty_scene();
  const std::uint32_t floor = shapes::add_mesh(scene, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
  const std::uint32_t lid = shapes::add_mesh(scene, shapes::quad({-8, 3, 8}, {8, 0, 0}, {0, 0, -16}));
  const GBuffer gbuffer =
      shapes::surfels({{-2, 0, 0}, {2, 0, 0}}, {0, 1, 0}, floor, [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
  const Tracer tracer(scene);
  Light light;
  light.shape = PointLight{};
  for (const Emitter& emitter : {Emitter(), Emitter(SphereEmitter{1.5}), Emitter(DiskEmitter{1.5})}) {
    light.emitter = emitter;
    light.world_from_light[3] = dvec4(0, 2.5, 0, 1);
    const TracedCasters below = trace_casters(tracer, gbuffer, light);
    EXPECT_EQ(below.rays, 2u);
    EXPECT_EQ(below.instance[0], no_id) << "the lid is beyond the light";
    EXPECT_EQ(below.instance[1], no_id);
    light.world_from_light[3] = dvec4(0, 4, 0, 1);
    const TracedCasters above = trace_casters(tracer, gbuffer, light);
    EXPECT_EQ(above.instance[0], lid);
    // Three quarters of the way of 2 by 4 m.
    EXPECT_NEAR(above.distance[0], 0.75 * std::sqrt(20.0), step);
    EXPECT_EQ(above.instance[1], no_id);
    EXPECT_EQ(above.distance[1], 0.0f);
  }
}

// Behind the face x = 0, at 45°, the way to it is x·√2.
TEST(Casters, The_distance_is_that_to_the_nearest_surface) {
  const BoxFromAbove box;
  const Tracer tracer(box.scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, box.view);
  const TracedCasters casters = trace_casters(tracer, gbuffer, box.light);
  for (const int column : {32, 36, 40, 46}) {
    const std::size_t i = gbuffer.instance.index(column, 32);
    const float x = gbuffer.position[i].x;
    ASSERT_GT(x, 0.0f);
    EXPECT_EQ(casters.instance[i], 1u);
    EXPECT_NEAR(casters.distance[i], x * std::sqrt(2.0f), 1e-5f);
  }
  EXPECT_EQ(casters.instance.at(60, 32), no_id);
  EXPECT_EQ(casters.distance.at(60, 32), 0.0f);
}

}  // namespace
}  // namespace umbrameter
