#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "scenes/gltf.h"
#include "scenes/gltf_geometry.h"

namespace umbrameter {
namespace {

using gltf::Document;
using gltf::fail;

constexpr std::array<std::string_view, 3> known_extensions = {"EXT_meshopt_compression", "KHR_lights_punctual",
                                                              "KHR_mesh_quantization"};

std::vector<std::string> unknown_of(const std::vector<std::string>& extensions) {
  std::vector<std::string> unknown;
  for (const std::string& name : extensions) {
    if (std::find(known_extensions.begin(), known_extensions.end(), name) == known_extensions.end()) {
      unknown.push_back(name);
    }
  }
  return unknown;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void check_extensions(const Document& document, std::vector<std::string>& notes) {
  if (const auto required = unknown_of(document.model->extensionsRequired); !required.empty()) {
    fail(document.path, "extensionsRequired", "it needs " + joined(required) + ", which are not supported",
         "export it without them, or convert it (gltf-transform copy with plain accessors)");
  }
  if (const auto used = unknown_of(document.model->extensionsUsed); !used.empty()) {
    notes.push_back("extensions without effect here: " + joined(used));
  }
}

std::string label(const char* kind, int index, const std::string& name) {
  return std::string(kind) + " " + std::to_string(index) + (name.empty() ? "" : " '" + name + "'");
}

// glTF 2.0, section 3.5.3: a matrix, or scale, then rotation, then translation.
dmat4 local_transform(const tinygltf::Node& node, const Document& document, const std::string& object) {
  const auto numbers = [&](const std::vector<double>& given, std::size_t size, const char* what) {
    const bool finite = std::all_of(given.begin(), given.end(), [](double value) { return std::isfinite(value); });
    if (!given.empty() && (given.size() != size || !finite)) {
      fail(document.path, object, std::string("its ") + what + " is not " + std::to_string(size) + " finite numbers");
    }
    return !given.empty();
  };
  dmat4 local(1.0);
  if (numbers(node.matrix, 16, "matrix")) {
    for (std::size_t i = 0; i < 16; ++i) local[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = node.matrix[i];
    if (local[0][3] != 0.0 || local[1][3] != 0.0 || local[2][3] != 0.0 || local[3][3] != 1.0) {
      fail(document.path, object, "the last row of its matrix is not 0 0 0 1");
    }
    return local;
  }
  if (numbers(node.rotation, 4, "rotation")) {
    const dvec4 given(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
    const double length = glm::length(given);
    if (!(length > 1e-6)) fail(document.path, object, "its rotation has no length");
    const dvec4 q = given / length;
    local[0] = {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y), 0};
    local[1] = {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x), 0};
    local[2] = {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y), 0};
  }
  if (numbers(node.scale, 3, "scale")) {
    for (int i = 0; i < 3; ++i) local[i] *= node.scale[static_cast<std::size_t>(i)];
  }
  if (numbers(node.translation, 3, "translation")) {
    local[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
  }
  return local;
}

// Without scale, shear and mirroring; keeps the viewing axis −Z, then the side of +Y. A rigid one stays bit for bit.
dmat4 rigid(const dmat4& transform, const Document& document, const std::string& object) {
  const dmat3 axes(transform);
  const dmat3 gram = glm::transpose(axes) * axes;
  double off = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) off = std::max(off, std::abs(gram[column][row] - (column == row ? 1.0 : 0.0)));
  }
  if (off < 1e-12 && glm::determinant(axes) > 0.0) return transform;
  const dvec3 z = glm::normalize(axes[2]);
  const dvec3 x = glm::normalize(glm::cross(glm::normalize(axes[1]), z));
  const dvec3 y = glm::cross(z, x);
  const double sum = glm::dot(x + y + z, dvec3(1.0));
  if (!std::isfinite(sum)) fail(document.path, object, "its transform leaves no direction", "undo the zero scale");
  return {dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), transform[3]};
}

