// What every built-in scene promises, and the lengths and angles that the small ones are named after.
#include "scenes/builtin.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "core/error.h"
#include "gltf_files.h"
#include "scenes/gltf.h"
#include "scenes/view.h"

namespace umbrameter {
namespace {

using test::TemporaryFolder;

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

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

// Directed edges by position, so that vertices split for their normals count as one point.
using Point = std::tuple<float, float, float>;
std::map<std::pair<Point, Point>, int> edges_of(const Mesh& mesh) {
  const auto point = [&](std::uint32_t index) {
    const vec3& p = mesh.positions[index];
    return Point{p.x, p.y, p.z};
  };
  std::map<std::pair<Point, Point>, int> edges;
  for (const uvec3& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++edges[{point(triangle[i]), point(triangle[(i + 1) % 3])}];
  }
  return edges;
}

// By the divergence theorem: a sixth of the sum of the corners' triple products.
double volume_of(const Mesh& mesh) {
  double sum = 0.0;
  for (const uvec3& triangle : mesh.triangles) {
    sum += glm::dot(dvec3(mesh.positions[triangle.x]),
                    glm::cross(dvec3(mesh.positions[triangle.y]), dvec3(mesh.positions[triangle.z])));
  }
  return sum / 6.0;
}

bool is_rigid(const dmat4& pose) {
  const dmat3 axes(pose);
  const dmat3 gram = glm::transpose(axes) * axes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!(std::abs(gram[i][j] - (i == j ? 1.0 : 0.0)) < 1e-12)) return false;
    }
  }
  return glm::determinant(axes) > 0.0;
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

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

class EveryBuiltinScene : public testing::TestWithParam<std::string> {
 protected:
  // Made once a process: the large one takes a while.
  static const Scene& scene(const std::string& name) {
    static std::map<std::string, Scene> made;
    const auto found = made.find(name);
    return found != made.end() ? found->second : made.emplace(name, load_scene(name)).first->second;
  }
};

TEST_P(EveryBuiltinScene, Is_named_as_it_is_asked_for) {
  EXPECT_EQ(scene(GetParam()).name, GetParam());
  EXPECT_TRUE(scene(GetParam()).notes.empty());
}

TEST_P(EveryBuiltinScene, Has_every_index_in_range) {
  const Scene& made = scene(GetParam());
  for (const Mesh& mesh : made.meshes) {
    ASSERT_LT(mesh.material, made.materials.size()) << mesh.name;
    EXPECT_FALSE(mesh.triangles.empty()) << mesh.name;
    ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()) << mesh.name;
    ASSERT_TRUE(mesh.texcoords.empty() || mesh.texcoords.size() == mesh.positions.size()) << mesh.name;
    for (const uvec3& triangle : mesh.triangles) {
      for (int i = 0; i < 3; ++i) ASSERT_LT(triangle[i], mesh.positions.size()) << mesh.name;
    }
    if (made.materials[mesh.material].base_color_texture) {
      EXPECT_FALSE(mesh.texcoords.empty()) << mesh.name;
    }
  }
  std::set<std::uint32_t> shown, used;
  for (const Instance& instance : made.instances) {
    ASSERT_LT(instance.mesh, made.meshes.size());
    ASSERT_LT(instance.object, made.objects.size());
    shown.insert(instance.mesh);
  }
  EXPECT_EQ(shown.size(), made.meshes.size()) << "a mesh that nothing shows";
  for (const Material& material : made.materials) {
    if (!material.base_color_texture) continue;
    ASSERT_LT(*material.base_color_texture, made.textures.size()) << material.name;
    used.insert(*material.base_color_texture);
  }
  EXPECT_EQ(used.size(), made.textures.size()) << "a texture that nothing uses";
}

