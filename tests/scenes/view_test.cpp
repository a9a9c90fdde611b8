#include "scenes/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"

namespace umbrameter {
namespace {

dmat4 some_pose() {
  return glm::rotate(glm::rotate(glm::translate(dmat4(1.0), dvec3(3, -2, 7)), 0.7, dvec3(0, 1, 0)), 0.3,
                     dvec3(1, 0, 0));
}

View perspective_view(double far_plane) {
  Camera camera;
  camera.world_from_camera = some_pose();
  camera.projection = PerspectiveProjection{1.0, 0.5, far_plane};
  return {64, 48, camera};
}

View orthographic_view() {
  Camera camera;
  camera.world_from_camera = some_pose();
  camera.projection = OrthographicProjection{3.0, 2.0, 1.0, 9.0};
  return {64, 48, camera};
}

Scene scene_of_size(const dvec3& extent, const dvec3& center) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].double_sided = true;
  scene.objects.resize(1);
  Mesh mesh;
  mesh.positions = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, {0.5f, -0.5f, 0.5f}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  scene.instances.push_back({0, 0, glm::scale(glm::translate(dmat4(1.0), center), extent)});
  return scene;
}

double clip_depth(const View& view, double distance) {
  const dvec4 clip = clip_from_view(view) * dvec4(0, 0, -distance, 1);
  return clip.z / clip.w;
}

