// Hierarchies, cameras, scenes, instances, skins and morph targets.
#include <cmath>

#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

std::vector<Triangle> joined(const std::vector<std::vector<Triangle>>& parts) {
  std::vector<Triangle> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Construct with_nodes(const std::string& name, const std::vector<std::string>& nodes, std::vector<Triangle> triangles) {
  GltfBuilder builder;
  add_solid(builder);
  for (const std::string& node : nodes) add(builder, "nodes", node);
  return finished(name, builder, std::move(triangles));
}

// Translation, rotation and scale apply in the order scale, rotation, translation (section 3.5.3).
Construct by_parts() {
  const dmat4 world = translation({1, -2, 3}) * rotation({1, 2, 0.5}, 0.7) * scaling({1.5, 0.5, 2});
  return with_nodes(
      "translation, rotation and scale",
      {R"({"mesh":0,"translation":[1,-2,3],"rotation":)" + quaternion({1, 2, 0.5}, 0.7) + R"(,"scale":[1.5,0.5,2]})"},
      placed(solid(), world));
}

Construct by_matrix() {
  dmat4 world = translation({-1, 0.5, 2}) * rotation({0, 1, 1}, -1.1);
  world[1] += 0.25 * world[0];  // sheared
  return with_nodes("a matrix", {R"({"mesh":0,"matrix":)" + list_of(world) + "}"}, placed(solid(), world));
}

Construct mirrored() {
  return with_nodes("a mirrored node", {R"({"mesh":0,"scale":[-1,1,1]})"}, placed(solid(), scaling({-1, 1, 1})));
}

Construct mirrored_twice() {
  const dmat4 world = scaling({1, 1, -2}) * rotation({0, 0, 1}, 0.5) * scaling({1, -0.5, 1});
  return with_nodes("a node mirrored twice",
                    {R"({"children":[1],"scale":[1,1,-2]})",
                     R"({"mesh":0,"rotation":)" + quaternion({0, 0, 1}, 0.5) + R"(,"scale":[1,-0.5,1]})"},
                    placed(solid(), world));
}

Construct shared_mesh() {
  const dmat4 other = translation({0, 0, 3}) * scaling({1, -1, 1});
  return with_nodes("one mesh under two nodes, one of them mirrored",
                    {R"({"children":[1,2]})", R"({"mesh":0})", R"({"mesh":0,"translation":[0,0,3],"scale":[1,-1,1]})"},
                    joined({placed(solid()), placed(solid(), other)}));
}

Construct deep() {
  constexpr int levels = 300;
  std::vector<std::string> nodes;
  dmat4 world(1.0);
  const dmat4 step = translation({0.01, 0, 0}) * rotation({0, 1, 0}, 0.01);
  for (int i = 0; i < levels; ++i) {
    world = world * step;
    nodes.push_back(R"({"translation":[0.01,0,0],"rotation":)" + quaternion({0, 1, 0}, 0.01) +
                    (i + 1 < levels ? R"(,"children":[)" + std::to_string(i + 1) + "]}" : R"(,"mesh":0})"));
  }
  return with_nodes("a deep hierarchy", nodes, placed(solid(), world));
}

Construct without_scenes() {
  GltfBuilder builder;
  add_solid(builder);
  add(builder, "nodes", R"({"mesh":0,"translation":[0,1,0]})");
  Construct construct = finished("nodes without a scene", builder, placed(solid(), translation({0, 1, 0})));
  builder.lists["scenes"].clear();
  builder.lists.erase("scenes");
  builder.more.clear();
  construct.file = to_binary_gltf(builder);
  return construct;
}

// Three scenes, the second of which is the file's own.
Construct several_scenes(const std::string& name, const std::string& part, double offset) {
  GltfBuilder builder;
  add_solid(builder);
  for (const char* at : {"1", "2", "3"}) {
    add(builder, "nodes", std::string(R"({"mesh":0,"translation":[)") + at + ",0,0]}");
  }
  add(builder, "scenes", R"({"name":"first","nodes":[0]})");
  add(builder, "scenes", R"({"name":"second","nodes":[1]})");
  add(builder, "scenes", R"({"name":"third","nodes":[2]})");
  builder.more = R"(,"scene":1)";
  Construct construct = finished(name, builder, placed(solid(), translation({offset, 0, 0})));
  construct.part = part;
  return construct;
}

Construct with_camera(const std::string& name, const dmat4& parent, const dmat4& own, const std::string& lens,
                      bool is_animated) {
  GltfBuilder builder;
  add_solid(builder);
  add(builder, "cameras", R"({"type":"perspective","perspective":{"yfov":0.9,"znear":0.125)" + lens + "}}");
  add(builder, "nodes", R"({"mesh":0})");
  add(builder, "nodes", R"({"children":[2],"matrix":)" + list_of(parent) + "}");
  // The parts that an animation would move; otherwise any matrix.
  const dvec3 at(own[3]);
  add(builder, "nodes",
      R"({"camera":0,)" +
          (is_animated ? R"("translation":)" + list_of({at.x, at.y, at.z}) : R"("matrix":)" + list_of(own)) + "}");
  add(builder, "scenes", R"({"nodes":[0,1]})");
  if (is_animated) {
    const int times = add_values<float>(builder, "SCALAR", {0, 1}, R"(,"min":[0],"max":[1])");
    const int places = add_values<float>(builder, "VEC3", {9, 9, 9, 8, 8, 8});
    add(builder, "animations",
        R"({"channels":[{"sampler":0,"target":{"node":2,"path":"translation"}}],"samplers":[{"input":)" +
            std::to_string(times) + R"(,"output":)" + std::to_string(places) + "}]}");
  }
  const dmat4 world = parent * own;
  Construct construct = finished(name, builder, placed(solid()));
  construct.camera = {dvec3(world[3]), glm::normalize(-dvec3(world[2])), glm::normalize(dvec3(world[1])), lens.empty()};
  if (is_animated) construct.notes = {"animation"};
  return construct;
}

/// EXT_mesh_gpu_instancing at a node that is itself placed.
template <class T>
Construct instanced(const std::string& name, const std::string& which, const std::vector<T>& rotations,
                    const std::string& more) {
  GltfBuilder builder;
  use(builder, "EXT_mesh_gpu_instancing", true);
  add_solid(builder);
  const std::vector<dvec3> offsets = {{0, 0, 0}, {0, 3, 0}, {4, 0, -1}};
  const std::vector<dvec3> scales = {{1, 1, 1}, {0.5, 1, 2}, {-1, 1, 1}};
  // A half turn about z, a third of a turn about (1,1,1), a half turn about x.
  const std::vector<dmat4> turns = {rotation({0, 0, 1}, pi), rotation({1, 1, 1}, 2.0 * pi / 3.0),
                                    rotation({1, 0, 0}, pi)};
  std::vector<std::string> attributes;
  if (which.find('t') != std::string::npos) {
    attributes.push_back("\"TRANSLATION\":" + std::to_string(add_values(builder, "VEC3", floats(offsets))));
  }
  if (which.find('r') != std::string::npos) {
    attributes.push_back("\"ROTATION\":" + std::to_string(add_values(builder, "VEC4", rotations, more)));
  }
  if (which.find('s') != std::string::npos) {
    attributes.push_back("\"SCALE\":" + std::to_string(add_values(builder, "VEC3", floats(scales))));
  }
  add(builder, "nodes",
      R"({"mesh":0,"translation":[0,0,1],"scale":[2,1,1],"extensions":{"EXT_mesh_gpu_instancing":)"
      R"({"attributes":{)" +
          join(attributes) + "}}}}");
  std::vector<std::vector<Triangle>> parts;
  for (std::size_t i = 0; i < 3; ++i) {
    dmat4 own(1.0);
    if (which.find('t') != std::string::npos) own = own * translation(offsets[i]);
    if (which.find('r') != std::string::npos) own = own * turns[i];
    if (which.find('s') != std::string::npos) own = own * scaling(scales[i]);
    parts.push_back(placed(solid(), translation({0, 0, 1}) * scaling({2, 1, 1}) * own));
  }
  return finished(name, builder, joined(parts));
}

/// Which joint moves each corner of the solid, in shares of four: the tetrahedron's tip is torn between the two.
const std::vector<dvec2>& skin_weights() {
  static const std::vector<dvec2> weights = {{1, 0}, {0.25, 0.75}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 1}, {0, 1}, {0, 1}};
  return weights;
}

