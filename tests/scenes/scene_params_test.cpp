#include "scenes/scene_params.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

std::string error_of(const std::string& unit) {
  try {
    metres_per_unit(unit);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage) << unit;
    return error.what();
  }
  return "";
}

TEST(SceneParams, Each_field_is_described) {
  SceneParams params;
  const Parameters parameters = describe(params);
  EXPECT_EQ(parameters.size(), static_cast<std::size_t>(count_fields<SceneParams>()));
  find(parameters, "scene.blend")->set_text("leave-out");
  EXPECT_EQ(params.blend, BlendMode::leave_out);
}

TEST(SceneUnit, Names_and_numbers_are_lengths_in_metres) {
  EXPECT_DOUBLE_EQ(metres_per_unit("mm"), 0.001);
  EXPECT_DOUBLE_EQ(metres_per_unit("cm"), 0.01);
  EXPECT_EQ(metres_per_unit("m"), 1.0);
  EXPECT_EQ(metres_per_unit("km"), 1000.0);
  EXPECT_DOUBLE_EQ(metres_per_unit("inch"), 0.0254);  // exact by the international yard and pound agreement, 1959
  EXPECT_DOUBLE_EQ(metres_per_unit("foot"), 0.3048);  // 12 inches
  EXPECT_EQ(metres_per_unit("in"), metres_per_unit("inch"));
  EXPECT_EQ(metres_per_unit("ft"), metres_per_unit("foot"));
  EXPECT_DOUBLE_EQ(metres_per_unit("2.5e-2"), 0.025);
}

TEST(SceneUnit, What_is_no_length_is_a_usage_error_that_names_the_units) {
  for (const char* unit : {"", "furlong", "0", "-1", "1e-13", "1e13", "nan", "inf", "1cm", "CM ", "1,5"}) {
    const std::string text = error_of(unit);
    EXPECT_NE(text.find("--scene.unit"), std::string::npos) << unit;
    EXPECT_NE(text.find("mm, cm, m, km, inch, foot"), std::string::npos) << unit;
  }
}

// A camera and lights of each kind, all with lengths.
Scene scene_with_lengths() {
  Scene scene;
  scene.materials.resize(1);
  scene.objects.resize(1);
  scene.meshes.push_back({"tri", {{1, 2, 3}, {4, 2, 3}, {1, 7, 3}}, {}, {}, {{0, 1, 2}}, 0});
  dmat4 place(2.0);
  place[3] = {10, 20, 30, 1};
  scene.instances.push_back({0, 0, place});
  dmat4 pose(1.0);
  pose[3] = {100, 200, 300, 1};
  scene.cameras.push_back({"lens", pose, PerspectiveProjection{0.7, 5.0, 4000.0}});
  scene.cameras.push_back({"endless", pose, PerspectiveProjection{0.7, 5.0}});
  scene.cameras.push_back({"parallel", pose, OrthographicProjection{30.0, 20.0, 1.0, 900.0}});
  scene.lights.push_back({"lamp", pose, vec3(1), 50.0, PointLight{600.0}, SphereEmitter{3.0}});
  scene.lights.push_back({"spot", pose, vec3(1), 50.0, SpotLight{700.0, 0.1, 0.2}, DiskEmitter{4.0}});
  scene.lights.push_back({"panel", pose, vec3(1), 50.0, SpotLight{0.0, 0.1, 0.2}, RectangleEmitter{50.0, 60.0}});
  scene.lights.push_back({"sun", pose, vec3(1), 1e5, DirectionalLight{}, DistantEmitter{0.01}});
  return scene;
}

