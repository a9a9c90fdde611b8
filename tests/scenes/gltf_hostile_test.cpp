// Input that is broken or ill-meant: always one clear Error or a Scene, never a crash.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "gltf_files.h"

namespace umbrameter {
namespace {

using test::broken;
using test::Bytes;
using test::bytes_of;
using test::expect_unreadable;
using test::glb;
using test::load;
using test::replaced;
using test::TemporaryFolder;
using test::triangle_json;
using test::triangle_positions;

Bytes with_nodes(const std::string& nodes, const std::string& more = "") {
  return glb(triangle_json(nodes, more), triangle_positions());
}

Bytes indexed(const std::vector<std::uint16_t>& indices) {
  Bytes binary = triangle_positions();
  test::append(binary, indices);
  const std::string size = std::to_string(2 * indices.size());
  std::string json =
      replaced(triangle_json(), R"({"byteLength":36})", R"({"byteLength":)" + std::to_string(binary.size()) + "}");
  json = replaced(json, R"("byteLength":36}])",
                  R"("byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":)" + size + "}]");
  json = replaced(json, R"("VEC3"}])",
                  R"("VEC3"},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":)" +
                      std::to_string(indices.size()) + "}]");
  return glb(replaced(json, R"("attributes")", R"("indices":1,"attributes")"), binary);
}

/// Something of everything: texture, camera, lights, hierarchy.
Bytes rich_glb() {
  Scene scene;
  scene.name = "rich";
  Texture texture;
  texture.texels = Image<glm::u8vec4>(4, 4, {10, 20, 30, 40});
  scene.textures.push_back(texture);
  Material material;
  material.base_color_texture = 0;
  material.alpha_mode = AlphaMode::mask;
  scene.materials.push_back(material);
  Mesh mesh;
  mesh.name = "quad";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals = std::vector<vec3>(4, vec3(0, 0, 1));
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(mesh);
  scene.objects = {{"a"}, {"b"}};
  scene.instances = {{0, 0, dmat4(1.0)}, {0, 1, dmat4(2.0)}};
  scene.instances[1].world_from_mesh[3] = {1, 2, 3, 1};
  scene.cameras.resize(1);
  scene.cameras[0].projection = PerspectiveProjection{};
  scene.lights.resize(2);
  scene.lights[1].shape = SpotLight{3.0, 0.1, 0.5};
  return to_glb(scene);
}

TEST(GltfFile, A_missing_file_and_a_folder_are_named) {
  const TemporaryFolder folder;
  expect_unreadable(folder.path() / "absent.glb", {"no such file"});
  expect_unreadable(folder.path(), {"folder"});
  expect_unreadable(folder.write("empty.gltf", std::string()), {"empty"});
  expect_unreadable(folder.write("text.gltf", std::string("hello")), {"neither binary glTF nor JSON"});
  expect_unreadable(folder.write("list.gltf", std::string("[]")), {"not an object"});
  expect_unreadable(folder.write("old.gltf", std::string(R"({"asset":{"version":"1.0"}})")), {"glTF 1.0", "convert"});
  expect_unreadable(folder.write("none.gltf", std::string("{}")), {"no glTF version"});
  expect_unreadable("/dev/zero", {"not a regular file"});
}

TEST(GltfFile, Every_shorter_prefix_of_a_binary_file_is_an_error) {
  const TemporaryFolder folder;
  const Bytes whole = rich_glb();
  ASSERT_NO_THROW(load(folder, whole));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    expect_unreadable(folder.write("cut.glb", part), {});
  }
}

TEST(GltfFile, A_truncated_binary_file_says_so) {
  Bytes bytes = rich_glb();
  bytes.resize(bytes.size() / 2);
  expect_unreadable(bytes, {"truncated", "copy or export the file again"});
}