std::vector<Triangle> skinned_triangles(const std::vector<dmat4>& joints) {
  Solid moved = solid();
  for (std::size_t i = 0; i < moved.corners.size(); ++i) {
    const dmat4 matrix = skin_weights()[i].x * joints[0] + skin_weights()[i].y * joints[1];
    moved.corners[i] = dvec3(matrix * dvec4(moved.corners[i], 1.0));
  }
  return placed(moved);
}

// Section 3.7.3.3: each joint's world transform times its inverse bind matrix; that of the mesh's node has no effect.
template <class Joint, class Weight>
Construct skinned(const std::string& name, bool has_bind_matrices, double one, const std::string& more) {
  GltfBuilder builder;
  std::vector<Joint> joints;
  std::vector<Weight> weights;
  for (const dvec2& share : skin_weights()) {
    joints.insert(joints.end(), {0, 1, 0, 0});
    weights.insert(weights.end(), {static_cast<Weight>(share.x * one), static_cast<Weight>(share.y * one), 0, 0});
  }
  const int positions = add_values(builder, "VEC3", floats(solid().corners));
  const int joint_values = add_values(builder, "VEC4", joints);
  const int weight_values = add_values(builder, "VEC4", weights, more);
  add_mesh(builder,
           "\"POSITION\":" + std::to_string(positions) + ",\"JOINTS_0\":" + std::to_string(joint_values) +
               ",\"WEIGHTS_0\":" + std::to_string(weight_values),
           add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())));
  const dmat4 root = translation({0, 1, 0}) * scaling({1, 1, 1.5});
  const dmat4 tip = rotation({0, 1, 0}, 0.5) * translation({0.5, 0, 0});
  std::vector<dmat4> bind(2, dmat4(1.0));
  std::string skin = R"({"joints":[2,3])";
  if (has_bind_matrices) {
    bind = {translation({0, -0.5, 0}), scaling({1, 1, 0.5}) * translation({-1, 0, 0})};
    std::vector<float> values;
    for (const dmat4& matrix : bind) {
      for (int i = 0; i < 16; ++i) values.push_back(static_cast<float>(matrix[i / 4][i % 4]));
    }
    skin += ",\"inverseBindMatrices\":" + std::to_string(add_values(builder, "MAT4", values));
  }
  add(builder, "skins", skin + "}");
  add(builder, "nodes", R"({"children":[1,2]})");
  add(builder, "nodes", R"({"mesh":0,"skin":0,"translation":[50,60,70]})");
  add(builder, "nodes", R"({"children":[3],"matrix":)" + list_of(root) + "}");
  add(builder, "nodes", R"({"matrix":)" + list_of(tip) + "}");
  Construct construct = finished(name, builder, skinned_triangles({root * bind[0], root * tip * bind[1]}));
  construct.notes = {"skin"};
  return construct;
}

