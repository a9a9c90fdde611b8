#include <gtest/gtest.h>

#include <cmath>

#include "gltf_files.h"

namespace umbrameter {
namespace {

using test::append;
using test::base64;
using test::Bytes;
using test::bytes_of;
using test::glb;
using test::load;
using test::TemporaryFolder;
using test::triangle_json;
using test::triangle_positions;

// 2×2 RGBA PNG without filtering: red, green / blue, white at alpha 128.
const std::string png_2x2 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4z8DwHwyBNAg0AABJSQl4nFEXkgAAAABJRU5ErkJg"
    "gg==";

Scene load_nodes(const std::string& nodes, const std::string& more = "") {
  const TemporaryFolder folder;
  return load(folder, glb(triangle_json(nodes, more), triangle_positions()));
}

TEST(GltfNodes, Translation_rotation_and_scale_apply_in_this_order) {
  // 90° about z: x to y. The corner (1,0,0) is scaled to (2,0,0), turned to (0,2,0), moved to (10,22,30).
  const Scene scene = load_nodes(
      R"("nodes":[{"mesh":0,"translation":[10,20,30],"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,3,4]}])");
  const Triangle triangle = world_triangle(scene, 0, 0);
  EXPECT_NEAR(glm::distance(triangle.b, dvec3(10, 22, 30)), 0.0, 1e-14);
  EXPECT_NEAR(glm::distance(triangle.c, dvec3(7, 20, 30)), 0.0, 1e-14);
}

TEST(GltfNodes, Parents_apply_after_their_children) {
  const Scene scene = load_nodes(
      R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"scale":[-2,1,1],"children":[1]},{"translation":[1,0,0],"children":[2]},)"
      R"({"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,5,0,1],"mesh":0}])");
  ASSERT_EQ(scene.instances.size(), 1u);
  const Triangle triangle = world_triangle(scene, 0, 0);
  EXPECT_EQ(triangle.a, dvec3(-2, 5, 0));
  EXPECT_EQ(triangle.b, dvec3(-4, 5, 0));
  EXPECT_TRUE(is_mirrored(scene.instances[0].world_from_mesh));
}

TEST(GltfNodes, A_shared_mesh_is_stored_once_and_objects_are_named_by_node_then_mesh) {
  const Scene scene = load_nodes(R"("nodes":[{"mesh":0,"name":"left"},{"mesh":0,"translation":[5,0,0]}])");
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].mesh, 0u);
  EXPECT_EQ(scene.instances[1].object, 1u);
  EXPECT_EQ(scene.objects[0].name, "left");
  EXPECT_EQ(scene.objects[1].name, "tri");
  EXPECT_EQ(scene.name, "test");
}

TEST(GltfNodes, Only_the_default_scene_is_read) {
  const Scene scene = load_nodes(
      R"("scene":1,"scenes":[{"nodes":[0]},{"name":"second","nodes":[1]}],"nodes":[{"mesh":0,"name":"a"},{"mesh":0,"name":"b"}])");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "b");
  EXPECT_EQ(scene.name, "second");
}

TEST(GltfNodes, Ten_thousand_nested_nodes_are_no_problem) {
  std::string nodes = R"("scenes":[{"nodes":[0]}],"nodes":[)";
  for (int i = 1; i <= 10000; ++i) nodes += R"({"translation":[0.5,0,0],"children":[)" + std::to_string(i) + "]},";
  EXPECT_EQ(world_triangle(load_nodes(nodes + R"({"mesh":0}])"), 0, 0).a, dvec3(5000, 0, 0));
}

TEST(GltfNodes, Objects_scaled_to_nothing_are_left_out_with_a_note) {
  const Scene scene = load_nodes(R"("nodes":[{"mesh":0,"scale":[0,0,0]},{"mesh":0}])");
  EXPECT_EQ(scene.instances.size(), 1u);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0], "1 objects scaled to nothing were left out");
}

