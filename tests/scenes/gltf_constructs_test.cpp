// Each construct of glTF, loaded from a small file whose geometry is known.
#include "tests/support/gltf_constructs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "core/error.h"
#include "scenes/gltf.h"
#include "scenes/material.h"
#include "tests/support/gltf_hostile.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter::test {
namespace {

std::string spelled(const dvec3& v) { return list_of({v.x, v.y, v.z}); }
std::string spelled(const Triangle& t) { return spelled(t.a) + spelled(t.b) + spelled(t.c); }

/// A triangle of the scene, its corners counter-clockwise seen from its front.
struct Facet {
  Triangle world;
  std::uint32_t instance = 0;
  uvec3 vertices;  ///< of the mesh, in the order of the corners
};

std::vector<Facet> facets_of(const Scene& scene) {
  std::vector<Facet> facets;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      Facet facet{world_triangle(scene, i, t), i, mesh.triangles[t]};
      if (is_mirrored(scene.instances[i].world_from_mesh)) {
        std::swap(facet.world.b, facet.world.c);
        std::swap(facet.vertices.y, facet.vertices.z);
      }
      facets.push_back(facet);
    }
  }
  return facets;
}

bool is_near(const dvec3& a, const dvec3& b, double tolerance) {
  const dvec3 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z}) <= tolerance;
}

// Wherever the corners begin.
bool is_same(const Triangle& a, const Triangle& b, double tolerance) {
  for (const Triangle& turned : {b, Triangle{b.b, b.c, b.a}, Triangle{b.c, b.a, b.b}}) {
    if (is_near(a.a, turned.a, tolerance) && is_near(a.b, turned.b, tolerance) && is_near(a.c, turned.c, tolerance)) {
      return true;
    }
  }
  return false;
}

void expect_triangles(const Construct& construct, const std::vector<Facet>& found) {
  ASSERT_EQ(found.size(), construct.triangles.size());
  std::vector<char> used(found.size(), 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Triangle& expected = construct.triangles[i];
    if (construct.in_order) {
      EXPECT_TRUE(is_same(expected, found[i].world, construct.tolerance))
          << "triangle " << i << " is " << spelled(found[i].world) << " where " << spelled(expected) << " is expected";
      continue;
    }
    std::size_t match = 0;
    while (match < found.size() && (used[match] != 0 || !is_same(expected, found[match].world, construct.tolerance))) {
      ++match;
    }
    ASSERT_LT(match, found.size()) << "no triangle is " << spelled(expected);
    used[match] = 1;
  }
}

void expect_flat_normals(const Scene& scene, const std::vector<Facet>& facets, double tolerance) {
  for (const Facet& facet : facets) {
    const Instance& instance = scene.instances[facet.instance];
    const Mesh& mesh = scene.meshes[instance.mesh];
    ASSERT_FALSE(mesh.normals.empty());
    const dvec3 flat = glm::normalize(glm::cross(facet.world.b - facet.world.a, facet.world.c - facet.world.a));
    const dmat3 world_from_normal = glm::transpose(glm::inverse(dmat3(instance.world_from_mesh)));
    for (int i = 0; i < 3; ++i) {
      const dvec3 normal = glm::normalize(world_from_normal * dvec3(mesh.normals[facet.vertices[i]]));
      EXPECT_TRUE(is_near(normal, flat, tolerance)) << spelled(normal) << " on " << spelled(facet.world);
    }
  }
}

/// Shares of the corners at a point of the triangle's plane.
dvec3 barycentric(const Triangle& t, const dvec3& p) {
  const dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
  const double area = glm::dot(normal, normal);
  return {glm::dot(glm::cross(t.c - t.b, p - t.b), normal) / area,
          glm::dot(glm::cross(t.a - t.c, p - t.c), normal) / area,
          glm::dot(glm::cross(t.b - t.a, p - t.a), normal) / area};
}

void expect_mask(const Scene& scene, const std::vector<Facet>& facets, const std::vector<MaskProbe>& probes) {
  for (const MaskProbe& probe : probes) {
    int met = 0;
    for (const Facet& facet : facets) {
      const dvec3 share = barycentric(facet.world, probe.point);
      const dvec3 at = share.x * facet.world.a + share.y * facet.world.b + share.z * facet.world.c;
      if (std::min({share.x, share.y, share.z}) < 0.0 || !is_near(at, probe.point, 1e-6)) continue;
      ++met;
      const Mesh& mesh = scene.meshes[scene.instances[facet.instance].mesh];
      const Material& material = scene.materials[mesh.material];
      EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
      dvec2 texcoord(0.0);
      for (int i = 0; i < 3 && !mesh.texcoords.empty(); ++i) {
        texcoord += share[i] * dvec2(mesh.texcoords[facet.vertices[i]]);
      }
      const float alpha = alpha_at(scene, material, vec2(texcoord));
      EXPECT_EQ(alpha >= material.alpha_cutoff, probe.exists)
          << "alpha " << alpha << " at texture coordinate " << texcoord.x << " " << texcoord.y << ", point "
          << spelled(probe.point);
    }
    EXPECT_EQ(met, 1) << spelled(probe.point);
  }
}