TEST_P(EveryBuiltinScene, Is_finite_with_unit_normals_that_agree_with_the_winding) {
  for (const Mesh& mesh : scene(GetParam()).meshes) {
    for (const vec3& position : mesh.positions) {
      ASSERT_TRUE(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)) << mesh.name;
    }
    ASSERT_FALSE(mesh.normals.empty()) << mesh.name;
    for (const vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(dvec3(normal)), 1.0, 1e-6) << mesh.name;
    for (const vec2& texcoord : mesh.texcoords) {
      ASSERT_TRUE(std::isfinite(texcoord.x) && std::isfinite(texcoord.y)) << mesh.name;
    }
    for (const uvec3& triangle : mesh.triangles) {
      const dvec3 a(mesh.positions[triangle.x]);
      const dvec3 face = glm::cross(dvec3(mesh.positions[triangle.y]) - a, dvec3(mesh.positions[triangle.z]) - a);
      for (int i = 0; i < 3; ++i) ASSERT_GT(glm::dot(face, dvec3(mesh.normals[triangle[i]])), 0.0) << mesh.name;
    }
  }
}

TEST_P(EveryBuiltinScene, Has_no_degenerate_triangle) {
  const Scene& made = scene(GetParam());
  for (std::uint32_t i = 0; i < made.instances.size(); ++i) {
    const Mesh& mesh = made.meshes[made.instances[i].mesh];
    for (std::uint32_t j = 0; j < mesh.triangles.size(); ++j) {
      const Triangle t = world_triangle(made, i, j);
      const double longest = std::max(glm::length(t.b - t.a), std::max(glm::length(t.c - t.b), glm::length(t.a - t.c)));
      const double height = glm::length(glm::cross(t.b - t.a, t.c - t.a)) / longest;
      // A hundredth of a millimetre: single precision still knows which way such a triangle faces.
      ASSERT_GT(height, 1e-5) << mesh.name << " triangle " << j;
    }
  }
}

TEST_P(EveryBuiltinScene, Has_solids_without_holes_that_face_outwards) {
  const Scene& made = scene(GetParam());
  for (const Mesh& mesh : made.meshes) {
    // The one plane is the subject of its scene; sheets that are seen from both sides have no inside.
    if (made.materials[mesh.material].double_sided || made.name == "tilted-plane") continue;
    const auto edges = edges_of(mesh);
    for (const auto& [edge, uses] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      ASSERT_TRUE(back != edges.end() && back->second == uses) << mesh.name << " is open";
    }
    EXPECT_GT(volume_of(mesh), 0.0) << mesh.name;
  }
}

TEST_P(EveryBuiltinScene, Has_cameras_and_lights_with_names_of_their_own) {
  const Scene& made = scene(GetParam());
  std::set<std::string> cameras, lights;
  for (const Camera& camera : made.cameras) {
    EXPECT_TRUE(!camera.name.empty() && cameras.insert(camera.name).second) << camera.name;
    EXPECT_TRUE(is_rigid(camera.world_from_camera)) << camera.name;
  }
  for (const Light& light : made.lights) {
    EXPECT_TRUE(!light.name.empty() && lights.insert(light.name).second) << light.name;
    EXPECT_TRUE(is_rigid(light.world_from_light)) << light.name;
    EXPECT_GT(light.intensity, 0.0) << light.name;
  }
  EXPECT_FALSE(cameras.empty());
  EXPECT_FALSE(lights.empty());
}

TEST_P(EveryBuiltinScene, Has_albedos_that_paint_could_have) {
  for (const Material& material : scene(GetParam()).materials) {
    for (int i = 0; i < 3; ++i) {
      // Soot reflects about 2 %; 1 is a plain factor to a texture.
      if (!material.base_color_texture) {
        EXPECT_GE(material.base_color[i], 0.02f) << material.name;
        EXPECT_LE(material.base_color[i], 0.9f) << material.name;
      }
    }
    EXPECT_EQ(material.base_color.w, 1.0f) << material.name;
  }
}

TEST_P(EveryBuiltinScene, Is_made_the_same_each_time) {
  EXPECT_EQ(to_glb(load_scene(GetParam())), to_glb(scene(GetParam())));
}