std::string error_of(const Scene& scene, const std::string& wanted) {
  try {
    std::vector<std::string> notes;
    select_camera(scene, wanted, 1.0, notes);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "";
}

TEST(Clip, Depth_is_one_at_the_near_plane_and_zero_at_the_far_plane) {
  EXPECT_NEAR(clip_depth(perspective_view(20.0), 0.5), 1.0, 1e-15);
  EXPECT_NEAR(clip_depth(perspective_view(20.0), 20.0), 0.0, 1e-15);
  EXPECT_NEAR(clip_depth(orthographic_view(), 1.0), 1.0, 1e-15);
  EXPECT_NEAR(clip_depth(orthographic_view(), 9.0), 0.0, 1e-15);
  EXPECT_NEAR(clip_depth(orthographic_view(), 5.0), 0.5, 1e-15);
}

TEST(Clip, An_infinite_far_plane_gives_near_over_distance) {
  const View view = perspective_view(std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(clip_depth(view, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(clip_depth(view, 5.0), 0.1);
  EXPECT_DOUBLE_EQ(clip_depth(view, 5e9), 1e-10);
}

TEST(Clip, The_vertical_opening_reaches_the_upper_edge) {
  const dvec4 clip = clip_from_view(perspective_view(20.0)) * dvec4(0, std::tan(0.5) * 4.0, -4.0, 1);
  EXPECT_NEAR(clip.y / clip.w, 1.0, 1e-14);
}

TEST(Clip, Pixels_are_square_whatever_the_camera_says) {
  for (const View& view : {perspective_view(20.0), orthographic_view()}) {
    const dmat4 clip = clip_from_view(view);
    EXPECT_NEAR(clip[0][0] * 64.0, clip[1][1] * 48.0, 1e-12);
  }
}

TEST(ViewFromWorld, It_undoes_the_camera_pose) {
  const dmat4 unity = view_from_world(perspective_view(20.0)) * some_pose();
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(unity[i / 4][i % 4], i % 5 == 0 ? 1.0 : 0.0, 1e-14);
}

TEST(PixelRay, It_projects_back_onto_the_pixel_centre_at_the_near_plane) {
  for (const View& view : {perspective_view(20.0), orthographic_view()}) {
    for (const auto& [x, y] : {std::pair{0, 0}, std::pair{63, 47}, std::pair{10, 30}}) {
      const Ray ray = pixel_ray(view, x, y);
      EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-15);
      for (const double along : {0.0, 3.0}) {
        dvec4 clip = clip_from_view(view) * view_from_world(view) * dvec4(ray.origin + along * ray.direction, 1);
        clip /= clip.w;
        EXPECT_NEAR((clip.x + 1) * 32.0, x + 0.5, 1e-10);
        EXPECT_NEAR((1 - clip.y) * 24.0, y + 0.5, 1e-10) << "row 0 is the top row";
        if (along == 0.0) {
          EXPECT_NEAR(clip.z, 1.0, 1e-13);
        }
      }
    }
  }
}

TEST(ToViewer, It_points_to_the_eye_or_against_an_orthographic_axis) {
  const dvec3 eye(some_pose()[3]);
  EXPECT_NEAR(glm::distance(to_viewer(perspective_view(20.0), eye + dvec3(0, -2, 0)), dvec3(0, 1, 0)), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(to_viewer(orthographic_view(), dvec3(100, 100, 100)), dvec3(some_pose()[2])), 0.0, 1e-14);
}

TEST(SelectCamera, The_first_is_taken_and_names_win_over_indices) {
  Scene scene;
  scene.cameras.resize(3);
  scene.cameras[0].name = "front";
  scene.cameras[1].name = "0";
  scene.cameras[2].name = "side";
  std::vector<std::string> notes;
  EXPECT_EQ(select_camera(scene, "", 1.0, notes).name, "front");
  EXPECT_EQ(select_camera(scene, "side", 1.0, notes).name, "side");
  EXPECT_EQ(select_camera(scene, "2", 1.0, notes).name, "side");
  EXPECT_EQ(select_camera(scene, "0", 1.0, notes).name, "0");
  EXPECT_TRUE(notes.empty());
}

TEST(SelectCamera, An_unknown_one_is_refused_with_the_list) {
  Scene scene;
  scene.cameras.resize(2);
  scene.cameras[0].name = "front";
  for (const char* wanted : {"back", "2", "-1", "1x", "99999999999999999999"}) {
    const std::string text = error_of(scene, wanted);
    EXPECT_NE(text.find(wanted), std::string::npos) << text;
    EXPECT_NE(text.find("0 'front', 1"), std::string::npos) << text;
  }
  EXPECT_NE(error_of(Scene{}, "x").find("omit --camera"), std::string::npos);
}

TEST(SelectCamera, An_ambiguous_name_is_refused_with_the_indices) {
  Scene scene;
  scene.cameras.resize(3);
  scene.cameras[0].name = scene.cameras[2].name = "cam";
  EXPECT_NE(error_of(scene, "cam").find("0 'cam', 2 'cam'"), std::string::npos);
}

TEST(FittedCamera, The_whole_of_the_bounds_stands_in_the_image_and_fills_it) {
  for (const double aspect : {0.4, 1.0, 16.0 / 9.0}) {
    for (const dvec3& extent : {dvec3(1, 1, 1), dvec3(100, 1, 2), dvec3(0.01, 8, 0.01), dvec3(50, 0, 50)}) {
      const Scene scene = scene_of_size(extent, {1000, -20, 30});
      std::vector<std::string> notes;
      const Camera camera = select_camera(scene, "", aspect, notes);
      ASSERT_EQ(notes.size(), 1u);
      const View view{static_cast<int>(900 * aspect), 900, camera};
      const Bounds bounds = bounds_of(scene);
      double reach = 0.0;
      for (int i = 0; i < 8; ++i) {
        const dvec4 clip = clip_from_view(view) * view_from_world(view) * dvec4(bounds.corner(i), 1);
        ASSERT_GT(clip.w, 0.0);
        reach = std::max({reach, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
        EXPECT_LE(clip.z / clip.w, 1.0) << "behind the near plane";
      }
      EXPECT_LE(reach, 0.95);
      EXPECT_GE(reach, 0.85);
    }
  }
}

TEST(FittedCamera, What_is_seen_stands_in_the_middle_of_the_image) {
  for (const dvec3& extent : {dvec3(1, 1, 1), dvec3(100, 1, 2), dvec3(0.01, 8, 0.01), dvec3(50, 0, 50)}) {
    const Scene scene = scene_of_size(extent, {1000, -20, 30});
    std::vector<std::string> notes;
    const View view{1600, 900, select_camera(scene, "", 16.0 / 9.0, notes)};
    dvec2 most(-1.0);
    dvec2 least(1.0);
    for (int i = 0; i < 8; ++i) {
      const dvec4 clip = clip_from_view(view) * view_from_world(view) * dvec4(bounds_of(scene).corner(i), 1);
      most = glm::max(most, dvec2(clip) / clip.w);
      least = glm::min(least, dvec2(clip) / clip.w);
    }
    EXPECT_NEAR(most.x, -least.x, 1e-6);
    EXPECT_NEAR(most.y, -least.y, 1e-6);
  }
}

TEST(FittedCamera, It_looks_from_thirty_degrees_beside_the_front_and_twenty_five_above) {
  std::vector<std::string> notes;
  Scene scene = scene_of_size({2, 2, 2}, {0, 0, 0});
  // Its normal, (1, 0, 1), is towards the usual camera and towards the sun of a scene without lights.
  scene.meshes[0].positions = {{-0.5f, -0.5f, 0.5f}, {0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, -0.5f}};
  const Camera camera = select_camera(scene, "", 1.5, notes);
  const dvec3 back(camera.world_from_camera[2]);
  // sin 25° = 0.422618, tan 30° = 0.577350.
  EXPECT_NEAR(back.y, 0.422618, 1e-6);
  EXPECT_NEAR(back.x / back.z, 0.577350, 1e-6);
  EXPECT_GT(back.z, 0.0);
}

TEST(FittedCamera, A_point_and_an_empty_scene_still_get_a_finite_camera) {
  for (const Scene& scene : {Scene{}, scene_of_size({0, 0, 0}, {5, 5, 5})}) {
    std::vector<std::string> notes;
    const Camera camera = select_camera(scene, "", 1.0, notes);
    EXPECT_TRUE(std::isfinite(camera.world_from_camera[3].x));
    EXPECT_GT(std::get<PerspectiveProjection>(camera.projection).near_plane, 0.0);
  }
}

TEST(Sun, A_scene_without_lights_gets_one_and_a_note) {
  Scene scene;
  std::vector<std::string> notes;
  add_missing_light(scene, notes);
  ASSERT_EQ(scene.lights.size(), 1u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(scene.lights[0].name, "sun");
  EXPECT_TRUE(std::holds_alternative<DirectionalLight>(scene.lights[0].shape));
  const dvec3 towards = glm::normalize(dvec3(0.45, 1.0, 0.35));
  EXPECT_NEAR(glm::distance(-scene.lights[0].axis(), towards), 0.0, 1e-14);
  add_missing_light(scene, notes);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(SelectLights, Names_indices_and_all) {
  Scene scene;
  scene.lights.resize(3);
  scene.lights[1].name = "lamp";
  using Indices = std::vector<std::uint32_t>;
  EXPECT_EQ(select_lights(scene, ""), (Indices{0, 1, 2}));
  EXPECT_EQ(select_lights(scene, "lamp"), Indices{1});
  EXPECT_EQ(select_lights(scene, "2"), Indices{2});
  EXPECT_THROW(select_lights(scene, "3"), Error);
  EXPECT_THROW(select_lights(scene, "torch"), Error);
}

TEST(SelectLights, The_case_of_a_name_matters_only_where_two_names_differ_by_it) {
  Scene scene;
  scene.lights.resize(4);
  scene.lights[0].name = "Sun";
  scene.lights[1].name = "Lamp";
  scene.lights[2].name = "LAMP";
  scene.lights[3].name = "Straße";
  using Indices = std::vector<std::uint32_t>;
  EXPECT_EQ(select_lights(scene, "sun"), Indices{0});
  EXPECT_EQ(select_lights(scene, "SUN"), Indices{0});
  EXPECT_EQ(select_lights(scene, "LAMP"), Indices{2}) << "the exact name wins";
  EXPECT_EQ(select_lights(scene, "STRAße"), Indices{3});
  try {
    select_lights(scene, "lamp");
    ADD_FAILURE() << "an ambiguous name was accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "--light lamp: 2 lights of the scene have this name; choose one by its index: 1 'Lamp', 2 'LAMP'");
  }
}

TEST(SelectCamera, The_case_of_a_name_does_not_matter) {
  Scene scene;
  scene.cameras.resize(2);
  scene.cameras[1].name = "Main";
  std::vector<std::string> notes;
  EXPECT_EQ(select_camera(scene, "main", 1.0, notes).name, "Main");
}

TEST(LayerNames, They_are_letters_digits_and_underscores_and_all_different) {
  std::vector<Light> lights(6);
  lights[1].name = "key light.001";
  lights[2].name = "lamp";
  lights[3].name = "lamp";
  lights[4].name = "lamp_3";
  lights[5].name = "0";
  const std::vector<std::string> names = layer_names(lights);
  EXPECT_EQ(names, (std::vector<std::string>{"0", "key_light_001", "lamp", "lamp_3", "lamp_3_4", "0_5"}));
}

TEST(LayerNames, A_long_name_is_cut_to_what_fits_into_a_file_name_and_stays_unique) {
  std::vector<Light> lights(3);
  for (Light& light : lights) light.name = std::string(300, 'x');
  lights[2].name.back() = 'y';
  const std::vector<std::string> names = layer_names(lights);
  const std::string cut(64, 'x');
  EXPECT_EQ(names, (std::vector<std::string>{cut, cut + "_1", cut + "_2"}));
}

TEST(ViewParams, Each_field_is_described) {
  ViewParams params;
  const Parameters parameters = describe(params);
  EXPECT_EQ(parameters.size(), static_cast<std::size_t>(count_fields<ViewParams>()));
  find(parameters, "view.surfels")->set_text("traced");
  EXPECT_EQ(params.surfels, SurfelSource::traced);
  EXPECT_THROW(find(parameters, "view.size")->set_text("0x100"), Error);
  EXPECT_THROW(find(parameters, "view.size")->set_text("100x100000"), Error);
}

}  // namespace
}  // namespace umbrameter
