#include "scenes/fitted_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/light.h"
#include "scenes/view.h"
#include "scenes/view_content.h"

namespace umbrameter {
namespace {

constexpr double aspect = 16.0 / 9.0;

Scene empty_scene() {
  Scene scene;
  scene.materials.resize(1);
  return scene;
}

// Adds a mesh as an object of its own.
void add(Scene& scene, std::vector<vec3> positions, std::vector<uvec3> triangles, std::uint32_t material = 0) {
  const auto mesh = static_cast<std::uint32_t>(scene.meshes.size());
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({"object " + std::to_string(object)});
  scene.meshes.push_back({"mesh", std::move(positions), {}, {}, std::move(triangles), material});
  scene.instances.push_back({mesh, object, dmat4(1.0)});
}

// A box whose faces turn outwards, or inwards.
void add_box(Scene& scene, const vec3& low, const vec3& high, bool is_inwards = false, std::uint32_t material = 0) {
  std::vector<vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
  }
  std::vector<uvec3> triangles{{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                               {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  if (is_inwards) {
    for (uvec3& t : triangles) std::swap(t.y, t.z);
  }
  add(scene, std::move(corners), std::move(triangles), material);
}

void add_furniture(Scene& scene) {
  add_box(scene, {-0.8f, 0.7f, -0.4f}, {0.8f, 0.75f, 0.4f});
  add_box(scene, {-1.9f, 0, -1.6f}, {-1.5f, 2, -0.6f});
  add_box(scene, {1.2f, 0, 1}, {1.7f, 0.5f, 1.5f});
}

// A square of 1 m at (x, 0), which faces +Z, or −Z.
void add_square(Scene& scene, float x, bool faces_back) {
  std::vector<uvec3> triangles{{0, 1, 2}, {0, 2, 3}};
  if (faces_back) triangles = {{0, 2, 1}, {0, 3, 2}};
  add(scene, {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}}, std::move(triangles));
}

ViewContent content(const Scene& scene, const Camera& camera) { return look(sample_triangles(scene), camera, aspect); }

Camera looking(const dvec3& eye, const dvec3& towards_viewer, double near_plane = 0.01) {
  Camera camera;
  camera.name = "here";
  camera.world_from_camera = frame_towards(towards_viewer, eye);
  camera.projection = PerspectiveProjection{1.0, near_plane};
  return camera;
}

dvec3 eye_of(const Camera& camera) { return dvec3(camera.world_from_camera[3]); }
dvec3 back_of(const Camera& camera) { return dvec3(camera.world_from_camera[2]); }

bool is_usual(const Camera& camera) {
  return glm::distance(back_of(camera), dvec3(0.5 * std::cos(25.0 * pi / 180.0), std::sin(25.0 * pi / 180.0),
                                              std::sqrt(0.75) * std::cos(25.0 * pi / 180.0))) < 1e-12;
}

// The image has about 60 × 34 pixels: the edges of a square of 17 × 17 are off by one row and one column at most.
constexpr double one_row = 2.0 * 17.0 / (60.0 * 34.0);

TEST(ViewContent, Shares_are_those_of_a_square_that_fills_a_known_part_of_the_image) {
  Scene scene = empty_scene();
  add_square(scene, -0.5f, false);
  Camera camera;
  // The image is 2 m high and 2 · 16/9 m wide: the square of 1 m covers 9/64 = 14.1 % of it.
  camera.projection = OrthographicProjection{1.0, 1.0, 0.0, 10.0};
  camera.world_from_camera[3] = {0, 0.5, 5, 1};
  const ViewContent front = content(scene, camera);
  EXPECT_NEAR(front.seen, 9.0 / 64.0, one_row);
  EXPECT_EQ(front.front, front.seen);
  EXPECT_EQ(front.behind, 0.0);
  EXPECT_EQ(front.variety, 0.0);  // one plane
  camera.world_from_camera = glm::rotate(dmat4(1.0), pi, dvec3(0, 1, 0));
  camera.world_from_camera[3] = {0, 0.5, -5, 1};
  const ViewContent back = content(scene, camera);
  EXPECT_EQ(back.seen, 0.0);
  EXPECT_NEAR(back.behind, 9.0 / 64.0, one_row);
  scene.materials[0].double_sided = true;
  EXPECT_NEAR(content(scene, camera).seen, 9.0 / 64.0, one_row);
  EXPECT_EQ(content(scene, camera).behind, 0.0);
}

TEST(ViewContent, Two_equal_halves_of_what_is_seen_have_an_entropy_of_ln_2) {
  Scene scene = empty_scene();
  add_square(scene, -1.0f, false);
  add_square(scene, 0.0f, false);
  Camera camera;
  camera.projection = OrthographicProjection{1.0, 1.0, 0.0, 10.0};
  camera.world_from_camera[3] = {0, 0.5, 5, 1};
  EXPECT_NEAR(content(scene, camera).variety, std::log(2.0), 0.01);
}

TEST(ViewContent, A_sample_of_a_large_scene_looks_like_the_scene) {
  // A ground of 2 · 200² triangles and a wall of two.
  Scene scene = empty_scene();
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  constexpr std::uint32_t n = 200;
  for (std::uint32_t z = 0; z <= n; ++z) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      positions.emplace_back(0.1f * static_cast<float>(x), 0.0f, 0.1f * static_cast<float>(z));
    }
  }
  for (std::uint32_t z = 0; z < n; ++z) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t i = z * (n + 1) + x;
      triangles.emplace_back(i, i + n + 1, i + 1);
      triangles.emplace_back(i + 1, i + n + 1, i + n + 2);
    }
  }
  add(scene, std::move(positions), std::move(triangles));
  add(scene, {{5, 0, 10}, {15, 0, 10}, {15, 5, 10}, {5, 5, 10}}, {{0, 1, 2}, {0, 2, 3}});
  const Camera camera = fit_camera(scene, aspect).camera;
  const ViewContent all = look(sample_triangles(scene, 100'000), camera, aspect);
  const TriangleSample sample = sample_triangles(scene, 4'000);
  EXPECT_LE(sample.triangles.size(), 4'100u);
  const ViewContent few = look(sample, camera, aspect);
  // One in twenty, enlarged: some overlap, and some gaps are left.
  EXPECT_NEAR(few.seen, all.seen, 0.2 * all.seen);
  EXPECT_NEAR(few.variety, all.variety, 0.2);
  EXPECT_LE(few.behind, 0.01);
}

TEST(FitCamera, A_box_on_the_ground_keeps_the_usual_view_and_its_note) {
  Scene scene = empty_scene();
  add(scene, {{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}}, {{0, 2, 1}, {0, 3, 2}});
  add_box(scene, {-1, 0, -1}, {1, 2, 1});
  const FittedCamera fitted = fit_camera(scene, aspect);
  EXPECT_TRUE(is_usual(fitted.camera));
  EXPECT_EQ(fitted.note,
            "the scene has no camera: one was fitted to its bounds, 30 degrees from the front (+Z) and 25 degrees "
            "above; add a camera to the file to choose another view");
}

TEST(FitCamera, Coplanar_squares_that_face_away_are_seen_from_their_front) {
  Scene scene = empty_scene();
  for (int i = 0; i < 22; ++i) add_square(scene, 1.1f * static_cast<float>(i), true);
  const FittedCamera fitted = fit_camera(scene, aspect);
  EXPECT_LT(back_of(fitted.camera).z, -0.5);
  const ViewContent seen = content(scene, fitted.camera);
  EXPECT_GT(seen.seen, 0.02);
  EXPECT_GT(seen.variety, std::log(15.0)) << "22 squares, most of them seen about equally";
  EXPECT_EQ(seen.behind, 0.0);
  EXPECT_NE(fitted.note.find("the usual view"), std::string::npos) << fitted.note;
  EXPECT_NE(fitted.note.find("back faces"), std::string::npos) << fitted.note;
}

TEST(FitCamera, Squares_that_face_down_are_seen_from_below) {
  Scene scene = empty_scene();
  add(scene, {{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}}, {{0, 1, 2}, {0, 2, 3}});
  const FittedCamera fitted = fit_camera(scene, aspect);
  EXPECT_LT(back_of(fitted.camera).y, 0.0);
  EXPECT_GT(content(scene, fitted.camera).seen, 0.1);
}

TEST(FitCamera, An_island_is_seen_and_not_the_water_of_392_m_around_it) {
  Scene scene = empty_scene();
  add(scene, {{-196, 0, -196}, {196, 0, -196}, {196, 0, 196}, {-196, 0, 196}}, {{0, 2, 1}, {0, 3, 2}});
  for (int i = 0; i < 12; ++i) {
    const float x = static_cast<float>(i % 4) * 3.0f - 40.0f;
    const float z = static_cast<float>(i / 4) * 3.0f + 60.0f;
    add_box(scene, {x, 0, z}, {x + 1.5f, 1.0f + 0.3f * static_cast<float>(i), z + 1.5f});
  }
  const FittedCamera fitted = fit_camera(scene, aspect);
  const ViewContent seen = content(scene, fitted.camera);
  EXPECT_GT(seen.variety, 1.0);
  EXPECT_LT(glm::distance(eye_of(fitted.camera), dvec3(-35, 0, 64)), 60.0);
  EXPECT_NE(fitted.note.find("part with most detail"), std::string::npos) << fitted.note;
  EXPECT_NE(fitted.note.find("one surface"), std::string::npos) << fitted.note;
}

// A plane of two sides hides what is below it from above, and shows its underside, which no sun lights, from below.
TEST(FitCamera, Water_of_two_sides_is_not_seen_from_below) {
  for (const float half_side : {60.0f, 196.0f}) {
    Scene scene = empty_scene();
    scene.materials.resize(2);
    scene.materials[1].double_sided = true;
    const float w = half_side;
    add(scene, {{-w, 0, -w}, {w, 0, -w}, {w, 0, w}, {-w, 0, w}}, {{0, 2, 1}, {0, 3, 2}}, 1);
    for (int i = 0; i < 12; ++i) {
      const float x = (static_cast<float>(i % 4) - 1.5f) * 6.0f;
      const float z = (static_cast<float>(i / 4) - 1.0f) * 6.0f;
      add_box(scene, {x - 2, -10 - static_cast<float>(i), z - 2}, {x + 2, 0, z + 2});
    }
    const FittedCamera fitted = fit_camera(scene, aspect);
    EXPECT_GT(back_of(fitted.camera).y, 0.0) << fitted.note;
    const ViewContent seen = content(scene, fitted.camera);
    EXPECT_GT(seen.lit, 0.5 * seen.seen);
    EXPECT_GT(seen.lit, 0.1);
  }
}

TEST(FitCamera, A_wall_lit_from_behind_is_seen_from_the_side_of_the_light) {
  Scene scene = empty_scene();
  scene.materials[0].double_sided = true;
  add_square(scene, -0.5f, false);
  Light light = default_sun();
  light.world_from_light = frame_towards({0.1, 0.5, -1.0}, dvec3(0));
  scene.lights.push_back(light);
  const FittedCamera fitted = fit_camera(scene, aspect);
  EXPECT_LT(back_of(fitted.camera).z, 0.0) << fitted.note;
  EXPECT_NE(fitted.note.find("face away from the light"), std::string::npos) << fitted.note;
  light.world_from_light = frame_towards({0.1, 0.5, 1.0}, dvec3(0));
  scene.lights = {light};
  EXPECT_TRUE(is_usual(fit_camera(scene, aspect).camera));
}

// Rooms of 5 m × 2.5 m × 4 m: walls of one side, walls with thickness, and walls of two sides.
Scene room(bool is_thick, bool is_double_sided) {
  Scene scene = empty_scene();
  scene.materials.resize(2);
  scene.materials[1].double_sided = is_double_sided;
  add_box(scene, {-2.5f, 0, -2}, {2.5f, 2.5f, 2}, true, 1);
  if (is_thick) add_box(scene, {-2.7f, -0.2f, -2.2f}, {2.7f, 2.7f, 2.2f});
  add_furniture(scene);
  return scene;
}

bool is_within(const dvec3& p) { return std::abs(p.x) < 2.5 && p.y > 0.0 && p.y < 2.5 && std::abs(p.z) < 2.0; }

TEST(FitCamera, A_closed_room_is_seen_from_inside) {
  for (const bool is_thick : {false, true}) {
    for (const bool is_double_sided : {false, true}) {
      const Scene scene = room(is_thick, is_double_sided);
      const FittedCamera fitted = fit_camera(scene, aspect);
      EXPECT_TRUE(is_within(eye_of(fitted.camera))) << is_thick << is_double_sided << fitted.note;
      const ViewContent seen = content(scene, fitted.camera);
      EXPECT_GT(seen.seen, 0.99);
      EXPECT_EQ(seen.cut, 0.0);
      EXPECT_EQ(camera_remark(scene, fitted.camera, aspect), "");
      EXPECT_NE(fitted.note.find("inside"), std::string::npos) << fitted.note;
    }
  }
}

TEST(FitCamera, A_solid_thing_is_seen_from_outside_whether_or_not_it_is_double_sided) {
  for (const bool is_double_sided : {false, true}) {
    Scene scene = empty_scene();
    scene.materials[0].double_sided = is_double_sided;
    add_box(scene, {-1, 0, -1}, {1, 2, 1});
    EXPECT_TRUE(is_usual(fit_camera(scene, aspect).camera)) << is_double_sided;
  }
}

TEST(FitCamera, The_same_scene_gives_the_same_camera) {
  const Scene scene = room(true, false);
  EXPECT_EQ(fit_camera(scene, aspect).camera.world_from_camera, fit_camera(scene, aspect).camera.world_from_camera);
}

TEST(CameraRemark, A_camera_inside_a_solid_object_is_remarked_on) {
  Scene scene = empty_scene();
  add(scene, {{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}}, {{0, 2, 1}, {0, 3, 2}});
  add_box(scene, {-1, 0, -1}, {1, 2, 1});
  const std::string remark = camera_remark(scene, looking({0, 1, 0}, {0, 0.2, 1}), aspect);
  EXPECT_NE(remark.find("'here' looks through back faces in 100 %"), std::string::npos) << remark;
  EXPECT_EQ(camera_remark(scene, looking({0, 2, 5}, {0, 0.2, 1}), aspect), "");
}

TEST(CameraRemark, A_near_plane_that_cuts_a_surface_is_remarked_on) {
  Scene scene = empty_scene();
  add_box(scene, {-1, 0, -1}, {1, 2, 1});
  // 5 cm before the face, with a near plane at 10 cm.
  const std::string remark = camera_remark(scene, looking({0, 1, 1.05}, {0, 0, 1}, 0.1), aspect);
  EXPECT_NE(remark.find("near plane, at 0.1 m"), std::string::npos) << remark;
  EXPECT_EQ(camera_remark(scene, looking({0, 1, 1.05}, {0, 0, 1}, 0.01), aspect), "");
}

TEST(CameraRemark, Within_a_room_there_is_none) {
  for (const bool is_thick : {false, true}) {
    const Scene scene = room(is_thick, false);
    EXPECT_EQ(camera_remark(scene, looking({2, 1.6, 1.5}, {1, 0.2, 0.8}, 0.1), aspect), "");
  }
}

TEST(CameraRemark, It_comes_with_the_camera_that_is_selected) {
  Scene scene = empty_scene();
  add_box(scene, {-1, 0, -1}, {1, 2, 1});
  scene.cameras.push_back(looking({0, 1, 0}, {0, 0.2, 1}));
  std::vector<std::string> notes;
  select_camera(scene, "", aspect, notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("back faces"), std::string::npos) << notes[0];
}

}  // namespace
}  // namespace umbrameter
