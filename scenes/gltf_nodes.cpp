#include "scenes/gltf_nodes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "scenes/gltf_emitter.h"
#include "scenes/selection.h"

namespace umbrameter::gltf {
namespace {

constexpr const char* instancing_name = "EXT_mesh_gpu_instancing";

dmat4 turned(const dvec4& q) {
  dmat4 matrix(1.0);
  matrix[0] = {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y), 0};
  matrix[1] = {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x), 0};
  matrix[2] = {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y), 0};
  return matrix;
}

// glTF 2.0, section 3.5.3: a matrix, or scale, then rotation, then translation.
dmat4 local_transform(const tinygltf::Node& node, const Document& document, const std::string& object) {
  const auto numbers = [&](const std::vector<double>& given, std::size_t size, const char* what) {
    const bool finite = std::ranges::all_of(given, [](double value) { return std::isfinite(value); });
    if (!given.empty() && (given.size() != size || !finite)) {
      fail(document.path, object, std::string("its ") + what + " is not " + std::to_string(size) + " finite numbers");
    }
    return !given.empty();
  };
  dmat4 local(1.0);
  if (numbers(node.matrix, 16, "matrix")) {
    for (std::size_t i = 0; i < 16; ++i) local[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = node.matrix[i];
    const dvec4 last_row(local[0][3], local[1][3], local[2][3], local[3][3]);
    constexpr double rounding = 1e-6;
    if (!(glm::distance(last_row, dvec4(0, 0, 0, 1)) <= rounding)) {
      fail(document.path, object, "the last row of its matrix is not 0 0 0 1");
    }
    for (int column = 0; column < 4; ++column) {
      const double exact = column == 3 ? 1.0 : 0.0;
      if (local[column][3] != exact) local[column][3] = exact;  // a −0 stays
    }
    return local;
  }
  if (numbers(node.rotation, 4, "rotation")) {
    const dvec4 given(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
    const double length = glm::length(given);
    if (!(length > 1e-6)) fail(document.path, object, "its rotation has no length");
    local = turned(given / length);
  }
  if (numbers(node.scale, 3, "scale")) {
    for (int i = 0; i < 3; ++i) local[i] *= node.scale[static_cast<std::size_t>(i)];
  }
  if (numbers(node.translation, 3, "translation")) {
    local[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
  }
  return local;
}

std::size_t chosen_scene(const Document& document, const std::string& part) {
  const std::vector<tinygltf::Scene>& scenes = document.model->scenes;
  const std::vector<std::size_t> found = select_items(scenes, part);
  if (found.size() == 1) return found.front();
  std::string listed;
  for (std::size_t i = 0; i < scenes.size() && i < 24; ++i) {
    listed += (i == 0 ? "" : ", ") + label("scene", i, scenes[i].name);
  }
  throw Error(ExitCode::usage, "--scene " + part,
              found.empty() ? "the file has no such scene" : std::to_string(found.size()) + " scenes have this name",
              listed.empty() ? "omit --scene" : "it has " + listed + ": give an index or a unique name");
}

std::vector<int> parentless_nodes(const tinygltf::Model& model) {
  std::set<int> children;
  for (const tinygltf::Node& node : model.nodes) {
    children.insert(node.children.begin(), node.children.end());
  }
  std::vector<int> roots;
  for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
    if (!children.contains(i)) roots.push_back(i);
  }
  return roots;
}

std::vector<int> root_nodes(const Document& document, const std::string& part, std::string& scene_name) {
  const tinygltf::Model& model = *document.model;
  if (!model.scenes.empty() || !part.empty() || model.defaultScene != -1) {
    const int preset = model.defaultScene == -1 ? 0 : model.defaultScene;
    const std::size_t chosen = part.empty() ? static_cast<std::size_t>(preset) : chosen_scene(document, part);
    if (chosen >= model.scenes.size()) {
      fail(document.path, "scene",
           "it is " + std::to_string(preset) + ", but the file has " + std::to_string(model.scenes.size()) + " scenes");
    }
    scene_name = model.scenes[chosen].name;
    return model.scenes[chosen].nodes;
  }
  return parentless_nodes(model);
}

// A node that is its own ancestor, of those that have no ancestor without a parent.
std::size_t on_cycle_above(const tinygltf::Model& model, std::size_t node) {
  std::vector<std::size_t> parents(model.nodes.size(), node);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const int child : model.nodes[i].children) {
      if (child >= 0 && static_cast<std::size_t>(child) < parents.size()) parents[static_cast<std::size_t>(child)] = i;
    }
  }
  // As many steps up as there are nodes end on the cycle.
  for (std::size_t step = 0; step < model.nodes.size(); ++step) node = parents[node];
  return node;
}