TEST(SceneUnit, Every_length_is_scaled_and_nothing_else) {
  const Scene before = scene_with_lengths();
  Scene scene = before;
  scale(scene, 0.01);
  const dmat4& world = scene.instances[0].world_from_mesh;
  // (1, 2, 3) · 2 + (10, 20, 30) = (12, 24, 36) cm.
  const dvec3 corner(world * dvec4(1, 2, 3, 1));
  EXPECT_NEAR(glm::distance(corner, dvec3(0.12, 0.24, 0.36)), 0.0, 1e-15);
  EXPECT_EQ(world[3][3], 1.0);
  EXPECT_EQ(scene.meshes[0].positions, before.meshes[0].positions);
  for (const Camera& camera : scene.cameras) {
    EXPECT_NEAR(glm::distance(dvec3(camera.world_from_camera[3]), dvec3(1, 2, 3)), 0.0, 1e-15);
    EXPECT_EQ(dmat3(camera.world_from_camera), dmat3(1.0)) << "cameras stay rigid";
  }
  const auto& lens = std::get<PerspectiveProjection>(scene.cameras[0].projection);
  EXPECT_DOUBLE_EQ(lens.near_plane, 0.05);
  EXPECT_DOUBLE_EQ(lens.far_plane, 40.0);
  EXPECT_EQ(lens.vertical_fov, 0.7);
  EXPECT_TRUE(std::isinf(std::get<PerspectiveProjection>(scene.cameras[1].projection).far_plane));
  const auto& parallel = std::get<OrthographicProjection>(scene.cameras[2].projection);
  EXPECT_DOUBLE_EQ(parallel.half_width, 0.3);
  EXPECT_DOUBLE_EQ(parallel.half_height, 0.2);
  EXPECT_DOUBLE_EQ(parallel.near_plane, 0.01);
  EXPECT_DOUBLE_EQ(parallel.far_plane, 9.0);
  EXPECT_DOUBLE_EQ(std::get<PointLight>(scene.lights[0].shape).range, 6.0);
  EXPECT_DOUBLE_EQ(std::get<SphereEmitter>(scene.lights[0].emitter).radius, 0.03);
  EXPECT_DOUBLE_EQ(std::get<SpotLight>(scene.lights[1].shape).range, 7.0);
  EXPECT_EQ(std::get<SpotLight>(scene.lights[1].shape).outer_cone_angle, 0.2);
  EXPECT_DOUBLE_EQ(std::get<DiskEmitter>(scene.lights[1].emitter).radius, 0.04);
  EXPECT_EQ(std::get<SpotLight>(scene.lights[2].shape).range, 0.0) << "0 is unlimited";
  EXPECT_DOUBLE_EQ(std::get<RectangleEmitter>(scene.lights[2].emitter).width, 0.5);
  EXPECT_DOUBLE_EQ(std::get<RectangleEmitter>(scene.lights[2].emitter).height, 0.6);
  EXPECT_EQ(std::get<DistantEmitter>(scene.lights[3].emitter).angular_diameter, 0.01);
  EXPECT_NEAR(glm::distance(scene.lights[0].position(), dvec3(1, 2, 3)), 0.0, 1e-15);
  EXPECT_EQ(scene.lights[0].intensity, 50.0);
}

TEST(SceneUnit, Loading_scales_and_metres_leave_every_bit) {
  const Scene metres = load_scene("contact-box");
  const Scene again = load_scene("contact-box", {}, {"1", BlendMode::opaque});
  const Scene feet = load_scene("contact-box", {}, {"foot", BlendMode::opaque});
  ASSERT_EQ(metres.instances.size(), feet.instances.size());
  for (std::size_t i = 0; i < metres.instances.size(); ++i) {
    EXPECT_EQ(metres.instances[i].world_from_mesh, again.instances[i].world_from_mesh);
  }
  const dvec3 ratio = bounds_of(feet).extent() / bounds_of(metres).extent();
  EXPECT_NEAR(glm::distance(ratio, dvec3(0.3048)), 0.0, 1e-12);
  EXPECT_THROW(load_scene("contact-box", {}, {"furlong", BlendMode::opaque}), Error);
}

}  // namespace
}  // namespace umbrameter
