#include "raytrace/casters.h"

#include <gtest/gtest.h>

#include <cmath>

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
  EXPECT_GE(casters.rays, blocked);
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