bool is_finite(const dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    if (!std::isfinite(glm::dot(matrix[column], dvec4(1.0)))) return false;
  }
  return true;
}

/// A node and where it stands.
struct Placed {
  std::size_t node = 0;
  dmat4 world{1.0};
  bool is_hidden = false;  ///< it or an ancestor is, by KHR_node_visibility
};

bool hides_itself(const tinygltf::Node& node) {
  const auto extension = node.extensions.find("KHR_node_visibility");
  return extension != node.extensions.end() && extension->second.Has("visible") &&
         !extension->second.Get("visible").Get<bool>();
}

// Depth first, parents before children, in file order; without recursion, so that no chain of nodes is too long.
std::vector<Placed> place_nodes(const Document& document, const std::string& part, std::string& scene_name) {
  struct Open {
    int node = 0;
    std::ptrdiff_t parent = -1;  ///< in placed
  };
  const tinygltf::Model& model = *document.model;
  std::vector<char> visited(model.nodes.size(), 0);
  std::vector<Open> open;
  std::vector<Placed> placed;
  const auto push = [&](const std::vector<int>& nodes, std::ptrdiff_t parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open.push_back({*node, parent});
  };
  push(root_nodes(document, part, scene_name), -1);
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    const std::size_t index = checked_index(next.node, model.nodes.size(), "node", document.path, "scene graph");
    const tinygltf::Node& node = model.nodes[index];
    const std::string object = label("node", index, node.name);
    if (visited[index] != 0) {
      fail(document.path, object, "it is reached twice: nodes must form a tree without cycles");
    }
    visited[index] = 1;
    const dmat4 local = local_transform(node, document, object);
    const Placed root;
    const Placed& parent = next.parent < 0 ? root : placed[static_cast<std::size_t>(next.parent)];
    const dmat4 world = next.parent < 0 ? local : parent.world * local;
    const bool is_hidden = parent.is_hidden || hides_itself(node);
    if (!is_finite(world)) fail(document.path, object, "its world transform is not finite");
    push(node.children, static_cast<std::ptrdiff_t>(placed.size()));
    placed.push_back({index, world, is_hidden});
  }
  // Without scenes every node belongs to the one that there is; those of a cycle, and below it, have no root to be
  // reached from.
  if (model.scenes.empty() && placed.size() < model.nodes.size()) {
    const auto left = static_cast<std::size_t>(std::ranges::find(visited, 0) - visited.begin());
    const std::size_t index = on_cycle_above(model, left);
    fail(document.path, label("node", index, model.nodes[index].name),
         "it is its own ancestor: nodes must form a tree without cycles");
  }
  return placed;
}

struct NodeReader {
  GeometryReader& geometry;
  const std::vector<Placed>& placed;
  std::vector<std::optional<std::size_t>> place_of_node;  ///< indices into placed
  std::uint64_t flattened = 0;
  std::uint64_t hidden = 0;
  bool has_skins = false;

  const Document& document() const { return geometry.store.document; }
  const tinygltf::Model& model() const { return *document().model; }