TEST_P(EveryBuiltinScene, Comes_back_from_a_file_as_it_was) {
  const Scene& made = scene(GetParam());
  const std::vector<unsigned char> bytes = to_glb(made);
  const TemporaryFolder folder;
  const Scene back = load_scene(folder.write("scene.glb", bytes).string());
  EXPECT_EQ(back.name, made.name);
  EXPECT_TRUE(back.notes.empty());
  ASSERT_EQ(back.meshes.size(), made.meshes.size());
  for (std::size_t i = 0; i < made.meshes.size(); ++i) {
    EXPECT_EQ(back.meshes[i].name, made.meshes[i].name);
    EXPECT_EQ(back.meshes[i].material, made.meshes[i].material);
    EXPECT_TRUE(same_bits(back.meshes[i].positions, made.meshes[i].positions)) << made.meshes[i].name;
    EXPECT_TRUE(same_bits(back.meshes[i].normals, made.meshes[i].normals)) << made.meshes[i].name;
    EXPECT_TRUE(same_bits(back.meshes[i].texcoords, made.meshes[i].texcoords)) << made.meshes[i].name;
    EXPECT_TRUE(same_bits(back.meshes[i].triangles, made.meshes[i].triangles)) << made.meshes[i].name;
  }
  ASSERT_EQ(back.instances.size(), made.instances.size());
  for (std::size_t i = 0; i < made.instances.size(); ++i) {
    EXPECT_EQ(back.instances[i].mesh, made.instances[i].mesh);
    EXPECT_EQ(back.objects[back.instances[i].object].name, made.objects[made.instances[i].object].name);
    EXPECT_TRUE(same_bits(back.instances[i].world_from_mesh, made.instances[i].world_from_mesh));
  }
  ASSERT_EQ(back.materials.size(), made.materials.size());
  for (std::size_t i = 0; i < made.materials.size(); ++i) {
    EXPECT_EQ(back.materials[i].name, made.materials[i].name);
    EXPECT_EQ(back.materials[i].alpha_mode, made.materials[i].alpha_mode);
    EXPECT_EQ(back.materials[i].double_sided, made.materials[i].double_sided);
    EXPECT_EQ(back.materials[i].base_color_texture, made.materials[i].base_color_texture);
    EXPECT_TRUE(same_bits(back.materials[i].base_color, made.materials[i].base_color));
  }
  ASSERT_EQ(back.textures.size(), made.textures.size());
  for (std::size_t i = 0; i < made.textures.size(); ++i) EXPECT_EQ(back.textures[i].texels, made.textures[i].texels);
  ASSERT_EQ(back.cameras.size(), made.cameras.size());
  for (std::size_t i = 0; i < made.cameras.size(); ++i) {
    EXPECT_EQ(back.cameras[i].name, made.cameras[i].name);
    EXPECT_TRUE(same_bits(back.cameras[i].world_from_camera, made.cameras[i].world_from_camera));
  }
  ASSERT_EQ(back.lights.size(), made.lights.size());
  for (std::size_t i = 0; i < made.lights.size(); ++i) {
    EXPECT_EQ(back.lights[i].name, made.lights[i].name);
    EXPECT_EQ(back.lights[i].intensity, made.lights[i].intensity);
    EXPECT_EQ(back.lights[i].shape.index(), made.lights[i].shape.index());
    EXPECT_TRUE(same_bits(back.lights[i].world_from_light, made.lights[i].world_from_light));
  }
  EXPECT_EQ(to_glb(back), bytes);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryBuiltinScene,
                         testing::Values("courtyard", "tilted-plane", "contact-box", "thin-leaf", "corner"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) {
                             if (c == '-') c = '_';
                           }
                           return name;
                         });

TEST(BuiltinScenes, Are_listed_with_the_courtyard_first) {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    names.emplace_back(scene.name);
    EXPECT_FALSE(scene.purpose.empty());
    EXPECT_FALSE(contains(std::string(scene.purpose), "\n"));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"courtyard", "tilted-plane", "contact-box", "thin-leaf", "corner"}));
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
    const Light& light = light_named(scene, tilt.name);
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