Camera read_camera(const tinygltf::Camera& source, const std::string& node_name, const dmat4& transform,
                   const Document& document, const std::string& object) {
  Camera camera;
  camera.name = source.name.empty() ? node_name : source.name;
  camera.world_from_camera = rigid(transform, document, object);
  if (source.type == "orthographic") {
    const tinygltf::OrthographicCamera& lens = source.orthographic;
    if (!(lens.xmag != 0.0 && lens.ymag != 0.0 && lens.znear >= 0.0 && lens.zfar > lens.znear)) {
      fail(document.path, object, "an orthographic camera needs xmag and ymag, and zfar > znear >= 0");
    }
    camera.projection = OrthographicProjection{std::abs(lens.xmag), std::abs(lens.ymag), lens.znear, lens.zfar};
    return camera;
  }
  const tinygltf::PerspectiveCamera& lens = source.perspective;
  PerspectiveProjection projection{lens.yfov, lens.znear};
  if (lens.zfar != 0.0) projection.far_plane = lens.zfar;
  if (!(lens.yfov > 0.0 && lens.yfov < pi && lens.znear > 0.0 && projection.far_plane > lens.znear)) {
    fail(document.path, object, "a perspective camera needs 0 < yfov < pi, and zfar > znear > 0");
  }
  camera.projection = projection;
  return camera;
}

Light read_light(const tinygltf::Light& source, const dmat4& transform, const Document& document,
                 const std::string& object, std::vector<std::string>& notes) {
  Light light;
  light.name = source.name;
  light.world_from_light = rigid(transform, document, object);
  if (!source.color.empty()) {
    if (source.color.size() < 3) fail(document.path, object, "its color is not three numbers");
    for (int i = 0; i < 3; ++i) light.color[i] = static_cast<float>(source.color[static_cast<std::size_t>(i)]);
  }
  light.intensity = source.intensity;
  const bool bright = light.intensity >= 0.0 && light.color.x >= 0.0f && light.color.y >= 0.0f && light.color.z >= 0.0f;
  if (!bright || !(source.range >= 0.0)) fail(document.path, object, "its color, intensity or range is below zero");
  const double range = std::isfinite(source.range) ? source.range : 0.0;
  if (source.type == "directional") {
    light.shape = DirectionalLight{};
  } else if (source.type == "point") {
    light.shape = PointLight{range};
  } else if (source.type == "spot") {
    SpotLight spot{range, source.spot.innerConeAngle, source.spot.outerConeAngle};
    if (!(spot.outer_cone_angle > 0.0 && spot.outer_cone_angle < 0.5 * pi + 1e-6 && spot.inner_cone_angle >= 0.0)) {
      fail(document.path, object, "a spot light needs 0 <= innerConeAngle < outerConeAngle <= pi/2");
    }
    if (spot.inner_cone_angle > spot.outer_cone_angle) {
      notes.push_back(object + ": its innerConeAngle was lowered to its outerConeAngle");
      spot.inner_cone_angle = spot.outer_cone_angle;
    }
    light.shape = spot;
  } else {
    fail(document.path, object, "unknown light type '" + source.type + "'");
  }
  return light;
}

struct Placement {
  int node = 0;
  std::optional<dmat4> world_from_parent;
};

struct NodeReader {
  const Document& document;
  const gltf::Geometry& geometry;
  Scene& scene;
  std::uint64_t flattened = 0;

  void check_index(int index, std::size_t size, const std::string& object, const char* kind) const {
    if (index >= 0 && static_cast<std::size_t>(index) < size) return;
    fail(document.path, object,
         "it refers to " + std::string(kind) + " " + std::to_string(index) + ", but the file has " +
             std::to_string(size));
  }

  void add_mesh(int mesh, const std::string& node_name, const dmat4& transform, const std::string& object) {
    check_index(mesh, geometry.meshes_of.size(), object, "mesh");
    const auto& parts = geometry.meshes_of[static_cast<std::size_t>(mesh)];
    if (parts.empty()) return;
    if (glm::determinant(dmat3(transform)) == 0.0) {
      ++flattened;
      return;
    }
    const auto number = static_cast<std::uint32_t>(scene.objects.size());
    const std::string& mesh_name = geometry.names[static_cast<std::size_t>(mesh)];
    const std::string fallback = mesh_name.empty() ? "object " + std::to_string(number) : mesh_name;
    scene.objects.push_back({node_name.empty() ? fallback : node_name});
    for (const std::uint32_t part : parts) scene.instances.push_back({part, number, transform});
  }

  void read(const tinygltf::Node& node, const dmat4& transform, const std::string& object) {
    const tinygltf::Model& model = *document.model;
    for (int column = 0; column < 4; ++column) {
      const double sum = glm::dot(transform[column], dvec4(1.0));
      if (!std::isfinite(sum)) fail(document.path, object, "its world transform is not finite");
    }
    if (node.mesh != -1) add_mesh(node.mesh, node.name, transform, object);
    if (node.camera != -1) {
      check_index(node.camera, model.cameras.size(), object, "camera");
      const tinygltf::Camera& camera = model.cameras[static_cast<std::size_t>(node.camera)];
      scene.cameras.push_back(read_camera(camera, node.name, transform, document,
                                          label("camera", node.camera, camera.name) + " at " + object));
    }
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end()) return;
    const bool usable = extension->second.Has("light") && extension->second.Get("light").IsInt();
    const int index = usable ? extension->second.Get("light").GetNumberAsInt() : -1;
    check_index(index, model.lights.size(), object, "light");
    const tinygltf::Light& light = model.lights[static_cast<std::size_t>(index)];
    scene.lights.push_back(
        read_light(light, transform, document, label("light", index, light.name) + " at " + object, scene.notes));
  }
};