  // EXT_mesh_gpu_instancing: translation, rotation and scale of each instance, within the node.
  std::vector<dmat4> instances_of(const tinygltf::Node& node, const std::string& object) {
    const tinygltf::Value& extension = node.extensions.at(instancing_name);
    std::vector<vec3> translations;
    std::vector<vec4> rotations;
    std::vector<vec3> scales;
    std::size_t count = 0;
    if (extension.Has("attributes")) {
      const tinygltf::Value& attributes = extension.Get("attributes");
      const auto read = [&]<class Vector>(const char* name, std::vector<Vector>& values) {
        if (!attributes.Has(name)) return;
        values = read_elements<Vector>(geometry.store, attributes.Get(name).GetNumberAsInt(), object + " " + name);
        if (count != 0 && values.size() != count) {
          fail(document().path, object, std::string(instancing_name) + " has attributes of unequal length");
        }
        count = values.size();
      };
      read("TRANSLATION", translations);
      read("ROTATION", rotations);
      read("SCALE", scales);
    }
    if (count == 0) fail(document().path, object, std::string(instancing_name) + " has no attributes");
    claim(geometry.store.allowance, count * sizeof(dmat4), document().path, object);
    std::vector<dmat4> all(count, dmat4(1.0));
    for (std::size_t i = 0; i < count; ++i) {
      if (!rotations.empty()) {
        const dvec4 q(rotations[i]);
        const double length = glm::length(q);
        if (!(length > 1e-6)) fail(document().path, object, "ROTATION " + std::to_string(i) + " has no length");
        all[i] = turned(q / length);
      }
      for (int c = 0; c < 3 && !scales.empty(); ++c) all[i][c] *= static_cast<double>(scales[i][c]);
      if (!translations.empty()) all[i][3] = dvec4(dvec3(translations[i]), 1.0);
      if (!is_finite(all[i])) fail(document().path, object, "instance " + std::to_string(i) + " is not finite");
    }
    return all;
  }

  // glTF 2.0, section 3.7.3: the node's own transform has no effect on a skinned mesh.
  std::vector<dmat4> joint_matrices(const tinygltf::Node& node, const std::string& object) {
    const std::size_t index = checked_index(node.skin, model().skins.size(), "skin", document().path, object);
    const tinygltf::Skin& skin = model().skins[index];
    const std::string name = label("skin", index, skin.name) + " of " + object;
    std::vector<mat4> bind;
    if (skin.inverseBindMatrices != -1) bind = read_elements<mat4>(geometry.store, skin.inverseBindMatrices, name);
    if (skin.joints.empty()) fail(document().path, name, "it has no joints");
    if (!bind.empty() && bind.size() < skin.joints.size()) {
      fail(document().path, name,
           "it has " + std::to_string(bind.size()) + " inverse bind matrices for " +
               std::to_string(skin.joints.size()) + " joints");
    }
    std::vector<dmat4> matrices;
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const std::size_t joint = checked_index(skin.joints[i], model().nodes.size(), "node", document().path, name);
      if (!place_of_node[joint]) {
        fail(document().path, name, "its joint, " + label("node", joint, "") + ", is not part of the scene");
      }
      const dmat4& world = placed[*place_of_node[joint]].world;
      matrices.push_back(bind.empty() ? world : world * dmat4(bind[i]));
      if (!is_finite(matrices.back())) fail(document().path, name, "joint " + std::to_string(i) + " is not finite");
    }
    return matrices;
  }

  void add_mesh(const tinygltf::Node& node, const dmat4& world, const std::string& object) {
    const std::size_t mesh = checked_index(node.mesh, model().meshes.size(), "mesh", document().path, object);
    const bool is_skinned = node.skin != -1;
    has_skins |= is_skinned;
    const std::vector<std::uint32_t> parts =
        is_skinned ? read_skinned_mesh(geometry, mesh, node.weights, joint_matrices(node, object), object)
                   : read_mesh(geometry, mesh, node.weights);
    if (parts.empty()) return;
    std::vector<dmat4> places = {is_skinned ? dmat4(1.0) : world};
    if (!is_skinned && node.extensions.contains(instancing_name)) {
      places = instances_of(node, object);
      for (dmat4& place : places) place = world * place;
    }
    const std::size_t whole = places.size();
    std::erase_if(places, [](const dmat4& place) { return glm::determinant(dmat3(place)) == 0.0; });
    flattened += whole - places.size();
    if (places.empty()) return;
    Scene& scene = geometry.scene;
    const auto number = static_cast<std::uint32_t>(scene.objects.size());
    const std::string& mesh_name = model().meshes[mesh].name;
    const std::string fallback = mesh_name.empty() ? "object " + std::to_string(number) : mesh_name;
    const std::string& name = node.name.empty() ? fallback : node.name;
    claim(geometry.store.allowance, sizeof(Object) + name.size() + parts.size() * places.size() * sizeof(Instance),
          document().path, object);
    scene.objects.push_back({name});
    for (const std::uint32_t part : parts) {
      for (const dmat4& place : places) scene.instances.push_back({part, number, place});
    }
  }

  void read(const Placed& at) {
    const tinygltf::Node& node = model().nodes[at.node];
    const std::string object = label("node", at.node, node.name);
    Scene& scene = geometry.scene;
    if (at.is_hidden && (node.mesh != -1 || node.extensions.contains("KHR_lights_punctual"))) ++hidden;
    if (node.mesh != -1 && !at.is_hidden) add_mesh(node, at.world, object);
    if (node.camera != -1) {
      const std::size_t index = checked_index(node.camera, model().cameras.size(), "camera", document().path, object);
      const tinygltf::Camera& camera = model().cameras[index];
      scene.cameras.push_back(
          read_camera(camera, node.name, at.world, document(), label("camera", index, camera.name) + " at " + object));
    }
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end() || at.is_hidden) return;
    const bool usable = extension->second.Has("light") && extension->second.Get("light").IsInt();
    const int number = usable ? extension->second.Get("light").GetNumberAsInt() : -1;
    const std::size_t index = checked_index(number, model().lights.size(), "light", document().path, object);
    const tinygltf::Light& light = model().lights[index];
    const std::string name = label("light", index, light.name) + " at " + object;
    Light& placed_light = scene.lights.emplace_back(read_light(light, at.world, document(), name, scene.notes));
    if (placed_light.name.empty()) placed_light.name = node.name;
    placed_light.emitter = read_emitter(light.extras, node.extras, placed_light, document(), name, scene.notes);
  }
};

