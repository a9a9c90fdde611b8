#include "raytrace/tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "core/error.h"
#include "core/interrupt.h"
#include "scenes/builtin.h"
#include "scenes/view.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

View view_of(const Scene& scene) {
  std::vector<std::string> notes;
  return {160, 90, select_camera(scene, {}, 160.0 / 90.0, notes)};
}

TEST(Tracer, Building_tells_how_far_it_is) {
  const Scene scene = load_scene("city:100k");
  double last = 0.0;
  int calls = 0;
  bool falls = false;
  const Tracer tracer(scene, [&](double share) {
    falls = falls || share < last;
    last = share;
    ++calls;
  });
  EXPECT_FALSE(falls);
  EXPECT_GT(calls, 3);
  EXPECT_DOUBLE_EQ(last, 1.0);
}

// Ends the process with the exit code of the error that building stops with.
void interrupt_while_building(const Scene& scene) {
  install_interrupt_handlers();
  try {
    const Tracer tracer(scene, [](double share) {
      if (share > 0.05 && share < 0.5 && !is_interrupted()) std::raise(SIGINT);
    });
  } catch (const Error& error) {
    std::_Exit(static_cast<int>(error.code()));
  }
  std::_Exit(0);
}

TEST(Tracer, An_interrupt_ends_building) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const Scene scene = load_scene("city:100k");
  EXPECT_EXIT(interrupt_while_building(scene), testing::ExitedWithCode(130), "");
}

TEST(Tracer, Vertices_with_and_without_room_behind_them_give_the_same_hits) {
  Scene roomy = load_scene("city:30k");
  Scene tight = roomy;
  for (Mesh& mesh : roomy.meshes) mesh.positions.reserve(mesh.positions.size() + 1);
  for (Mesh& mesh : tight.meshes) mesh.positions.shrink_to_fit();
  ASSERT_GT(roomy.meshes[0].positions.capacity(), roomy.meshes[0].positions.size());
  const GBuffer a = trace_gbuffer(Tracer(roomy), view_of(roomy));
  const GBuffer b = trace_gbuffer(Tracer(tight), view_of(tight));
  EXPECT_EQ(a.instance.pixels, b.instance.pixels);
  EXPECT_EQ(a.triangle.pixels, b.triangle.pixels);
  EXPECT_EQ(a.position.pixels, b.position.pixels);
}

TEST(Tracer, Empty_meshes_are_no_obstacle) {
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, {});
  shapes::add_mesh(scene, {});
  scene.instances.push_back(scene.instances[0]);
  shapes::add_mesh(scene, shapes::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
  View view{3, 3, {}};
  view.camera.world_from_camera[3] = dvec4(0, 0, 5, 1);
  EXPECT_EQ(trace_gbuffer(Tracer(scene), view).instance.at(1, 1), 3u);
}

TEST(Tracer, A_scene_built_by_one_thread_gives_the_same_hits_as_by_all) {
  const Scene scene = load_scene("forest:200k");
  const View view = view_of(scene);
  const GBuffer many = trace_gbuffer(Tracer(scene), view);
  const ThreadLimit limit(1);
  const GBuffer one = trace_gbuffer(Tracer(scene), view);
  EXPECT_EQ(many.instance.pixels, one.instance.pixels);
  EXPECT_EQ(many.triangle.pixels, one.triangle.pixels);
  EXPECT_EQ(many.position.pixels, one.position.pixels);
}

}  // namespace
}  // namespace umbrameter
