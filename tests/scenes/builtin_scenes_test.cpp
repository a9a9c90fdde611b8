// What each built-in scene promises on its own: the lengths and angles that the small ones are named after.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/error.h"
#include "gltf_files.h"
#include "scenes/builtin.h"
#include "scenes/gltf.h"
#include "scenes/view.h"
#include "tests/support/text.h"

namespace umbrameter {
namespace {

using test::TemporaryFolder;

const Light& light_named(const Scene& scene, const std::string& name) {
  for (const Light& light : scene.lights) {
    if (light.name == name) return light;
  }
  throw std::runtime_error("no light " + name);
}

std::map<std::string, Bounds> bounds_of_objects(const Scene& scene) {
  std::map<std::string, Bounds> bounds;
  for (const Instance& instance : scene.instances) {
    for (const vec3& position : scene.meshes[instance.mesh].positions) {
      bounds[scene.objects[instance.object].name].include(
          dvec3(instance.world_from_mesh * dvec4(dvec3(position), 1.0)));
    }
  }
  return bounds;
}

double smallest_extent(const Bounds& bounds) {
  const dvec3 extent = bounds.extent();
  return std::min(extent.x, std::min(extent.y, extent.z));
}

std::string failure_of(const std::string& name) {
  try {
    load_scene(name);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "'" << name << "' was loaded";
  return {};
}

TEST(Courtyard, Has_50000_to_150000_triangles_most_of_them_shared) {
  const Scene scene = load_scene("courtyard");
  const SceneCounts counts = count(scene);
  EXPECT_GE(counts.triangles, 50000u);
  EXPECT_LE(counts.triangles, 150000u);
  EXPECT_LT(counts.stored_triangles, counts.triangles / 2);
}

TEST(Courtyard, Has_columns_and_balusters_that_share_a_mesh_each) {
  const Scene scene = load_scene("courtyard");
  for (const std::string name : {"column", "baluster"}) {
    std::set<std::uint32_t> meshes;
    int shown = 0;
    for (const Instance& instance : scene.instances) {
      if (scene.meshes[instance.mesh].name != name) continue;
      meshes.insert(instance.mesh);
      ++shown;
    }
    EXPECT_EQ(meshes.size(), 1u) << name;
    EXPECT_GE(shown, 6) << name;
  }
}

TEST(Courtyard, Has_a_sun_40_degrees_high_a_lantern_and_a_spot) {
  const Scene scene = load_scene("courtyard");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].name, "sun");
  EXPECT_TRUE(std::holds_alternative<DirectionalLight>(scene.lights[0].shape));
  EXPECT_NEAR(std::asin(-scene.lights[0].axis().y) * 180.0 / pi, 40.0, 1e-9);
  EXPECT_TRUE(std::holds_alternative<PointLight>(light_named(scene, "lantern").shape));
  EXPECT_TRUE(std::holds_alternative<SpotLight>(light_named(scene, "spot").shape));
}

TEST(Courtyard, Has_an_overview_and_a_view_along_the_arcade) {
  const Scene scene = load_scene("courtyard");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "overview");
  EXPECT_EQ(scene.cameras[1].name, "arcade");
}

TEST(Courtyard, Masks_what_is_cut_out_of_a_picture) {
  const Scene scene = load_scene("courtyard");
  int masked = 0;
  for (const Material& material : scene.materials) {
    if (material.alpha_mode != AlphaMode::mask) continue;
    ++masked;
    ASSERT_TRUE(material.base_color_texture) << material.name;
    int open = 0, solid = 0;
    for (const glm::u8vec4& texel : scene.textures[*material.base_color_texture].texels.pixels) {
      ++(static_cast<float>(texel.w) / 255.0f < material.alpha_cutoff ? open : solid);
    }
    EXPECT_GT(open, 0) << material.name;
    EXPECT_GT(solid, 0) << material.name;
  }
  EXPECT_GE(masked, 2);  // the fence and the leaves
}

