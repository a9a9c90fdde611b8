// What every built-in scene promises.
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
#include "tests/support/text.h"

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
  EXPECT_EQ(scene(GetParam()).name, GetParam().substr(0, GetParam().find(':')));
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
    // The houses are all flat faces.
    ASSERT_TRUE(!mesh.normals.empty() || GetParam().starts_with("city")) << mesh.name;
    for (const vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(dvec3(normal)), 1.0, 1e-6) << mesh.name;
    for (const vec2& texcoord : mesh.texcoords) {
      ASSERT_TRUE(std::isfinite(texcoord.x) && std::isfinite(texcoord.y)) << mesh.name;
    }
    for (const uvec3& triangle : mesh.triangles) {
      const dvec3 a(mesh.positions[triangle.x]);
      const dvec3 face = glm::cross(dvec3(mesh.positions[triangle.y]) - a, dvec3(mesh.positions[triangle.z]) - a);
      if (mesh.normals.empty()) continue;
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
                         testing::Values("courtyard", "tilted-plane", "contact-box", "thin-leaf", "corner", "trench",
                                         "spheres", "ramp", "long-posts", "two-occluders", "room", "fence", "foliage",
                                         "city:30k", "forest:100k"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) {
                             if (c == '-' || c == ':') c = '_';
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
  EXPECT_EQ(names, (std::vector<std::string>{"courtyard", "tilted-plane", "contact-box", "thin-leaf", "corner",
                                             "trench", "spheres", "ramp", "long-posts", "two-occluders", "room",
                                             "fence", "foliage", "city", "forest"}));
}

}  // namespace
}  // namespace umbrameter