TEST(GltfFile, Random_damage_gives_an_error_or_a_scene) {
  const TemporaryFolder folder;
  const Bytes whole = rich_glb();
  std::mt19937 random(20240607);
  int read = 0;
  int refused = 0;
  for (unsigned run = 0; run < 4000; ++run) {
    Bytes damaged = whole;
    const unsigned flips = 1 + random() % 4;
    for (unsigned i = 0; i < flips; ++i)
      damaged[random() % damaged.size()] ^= static_cast<unsigned char>(1u << (random() % 8));
    const auto path = folder.write("damaged.glb", damaged);
    try {
      const Scene scene = load_gltf(path);
      for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(mesh.material, scene.materials.size());
        for (const uvec3& t : mesh.triangles) {
          ASSERT_TRUE(t.x < mesh.positions.size() && t.y < mesh.positions.size() && t.z < mesh.positions.size());
        }
      }
      ++read;
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ExitCode::unreadable_input);
      ++refused;
    }
  }
  // Most of the bytes are text or geometry, so both must occur often.
  EXPECT_GT(read, 400);
  EXPECT_GT(refused, 400);
}

TEST(GltfFile, Random_damage_of_the_text_alone_gives_an_error_or_a_scene) {
  const TemporaryFolder folder;
  const std::string text = triangle_json(
      R"("scene":0,"scenes":[{"nodes":[0,1,2]}],"nodes":[{"mesh":0,"children":[3]},{"camera":0},{"extensions":{"KHR_lights_punctual":{"light":0}}},{"mesh":0,"scale":[1,2,3]}])",
      R"("cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":0.1}}],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},)"
      R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]}}])",
      R"({"uri":"data:application/octet-stream;base64,)" + test::base64(triangle_positions()) +
          R"(","byteLength":36})");
  const std::string spares = "0123456789-.e\"[]{},:nultrefas";
  std::mt19937 random(7);
  for (unsigned run = 0; run < 4000; ++run) {
    std::string damaged = text;
    for (unsigned i = 0; i < 1 + run % 3; ++i) damaged[random() % damaged.size()] = spares[random() % spares.size()];
    const auto path = folder.write("damaged.gltf", damaged);
    try {
      load_gltf(path);
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ExitCode::unreadable_input);
    }
  }
}

TEST(GltfReferences, Indices_out_of_range_name_object_and_number) {
  expect_unreadable(indexed({0, 1, 3}), {"mesh 0 'tri' primitive 0", "index 2", "vertex 3 of 3"});
  expect_unreadable(broken(R"({"POSITION":0})", R"({"POSITION":7})"), {"mesh 0 'tri' primitive 0", "accessor 7"});
  expect_unreadable(broken(R"("bufferView":0)", R"("bufferView":3)"), {"accessor 0", "bufferView 3"});
  expect_unreadable(broken(R"("buffer":0)", R"("buffer":5)"), {"bufferView 0", "buffer 5"});
  expect_unreadable(broken(R"("attributes")", R"("material":2,"attributes")"), {"mesh 0", "material 2"});
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":4}])"), {"node 0", "mesh 4"});
  expect_unreadable(with_nodes(R"("nodes":[{"camera":0}])"), {"node 0", "camera 0"});
  expect_unreadable(with_nodes(R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":1}}}])"),
                    {"node 0", "light 1"});
  expect_unreadable(with_nodes(R"("scene":3,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])"), {"scene", "3"});
  expect_unreadable(with_nodes(R"("scenes":[{"nodes":[8]}],"nodes":[{"mesh":0}])"), {"node 8"});
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":0}])",
                               R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])"),
                    {"material 0", "texture 0"});
}