// Normals follow the inverse transpose of the joint's matrix: those of flat triangles stay across them.
Construct skinned_normals() {
  GltfBuilder builder;
  const Solid split = split_solid();
  const std::size_t count = split.corners.size();
  std::vector<std::uint8_t> joints(4 * count, 0);
  std::vector<float> weights(4 * count, 0.0f);
  for (std::size_t i = 0; i < count; ++i) weights[4 * i] = 1.0f;
  const int positions = add_values(builder, "VEC3", floats(split.corners));
  const int normals = add_values(builder, "VEC3", floats(flat_normals(split)));
  const int joint_values = add_values(builder, "VEC4", joints);
  const int weight_values = add_values(builder, "VEC4", weights);
  add_mesh(builder, "\"POSITION\":" + std::to_string(positions) + ",\"NORMAL\":" + std::to_string(normals) +
                        ",\"JOINTS_0\":" + std::to_string(joint_values) +
                        ",\"WEIGHTS_0\":" + std::to_string(weight_values));
  const dmat4 joint = translation({1, 0, 0}) * rotation({1, 1, 0}, 0.8) * scaling({1, 3, 0.5});
  add(builder, "skins", R"({"joints":[1]})");
  add(builder, "nodes", R"({"mesh":0,"skin":0,"children":[1]})");
  add(builder, "nodes", R"({"matrix":)" + list_of(joint) + "}");
  Construct construct = finished("a skin with normals", builder, placed(split, joint));
  construct.flat_normals = true;
  construct.notes = {"skin"};
  return construct;
}