/// Four vertices of a square and the given index bytes.
Scene load_indexed(const Bytes& indices, int component, int count, int mode) {
  Bytes binary = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  binary.insert(binary.end(), indices.begin(), indices.end());
  const std::string size = std::to_string(binary.size());
  const TemporaryFolder folder;
  return load(folder,
              glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + size +
                      R"(}],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":)" +
                      std::to_string(indices.size()) +
                      R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
                      R"({"bufferView":1,"componentType":)" +
                      std::to_string(component) + R"(,"count":)" + std::to_string(count) +
                      R"(,"type":"SCALAR"}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"mode":)" +
                      std::to_string(mode) + R"(,"indices":1,"attributes":{"POSITION":0}}]}]})",
                  binary));
}

TEST(GltfIndices, All_widths_and_modes_give_the_same_two_triangles) {
  const std::vector<uvec3> list = {{0, 1, 2}, {2, 1, 3}};
  EXPECT_EQ(load_indexed(bytes_of<std::uint8_t>({0, 1, 2, 2, 1, 3}), 5121, 6, 4).meshes[0].triangles, list);
  EXPECT_EQ(load_indexed(bytes_of<std::uint16_t>({0, 1, 2, 2, 1, 3}), 5123, 6, 4).meshes[0].triangles, list);
  EXPECT_EQ(load_indexed(bytes_of<std::uint32_t>({0, 1, 2, 2, 1, 3}), 5125, 6, 4).meshes[0].triangles, list);
  // glTF 2.0, 3.7.2.1: strip triangles (i, i+1, i+2) and (i, i+2, i+1) by turns; fan triangles (i+1, i+2, 0).
  EXPECT_EQ(load_indexed(bytes_of<std::uint8_t>({0, 1, 2, 3}), 5121, 4, 5).meshes[0].triangles,
            (std::vector<uvec3>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(load_indexed(bytes_of<std::uint8_t>({0, 1, 3, 2}), 5121, 4, 6).meshes[0].triangles,
            (std::vector<uvec3>{{1, 3, 0}, {3, 2, 0}}));
}

TEST(GltfIndices, Triangles_without_area_are_dropped_and_counted) {
  const Scene scene = load_indexed(bytes_of<std::uint8_t>({0, 1, 2, 1, 1, 2, 2, 3, 2}), 5121, 9, 4);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0], "2 triangles without area were left out");
}

TEST(GltfIndices, Points_and_lines_are_left_out_with_a_note) {
  const Scene scene = load_indexed(bytes_of<std::uint8_t>({0, 1, 2, 3}), 5121, 4, 1);
  EXPECT_TRUE(scene.instances.empty());
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("points or lines"), std::string::npos);
}

TEST(GltfAttributes, Interleaved_floats_and_normalised_integers_are_read) {
  // Stride 24: position 12, normal as signed bytes 3 (+1), texcoord as unsigned shorts 4 (+4).
  Bytes binary;
  for (int i = 0; i < 3; ++i) {
    append<float>(binary, {i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f, 0.0f});
    append<std::int8_t>(binary, {0, 0, 127, 99});
    append<std::uint16_t>(binary, {static_cast<std::uint16_t>(i * 13107), 65535, 7, 7});
  }
  const TemporaryFolder folder;
  const Scene scene = load(
      folder, glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":72}],)"
                  R"("bufferViews":[{"buffer":0,"byteLength":72,"byteStride":24}],"accessors":[)"
                  R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                  R"({"bufferView":0,"byteOffset":12,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"},)"
                  R"({"bufferView":0,"byteOffset":16,"componentType":5123,"normalized":true,"count":3,"type":"VEC2"}],)"
                  R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                  R"({"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}]}]})",
                  binary));
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions[2], vec3(0, 1, 0));
  EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(mesh.texcoords[2].x, 0.4f);  // 26214 / 65535
  EXPECT_FLOAT_EQ(mesh.texcoords[2].y, 1.0f);
}

TEST(GltfAttributes, Missing_normals_stay_missing) {
  const Scene scene = load_nodes(R"("nodes":[{"mesh":0}])");
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  EXPECT_TRUE(scene.meshes[0].texcoords.empty());
  EXPECT_EQ(scene.materials.size(), 1u) << "the default material";
}