TEST(GltfReferences, Bytes_beyond_their_buffer_are_refused) {
  expect_unreadable(broken(R"("count":3)", R"("count":4)"), {"accessor 0", "bufferView 0", "beyond"});
  expect_unreadable(broken(R"("count":3)", R"("count":2000000000)"), {"accessor 0", "beyond"});
  expect_unreadable(broken(R"("count":3)", R"("count":99999999999999999)"), {"accessors/0/count", "out of range"});
  expect_unreadable(broken(R"("count":3)", R"("count":-3)"), {"count"});
  expect_unreadable(broken(R"("bufferView":0,)", R"("bufferView":0,"byteOffset":1000000000000,)"),
                    {"accessor 0", "beyond"});
  expect_unreadable(broken(R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":37})"),
                    {"bufferView 0", "beyond"});
  expect_unreadable(broken(R"([{"byteLength":36}])", R"([{"byteLength":400}])"), {"buffer 0", "36 bytes of the 400"});
}

TEST(GltfReferences, Wrong_kinds_of_accessors_are_refused) {
  expect_unreadable(broken(R"("VEC3")", R"("VEC2")"), {"accessor 0", "2 components where 3"});
  expect_unreadable(broken("5126", "5130"), {"5130"});
  expect_unreadable(broken("5126", "5124"), {"accessor 0", "5124"});
}

TEST(GltfReferences, Cycles_and_shared_nodes_are_refused) {
  expect_unreadable(
      with_nodes(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"name":"knot","children":[0],"mesh":0}])"),
      {"node 0", "twice"});
  expect_unreadable(with_nodes(R"("scenes":[{"nodes":[0,1]}],"nodes":[{"children":[1]},{"mesh":0}])"),
                    {"node 1", "tree"});
  expect_unreadable(with_nodes(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}])"), {"node 0"});
}

TEST(GltfReferences, Of_nodes_without_a_root_one_of_the_cycle_is_named) {
  // A leaf and its parent hang on the cycle of nodes 2 and 3.
  const std::string below = R"({"name":"leaf","mesh":0},{"name":"twig","children":[0]},)";
  expect_unreadable(
      with_nodes(R"("nodes":[)" + below + R"({"name":"knot","children":[1,3]},{"name":"knot","children":[2]}])"),
      {"'knot'", "its own ancestor"});
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":0},{"name":"knot","children":[1]}])"),
                    {"node 1 'knot'", "its own ancestor"});
}

TEST(GltfValues, Positions_that_are_no_numbers_are_named) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    expect_unreadable(glb(triangle_json(), bytes_of<float>({0, 0, 0, 1, 0, 0, 0, bad, 0})),
                      {"mesh 0 'tri' primitive 0", "POSITION 2", "not a finite number"});
  }
}

TEST(GltfValues, Transforms_cameras_and_lights_must_make_sense) {
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":0,"scale":[1,2]}])"), {"node 0", "scale"});
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":0,"rotation":[0,0,0,0]}])"), {"node 0", "rotation"});
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":0,"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}])"),
                    {"node 0", "last row"});
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":0,"translation":[1e999,0,0]}])"), {"JSON"});
  expect_unreadable(
      with_nodes(
          R"("scenes":[{"nodes":[0]}],"nodes":[{"scale":[1e200,1,1],"children":[1]},{"mesh":0,"scale":[1e200,1,1]}])"),
      {"node 1", "not finite"});
  const std::string camera = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.0,"znear":0.1}}])";
  expect_unreadable(with_nodes(R"("nodes":[{"camera":0}])", camera), {"camera 0 at node 0", "yfov"});
  const std::string lens = R"("cameras":[{"type":"perspective","perspective":{"yfov":1.0,"znear":0.1}}])";
  expect_unreadable(with_nodes(R"("nodes":[{"camera":0,"scale":[0,0,0]}])", lens), {"camera 0", "no direction"});
  const std::string node = R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])";
  const auto lights = [](const std::string& light) {
    return R"("extensions":{"KHR_lights_punctual":{"lights":[)" + light + "]}}";
  };
  expect_unreadable(with_nodes(node, lights(R"({"type":"laser"})")), {"light 0 at node 0", "laser"});
  expect_unreadable(with_nodes(node, lights(R"({"type":"point","intensity":-1})")), {"light 0", "below zero"});
  expect_unreadable(with_nodes(node, lights(R"({"type":"spot","spot":{"outerConeAngle":2}})")),
                    {"light 0", "outerConeAngle"});
}