// Section 3.7.2.2: base + sum of weights times displacements; weights of the node go before those of the mesh.
Construct morphed(const std::string& name, const std::vector<double>& mesh_weights,
                  const std::vector<double>& node_weights, bool is_sparse) {
  GltfBuilder builder;
  const dvec3 tip_move(0.5, 1, -0.25);
  const dvec3 corner_move(0, 0.75, 1);
  const auto target = [&](std::size_t corner, const dvec3& move) {
    if (is_sparse) {
      const int where = add_view(builder, raw_bytes<std::uint8_t>({static_cast<std::uint8_t>(corner)}));
      const int values = add_view(builder, raw_bytes(floats({move})));
      return add_accessor(builder, -1, "f32", "VEC3", 8,
                          R"(,"sparse":{"count":1,"indices":{"bufferView":)" + std::to_string(where) +
                              R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}");
    }
    std::vector<dvec3> moves(8, dvec3(0.0));
    moves[corner] = move;
    return add_values(builder, "VEC3", floats(moves));
  };
  const int first = target(3, tip_move);
  const int second = target(6, corner_move);
  add_solid(builder, R"(,"targets":[{"POSITION":)" + std::to_string(first) + R"(},{"POSITION":)" +
                         std::to_string(second) + "}]");
  std::string& mesh = builder.lists["meshes"].front();
  if (!mesh_weights.empty()) mesh = R"({"weights":)" + list_of(mesh_weights) + "," + mesh.substr(1);
  add(builder, "nodes", R"({"mesh":0)" + (node_weights.empty() ? "" : ",\"weights\":" + list_of(node_weights)) + "}");
  const std::vector<double> none = {0, 0};
  const std::vector<double>& used = !node_weights.empty() ? node_weights : (mesh_weights.empty() ? none : mesh_weights);
  Solid moved = solid();
  moved.corners[3] += used[0] * tip_move;
  moved.corners[6] += used[1] * corner_move;
  Construct construct = finished(name, builder, placed(moved));
  construct.notes = {"morph"};
  return construct;
}

}  // namespace

std::vector<Construct> node_constructs() {
  const dmat4 turned = translation({1, 2, 3}) * rotation({0, 1, 0}, 0.6);
  const dmat4 own = translation({0.5, 0, 2}) * rotation({1, 0, 0}, -0.3);
  return {by_parts(),
          by_matrix(),
          mirrored(),
          mirrored_twice(),
          shared_mesh(),
          deep(),
          without_scenes(),
          several_scenes("the scene that the file chooses", "", 2),
          several_scenes("a scene by name", "third", 3),
          several_scenes("a scene by number", "0", 1),
          with_camera("a camera without a far plane", turned, own, "", false),
          with_camera("a camera under a scaled node", turned * scaling({3, 3, 3}), own, R"(,"zfar":50)", false),
          with_camera("a camera under a mirrored node", turned * scaling({-2, 2, 2}), own, R"(,"zfar":50)", false),
          with_camera("a camera at an animated node", turned, translation({0.5, 0, 2}), R"(,"zfar":50)", true)};
}

std::vector<Construct> instancing_constructs() {
  const std::string normalized = ",\"normalized\":true";
  // The turns of instanced(). Halves of equal length are halves again once the quaternion is normalised.
  return {instanced<float>("instances by translation", "t", {}, ""),
          instanced<float>("instances by rotation and scale", "rs", {0, 0, 1, 0, 0.5, 0.5, 0.5, 0.5, 1, 0, 0, 0}, ""),
          instanced<float>("instances by all three", "trs", {0, 0, 1, 0, 0.5, 0.5, 0.5, 0.5, 1, 0, 0, 0}, ""),
          instanced<std::int8_t>("instances with rotations of bytes", "tr",
                                 {0, 0, 127, 0, 64, 64, 64, 64, 127, 0, 0, 0}, normalized),
          instanced<std::int16_t>("instances with rotations of shorts", "trs",
                                  {0, 0, 32767, 0, 16384, 16384, 16384, 16384, 32767, 0, 0, 0}, normalized)};
}

std::vector<Construct> deformed_constructs() {
  return {skinned<std::uint8_t, float>("a skin", true, 1.0, ""),
          skinned<std::uint16_t, float>("a skin without bind matrices", false, 1.0, ""),
          skinned<std::uint8_t, std::uint16_t>("a skin with weights of shorts", true, 65532.0, ",\"normalized\":true"),
          skinned_normals(),
          morphed("morph targets without weights", {}, {}, false),
          morphed("morph targets with weights of the mesh", {0.5, 1}, {}, false),
          morphed("morph targets with weights of the node", {1, 1}, {0.25, -0.5}, false),
          morphed("sparse morph targets", {0.5, 0.75}, {}, true)};
}

}  // namespace umbrameter::test