TEST(GltfBuffers, External_files_and_data_uris_are_read) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "sub dir");
  folder.write("sub dir/data.bin", triangle_positions());
  const auto external = folder.write(
      "external.gltf", triangle_json(R"("nodes":[{"mesh":0}])", "", R"({"uri":"sub%20dir/data.bin","byteLength":36})"));
  const auto embedded =
      folder.write("embedded.gltf", triangle_json(R"("nodes":[{"mesh":0}])", "",
                                                  R"({"uri":"data:application/octet-stream;base64,)" +
                                                      base64(triangle_positions()) + R"(","byteLength":36})"));
  for (const auto& path : {external, embedded}) {
    EXPECT_EQ(load_gltf(path).meshes.at(0).positions[1], vec3(1, 0, 0)) << path;
  }
}

TEST(GltfCameras, Both_projections_are_read_and_node_scale_is_removed) {
  const Scene scene = load_nodes(
      R"("nodes":[{"mesh":0},{"camera":0,"name":"eye","scale":[3,3,3],"translation":[1,2,3]},{"camera":1,"scale":[-2,1,5]}])",
      R"("cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":0.1}},)"
      R"({"name":"plan","type":"orthographic","orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":50}}])");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_EQ(scene.cameras[1].name, "plan");
  const auto& lens = std::get<PerspectiveProjection>(scene.cameras[0].projection);
  EXPECT_EQ(lens.vertical_fov, 0.9);
  EXPECT_EQ(lens.near_plane, 0.1);
  EXPECT_TRUE(std::isinf(lens.far_plane));
  EXPECT_EQ(std::get<OrthographicProjection>(scene.cameras[1].projection).half_height, 2.0);
  for (const Camera& camera : scene.cameras) {
    const dmat3 axes(camera.world_from_camera);
    EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-15);
    EXPECT_NEAR(glm::distance(axes[2], dvec3(0, 0, 1)), 0.0, 1e-15);
    EXPECT_NEAR(glm::distance(axes[1], dvec3(0, 1, 0)), 0.0, 1e-15);
  }
  EXPECT_EQ(dvec3(scene.cameras[0].world_from_camera[3]), dvec3(1, 2, 3));
}

TEST(GltfLights, They_are_numbered_by_depth_first_nodes_and_named_by_their_entry) {
  // Node 0 holds the point light under itself; roll of 90° about z turns the light's x to the world's y.
  const Scene scene = load_nodes(
      R"("scenes":[{"nodes":[0,2,4]}],"nodes":[{"children":[1]},{"name":"node","translation":[1,2,3],"scale":[9,9,9],)"
      R"("extensions":{"KHR_lights_punctual":{"light":2}}},{"rotation":[0,0,0.7071067811865476,0.7071067811865476],)"
      R"("extensions":{"KHR_lights_punctual":{"light":0}}},{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":1}}}])",
      R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional"},)"
      R"({"type":"spot","name":"lamp","color":[1,0.5,0.25],"intensity":7.5,"range":12,"spot":{"innerConeAngle":0.25,"outerConeAngle":0.5}},)"
      R"({"type":"point","range":4}]}})");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_TRUE(scene.notes.empty());
  EXPECT_EQ(std::get<PointLight>(scene.lights[0].shape).range, 4.0);
  EXPECT_EQ(scene.lights[0].name, "node") << "it has no name, so it takes its node's";
  EXPECT_EQ(scene.lights[1].name, "") << "neither has one";
  EXPECT_EQ(scene.lights[0].position(), dvec3(1, 2, 3));
  EXPECT_TRUE(std::holds_alternative<DirectionalLight>(scene.lights[1].shape));
  EXPECT_NEAR(glm::distance(dvec3(scene.lights[1].world_from_light[0]), dvec3(0, 1, 0)), 0.0, 1e-15) << "roll";
  const auto& spot = std::get<SpotLight>(scene.lights[2].shape);
  EXPECT_EQ(scene.lights[2].name, "lamp");
  EXPECT_EQ(scene.lights[2].intensity, 7.5);
  EXPECT_EQ(scene.lights[2].color, vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(spot.range, 12.0);
  EXPECT_EQ(spot.inner_cone_angle, 0.25);
  EXPECT_EQ(spot.outer_cone_angle, 0.5);
}