TEST(GltfExtensions, Unknown_required_ones_are_named) {
  expect_unreadable(
      with_nodes(R"("nodes":[{"mesh":0}])",
                 R"("extensionsRequired":["KHR_no_such_mesh_compression","EXT_meshopt_compression","FOO_bar"])"),
      {"KHR_no_such_mesh_compression, FOO_bar", "without them"});
}

TEST(GltfUris, References_that_leave_the_folder_are_refused) {
  const TemporaryFolder folder;
  folder.write("data.bin", triangle_positions());
  std::filesystem::create_directory(folder.path() / "inner");
  const std::string absolute = (folder.path() / "data.bin").string();
  for (const std::string& uri :
       {std::string("../data.bin"), std::string("%2e%2e/data.bin"), std::string("x/../../data.bin"), absolute,
        "file://" + absolute, std::string("http://example.com/data.bin"), std::string()}) {
    expect_unreadable(folder.write("inner/scene.gltf", triangle_json(R"("nodes":[{"mesh":0}])", "",
                                                                     R"({"uri":")" + uri + R"(","byteLength":36})")),
                      {"buffer 0", "leaves the folder"});
  }
  expect_unreadable(
      folder.write("scene.gltf", triangle_json(R"("nodes":[{"mesh":0}])", "", R"({"uri":"gone.bin","byteLength":36})")),
      {"buffer 0", "gone.bin", "beside the scene"});
  expect_unreadable(
      folder.write("scene.gltf", triangle_json(R"("nodes":[{"mesh":0}])", "", R"({"uri":"inner","byteLength":36})")),
      {"buffer 0", "inner"});
  expect_unreadable(folder.write("scene.gltf", triangle_json(R"("nodes":[{"mesh":0}])", "",
                                                             R"({"uri":"data:;base64,%%%","byteLength":3})")),
                    {"buffer 0", "base64"});
}

TEST(GltfImages, Broken_images_of_masks_are_named) {
  const auto masked = [](const std::string& more) {
    return glb(
        replaced(triangle_json(R"("nodes":[{"mesh":0}])", more), R"("attributes")", R"("material":0,"attributes")"),
        triangle_positions());
  };
  const std::string more =
      R"("materials":[{"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
      R"("textures":[{"source":0}],"images":[)";
  expect_unreadable(masked(more + R"({"name":"bark","bufferView":0}])"), {"image 0 'bark'", "PNG or JPEG"});
  expect_unreadable(masked(more + R"({"bufferView":9}])"), {"image 0", "bufferView 9"});
  expect_unreadable(masked(more + R"({}])"), {"image 0", "neither a uri"});
}

TEST(GltfJson, Bottomless_nesting_and_wrong_types_are_refused) {
  const std::string deep = R"("x":)" + std::string(100000, '[') + std::string(100000, ']');
  expect_unreadable(with_nodes(R"("nodes":[{"mesh":0}])", deep), {"levels deep"});
  for (const char* wrong : {R"("nodes":[3])", R"("nodes":[{"mesh":"0"}])", R"("nodes":[{"mesh":0.5}])"}) {
    expect_unreadable(with_nodes(wrong), {});
  }
  expect_unreadable(broken(R"("name":"tri")", R"("name":5)"), {"meshes/0/name", "not a text"});
  expect_unreadable(broken(R"("buffers":[{"byteLength":36}])", R"("buffers":{})"), {"buffers", "not a list"});
  expect_unreadable(broken(R"("buffers":[{"byteLength":36}])", R"("buffers":[{}])"), {"buffer 0", "byteLength"});
}

}  // namespace
}  // namespace umbrameter