// An exact name wins over an index, as with cameras and lights.
std::size_t chosen_scene(const Document& document, const std::string& part) {
  const std::vector<tinygltf::Scene>& scenes = document.model->scenes;
  std::vector<std::size_t> named;
  std::string listed;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (scenes[i].name == part) named.push_back(i);
    if (i < 24) listed += (i == 0 ? "" : ", ") + label("", static_cast<int>(i), scenes[i].name).substr(1);
  }
  if (named.size() == 1) return named.front();
  std::size_t index = 0;
  const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (status == std::errc() && end == part.data() + part.size() && index < scenes.size()) return index;
  throw Error(ExitCode::usage, "--scene " + part,
              named.empty() ? "the file has no such scene" : std::to_string(named.size()) + " scenes have this name",
              listed.empty() ? "leave --scene away" : "it has " + listed + ": give an index or a unique name");
}

std::vector<int> root_nodes(const Document& document, const std::string& part, std::string& scene_name) {
  const tinygltf::Model& model = *document.model;
  if (!model.scenes.empty() || !part.empty()) {
    const int preset = model.defaultScene == -1 ? 0 : model.defaultScene;
    const std::size_t chosen = part.empty() ? static_cast<std::size_t>(preset) : chosen_scene(document, part);
    if (chosen >= model.scenes.size()) {
      fail(document.path, "scene",
           "it is " + std::to_string(preset) + ", but the file has " + std::to_string(model.scenes.size()) + " scenes");
    }
    scene_name = model.scenes[chosen].name;
    return model.scenes[chosen].nodes;
  }
  std::vector<char> is_child(model.nodes.size(), 0);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = 1;
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (is_child[i] == 0) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

// Depth first, parents before children, in file order; without recursion, so that no chain of nodes is too long.
void read_nodes(const Document& document, const gltf::Geometry& geometry, const std::string& part, Scene& scene) {
  const tinygltf::Model& model = *document.model;
  std::vector<char> visited(model.nodes.size(), 0);
  std::vector<Placement> open;
  const auto push = [&](const std::vector<int>& nodes, const std::optional<dmat4>& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open.push_back({*node, parent});
  };
  push(root_nodes(document, part, scene.name), std::nullopt);
  NodeReader reader{document, geometry, scene};
  while (!open.empty()) {
    const Placement placed = open.back();
    open.pop_back();
    reader.check_index(placed.node, model.nodes.size(), "scene graph", "node");
    const auto index = static_cast<std::size_t>(placed.node);
    const tinygltf::Node& node = model.nodes[index];
    const std::string object = label("node", placed.node, node.name);
    if (visited[index] != 0) {
      fail(document.path, object, "it is reached twice: nodes must form a tree without cycles");
    }
    visited[index] = 1;
    const dmat4 local = local_transform(node, document, object);
    const dmat4 world = placed.world_from_parent ? *placed.world_from_parent * local : local;
    reader.read(node, world, object);
    push(node.children, world);
  }
  if (reader.flattened != 0) {
    scene.notes.push_back(std::to_string(reader.flattened) + " objects scaled to nothing were left out");
  }
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const std::string& part) {
  const gltf::Bytes bytes = gltf::read_file(path, "");
  return read_gltf(bytes, path, part);
}

Scene read_gltf(std::span<const unsigned char> bytes, const std::filesystem::path& path, const std::string& part) {
  const Document document = gltf::parse_document(path, gltf::split_container(bytes, path));
  Scene scene;
  check_extensions(document, scene.notes);
  gltf::BufferStore store = gltf::make_buffer_store(document);
  gltf::read_materials(store, scene);
  const gltf::Geometry geometry = gltf::read_geometry(store, scene);
  read_nodes(document, geometry, part, scene);
  if (scene.name.empty()) scene.name = path.stem().string();
  if (document.is_animated) scene.notes.emplace_back("animations and skins have no effect: the rest pose is used");
  return scene;
}

}  // namespace umbrameter