TEST(GltfLights, Those_of_hidden_nodes_are_left_out_and_cameras_there_are_not) {
  const std::string light = R"("KHR_lights_punctual":{"light":0})";
  const Scene scene = load_nodes(R"("nodes":[{"name":"shown","extensions":{)" + light +
                                     R"(}},{"children":[2,3],"extensions":{"KHR_node_visibility":)"
                                     R"({"visible":false}}},{"name":"below","extensions":{)" +
                                     light + R"(}},{"camera":0},{"mesh":0}])",
                                 R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],)"
                                 R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot"}]}})");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].name, "shown");
  EXPECT_EQ(scene.cameras.size(), 1u);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0], "1 nodes with a mesh or a light are hidden and were left out");
}

TEST(GltfMaterials, Factor_texture_wrap_alpha_and_sides_are_read) {
  const TemporaryFolder folder;
  std::string json = triangle_json(
      R"("nodes":[{"mesh":0}])",
      R"("materials":[{"name":"fence","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.75],"baseColorTexture":{"index":1}},)"
      R"("alphaMode":"MASK","alphaCutoff":0.3,"doubleSided":true},{"alphaMode":"BLEND"},{}],)"
      R"("textures":[{"source":9},{"name":"leaves","sampler":0,"source":0}],"samplers":[{"wrapS":33071,"wrapT":33648}],)"
      R"("images":[{"uri":"data:image/png;base64,)" +
          png_2x2 + R"("}])");
  json = test::replaced(json, R"({"attributes":{"POSITION":0}})", R"({"attributes":{"POSITION":0},"material":0})");
  const Scene scene = load(folder, glb(json, triangle_positions()));
  ASSERT_EQ(scene.textures.size(), 1u) << "textures of other uses are not decoded";
  const Texture& texture = scene.textures[0];
  EXPECT_EQ(texture.name, "leaves");
  EXPECT_EQ(texture.wrap_u, Wrap::clamp_to_edge);
  EXPECT_EQ(texture.wrap_v, Wrap::mirrored_repeat);
  EXPECT_EQ(texture.texels.at(0, 0), glm::u8vec4(255, 0, 0, 255));
  EXPECT_EQ(texture.texels.at(1, 0), glm::u8vec4(0, 255, 0, 255));
  EXPECT_EQ(texture.texels.at(0, 1), glm::u8vec4(0, 0, 255, 255));
  EXPECT_EQ(texture.texels.at(1, 1), glm::u8vec4(255, 255, 255, 128));
  const Material& fence = scene.materials[0];
  EXPECT_EQ(fence.name, "fence");
  EXPECT_EQ(fence.base_color, vec4(0.5f, 0.25f, 1.0f, 0.75f));
  EXPECT_EQ(fence.base_color_texture, 0u);
  EXPECT_EQ(fence.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(fence.alpha_cutoff, 0.3f);
  EXPECT_TRUE(fence.double_sided);
  EXPECT_EQ(scene.materials[1].alpha_mode, AlphaMode::blend);
  EXPECT_EQ(scene.materials[2].alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(scene.materials[2].alpha_cutoff, 0.5f);
  EXPECT_EQ(scene.materials[2].base_color, vec4(1.0f));
}

TEST(GltfExtensions, Unknown_used_ones_are_one_note_and_animations_another) {
  const Scene scene = load_nodes(R"("nodes":[{"mesh":0}])",
                                 R"("extensionsUsed":["KHR_materials_ior","EXT_thing"],"animations":[{"channels":1}])");
  ASSERT_EQ(scene.notes.size(), 2u);
  EXPECT_EQ(scene.notes[0], "extensions without effect here: KHR_materials_ior, EXT_thing");
  EXPECT_NE(scene.notes[1].find("rest pose"), std::string::npos);
}

TEST(GltfReader, It_writes_nothing_to_the_terminal) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const Scene scene = load_nodes(R"("nodes":[{"mesh":0}])");
  EXPECT_THROW(load_nodes(R"("nodes":[{"mesh":"x"}])"), Error);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace umbrameter