// The angle θ of TRUTH.md items 11 and 12 is in the light's name, the azimuth ψ of the slope after it.
struct Tilt {
  const char* name;
  double theta, psi;
};

TEST(TiltedPlane, Has_suns_at_the_angles_in_their_names) {
  const Scene scene = load_scene("tilted-plane");
  constexpr std::array<Tilt, 4> tilts{
      {{"sun-60", 60, 0}, {"sun-30", 30, 0}, {"sun-75", 75, 0}, {"sun-60-azimuth-45", 60, 45}}};
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    const Tilt& tilt = tilts[i];
    EXPECT_EQ(scene.lights.at(i).name, tilt.name);
    const Light light = light_named(scene, tilt.name);
    const dvec3 normal(0, 1, 0);
    EXPECT_NEAR(glm::dot(-light.axis(), normal), std::cos(tilt.theta * pi / 180.0), 1e-12) << tilt.name;
    // The plane's depth grows along the part of the normal across the light; its angle to the map's axes is ψ.
    const double across = glm::dot(normal, dvec3(light.world_from_light[0]));
    const double along = glm::dot(normal, dvec3(light.world_from_light[1]));
    const double p = std::max(std::abs(across), std::abs(along)) / std::sin(tilt.theta * pi / 180.0);
    const double q = std::min(std::abs(across), std::abs(along)) / std::sin(tilt.theta * pi / 180.0);
    EXPECT_NEAR(p, std::cos(tilt.psi * pi / 180.0), 1e-12) << tilt.name;
    EXPECT_NEAR(q, std::sin(tilt.psi * pi / 180.0), 1e-12) << tilt.name;
  }
}

TEST(TiltedPlane, Fills_every_camera_and_its_edges_lie_outside) {
  const Scene scene = load_scene("tilted-plane");
  const Bounds bounds = bounds_of(scene);
  EXPECT_EQ(bounds.min, dvec3(-10, 0, -10));
  EXPECT_EQ(bounds.max, dvec3(10, 0, 10));
  for (const Camera& camera : scene.cameras) {
    const View view{1280, 720, camera};
    for (const auto& [x, y] : {std::pair{0, 0}, {1279, 0}, {0, 719}, {1279, 719}}) {
      const Ray ray = pixel_ray(view, x, y);
      ASSERT_LT(ray.direction.y, 0.0);
      const dvec3 hit = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
      EXPECT_LT(std::max(std::abs(hit.x), std::abs(hit.z)), 9.5) << camera.name;
    }
  }
}

TEST(ContactBox, Has_boxes_at_exactly_the_gaps_in_their_names) {
  const auto bounds = bounds_of_objects(load_scene("contact-box"));
  constexpr std::array<std::pair<const char*, double>, 9> gaps{{{"gap 0", 0.0},
                                                                {"gap 1 mm", 0.001},
                                                                {"gap 2 mm", 0.002},
                                                                {"gap 5 mm", 0.005},
                                                                {"gap 1 cm", 0.01},
                                                                {"gap 2 cm", 0.02},
                                                                {"gap 5 cm", 0.05},
                                                                {"gap 10 cm", 0.1},
                                                                {"gap 20 cm", 0.2}}};
  EXPECT_EQ(bounds.size(), gaps.size() + 1);
  EXPECT_EQ(bounds.at("ground").max.y, 0.0);
  for (const auto& [name, gap] : gaps) EXPECT_EQ(bounds.at(name).min.y, gap) << name;
}

TEST(ContactBox, Has_its_sun_45_degrees_high) {
  const Scene scene = load_scene("contact-box");
  EXPECT_EQ(scene.lights.front().name, "sun");
  EXPECT_NEAR(-scene.lights.front().axis().y, std::sqrt(0.5), 1e-12);
}