void expect_notes(const Scene& scene, const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& note : scene.notes) {
    EXPECT_EQ(note.find('\n'), std::string::npos) << note;
    all += "\n" + note;
  }
  EXPECT_EQ(scene.notes.size(), words.size()) << all;
  for (const std::string& word : words) EXPECT_NE(all.find(word), std::string::npos) << word << " is not in:" << all;
}

void expect_camera(const Scene& scene, const CameraPose& pose) {
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras.front();
  const dmat4& world = camera.world_from_camera;
  EXPECT_TRUE(is_near(dvec3(world[3]), pose.position, 1e-9));
  EXPECT_TRUE(is_near(-dvec3(world[2]), pose.forward, 1e-9));
  EXPECT_TRUE(is_near(dvec3(world[1]), pose.up, 1e-9));
  EXPECT_TRUE(is_near(dvec3(world[0]), glm::cross(pose.forward, pose.up), 1e-9)) << "x is to the right";
  const auto& lens = std::get<PerspectiveProjection>(camera.projection);
  EXPECT_EQ(std::isinf(lens.far_plane), pose.is_endless);
  EXPECT_DOUBLE_EQ(lens.near_plane, 0.125);
  EXPECT_DOUBLE_EQ(lens.vertical_fov, 0.9);
}

void expect_material(const Construct& construct, const Scene& scene) {
  const Material& material = scene.materials[scene.meshes[scene.instances.front().mesh].material];
  if (construct.base_color) {
    const vec4 color = base_color_at(scene, material, {0.5f, 0.5f});
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(static_cast<double>(color[i]), (*construct.base_color)[i], 1e-6) << i;
  }
  for (int i = 0; i < 3 && construct.f0; ++i) {
    // KHR_materials_specular: F0 = min(0.04 · colour, 1) · factor.
    const double f0 =
        std::min(0.04 * static_cast<double>(material.specular_color[i]), 1.0) * static_cast<double>(material.specular);
    EXPECT_NEAR(f0, (*construct.f0)[i], 1e-6) << i;
  }
}

class GltfConstruct : public testing::TestWithParam<std::size_t> {
 public:
  static const std::vector<Construct>& all() {
    static const std::vector<Construct> constructs = all_constructs();
    return constructs;
  }
};

TEST_P(GltfConstruct, is_read_as_the_specification_says) {
  const Construct& construct = all()[GetParam()];
  const TemporaryFolder folder;
  if (!construct.refused.empty()) {
    try {
      load(construct, folder.path());
      FAIL() << "it was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::unreadable_input);
      for (const std::string& word : construct.refused) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      }
    }
    return;
  }
  const Scene scene = load(construct, folder.path());
  const std::vector<Facet> facets = facets_of(scene);
  expect_triangles(construct, facets);
  expect_notes(scene, construct.notes);
  if (construct.flat_normals) expect_flat_normals(scene, facets, construct.normal_tolerance);
  expect_mask(scene, facets, construct.probes);
  if (construct.camera) expect_camera(scene, *construct.camera);
  expect_material(construct, scene);
}

INSTANTIATE_TEST_SUITE_P(Each, GltfConstruct, testing::Range(std::size_t{0}, GltfConstruct::all().size()),
                         [](const testing::TestParamInfo<std::size_t>& each) {
                           std::string name = GltfConstruct::all()[each.param].name;
                           std::erase_if(name, [](char c) { return c == ','; });
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
                           return name;
                         });

TEST(GltfConstructs, Masks_are_probed_at_points_that_exist_and_at_points_that_do_not) {
  for (const Construct& construct : mask_constructs()) {
    const auto exists = std::count_if(construct.probes.begin(), construct.probes.end(),
                                      [](const MaskProbe& probe) { return probe.exists; });
    if (construct.probes.size() == 1) continue;
    EXPECT_GE(exists, 1) << construct.name;
    EXPECT_GE(std::ssize(construct.probes) - exists, 3) << construct.name;
  }
}

TEST(GltfHostile, A_JPEG_of_too_many_codes_is_refused_before_it_is_decoded) {
  const TemporaryFolder folder;
  int refused = 0;
  for (const HostileFile& file : hostile_files()) {
    if (file.name.find("too many codes") == std::string::npos) continue;
    try {
      load_gltf(folder.write("test.glb", file.bytes));
      ADD_FAILURE() << file.name << " was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("more than 256 codes"), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_EQ(refused, 2);
}

}  // namespace
}  // namespace umbrameter::test