// Meshes in the order of the file, whatever the order of the nodes. One that no node of the file shows is kept where it
// can be read, and must not refuse a file of which nothing else needs it.
void read_meshes(GeometryReader& geometry, const std::vector<Placed>& placed) {
  const Document& document = geometry.store.document;
  const tinygltf::Model& model = *document.model;
  std::set<int> shown;
  std::set<int> referenced;
  for (const Placed& at : placed) {
    const tinygltf::Node& node = model.nodes[at.node];
    if (node.skin == -1 && node.weights.empty() && !at.is_hidden) shown.insert(node.mesh);
  }
  for (const tinygltf::Node& node : model.nodes) referenced.insert(node.mesh);
  for (std::size_t mesh = 0; mesh < model.meshes.size(); ++mesh) {
    const int number = static_cast<int>(mesh);
    if (shown.contains(number)) {
      read_mesh(geometry, mesh, {});
    } else if (!referenced.contains(number)) {
      try {
        read_mesh(geometry, mesh, {});
      } catch (const Error& error) {
        geometry.scene.notes.push_back(label("mesh", mesh, model.meshes[mesh].name) +
                                       ", which no node shows, was left out: " + error.what());
      }
    }
  }
}

}  // namespace

void read_nodes(GeometryReader& geometry, const std::string& part) {
  const Document& document = geometry.store.document;
  const tinygltf::Model& model = *document.model;
  const std::vector<Placed> placed = place_nodes(document, part, geometry.scene.name);
  NodeReader reader{geometry, placed, {}};
  reader.place_of_node.resize(model.nodes.size());
  for (std::size_t i = 0; i < placed.size(); ++i) reader.place_of_node[placed[i].node] = i;
  read_meshes(geometry, placed);
  for (const Placed& at : placed) reader.read(at);
  std::vector<std::string>& notes = geometry.scene.notes;
  if (reader.flattened != 0) {
    notes.push_back(std::to_string(reader.flattened) + " objects scaled to nothing were left out");
  }
  if (reader.hidden != 0) {
    notes.push_back(std::to_string(reader.hidden) + " nodes with a mesh or a light are hidden and were left out");
  }
  if (reader.has_skins) notes.emplace_back("skins stay in their rest pose: animations have no effect");
}

}  // namespace umbrameter::gltf