TEST(ThinLeaf, Has_sheets_of_exactly_the_thickness_in_their_names) {
  int sheets = 0;
  bool is_lying = false, is_standing = false;
  for (const auto& [name, bounds] : bounds_of_objects(load_scene("thin-leaf"))) {
    if (name == "ground") {
      EXPECT_EQ(bounds.max.y, 0.0);
      continue;
    }
    const bool millimetre = name.ends_with(" 1 mm");
    ASSERT_TRUE(millimetre || name.ends_with(" 1 cm")) << name;
    EXPECT_NEAR(smallest_extent(bounds), millimetre ? 0.001 : 0.01, 1e-15) << name;
    if (bounds.extent().y < 0.02) {
      is_lying = true;
      EXPECT_GT(bounds.min.y, 0.01) << name;
    } else {
      is_standing = true;
      EXPECT_LT(bounds.min.y, 0.0) << name;  // rooted: no light passes beneath
    }
    ++sheets;
  }
  EXPECT_GE(sheets, 8);
  EXPECT_TRUE(is_lying && is_standing);
}

TEST(Corner, Has_slabs_at_least_20_cm_thick_and_every_kind_of_light) {
  const Scene scene = load_scene("corner");
  const Bounds slabs = bounds_of_objects(scene).at("corner");
  // The three inner faces meet at the origin.
  EXPECT_LE(std::max(slabs.min.x, std::max(slabs.min.y, slabs.min.z)), -0.2);
  EXPECT_TRUE(std::holds_alternative<DirectionalLight>(light_named(scene, "sun").shape));
  EXPECT_TRUE(std::holds_alternative<PointLight>(light_named(scene, "lamp").shape));
  EXPECT_TRUE(std::holds_alternative<SpotLight>(light_named(scene, "spot").shape));
}

TEST(LoadScene, A_misspelt_name_lists_the_scenes_and_suggests_the_nearest) {
  const std::string text = failure_of("courtyrad");
  EXPECT_TRUE(contains(text, "'courtyrad'")) << text;
  EXPECT_TRUE(contains(text, "did you mean 'courtyard'?")) << text;
  for (const BuiltinScene& scene : builtin_scenes()) EXPECT_TRUE(contains(text, scene.name)) << text;
  EXPECT_FALSE(contains(text, "\n")) << text;
  EXPECT_TRUE(contains(failure_of("contactbox"), "did you mean 'contact-box'?"));
  EXPECT_TRUE(contains(failure_of("forrest:20M"), "did you mean 'forest'?"));
  EXPECT_FALSE(contains(failure_of("nope"), "did you mean")) << "'room' shares one letter of four";
}

TEST(LoadScene, A_name_far_from_all_others_gets_no_guess) {
  const std::string text = failure_of("bistro-exterior-night");
  EXPECT_FALSE(contains(text, "did you mean")) << text;
  EXPECT_TRUE(contains(text, "thin-leaf")) << text;
}

TEST(LoadScene, A_missing_file_and_an_empty_name_list_the_scenes_too) {
  const std::string text = failure_of("no/such/folder/house.glb");
  EXPECT_TRUE(contains(text, "no/such/folder/house.glb")) << text;
  EXPECT_TRUE(contains(text, "tilted-plane")) << text;
  EXPECT_TRUE(contains(failure_of(""), "courtyard"));
  EXPECT_FALSE(contains(failure_of("two\nlines"), "\n"));
}

TEST(LoadScene, A_folder_and_a_file_that_is_no_scene_are_unreadable) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(failure_of(folder.path().string()), folder.path().string()));
  const std::string path = folder.write("notes.txt", std::string("hello")).string();
  EXPECT_TRUE(contains(failure_of(path), path));
}

TEST(LoadScene, A_builtin_name_wins_over_a_file_of_that_name) {
  const TemporaryFolder folder;
  folder.write("corner", std::string("no scene at all"));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_EQ(load_scene("corner").name, "corner");
  EXPECT_TRUE(contains(failure_of("./corner"), "./corner"));  // a path is a path
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace umbrameter
