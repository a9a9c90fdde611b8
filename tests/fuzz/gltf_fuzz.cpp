// Any bytes as a glTF file: what comes back is a sound Scene or one line of Error. Files beside it are out of reach on
// purpose: the folder does not exist.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/error.h"
#include "scenes/gltf.h"
#include "scenes/material.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace umbrameter {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

bool is_finite(const dmat4& matrix) {
  double sum = 0.0;
  for (int column = 0; column < 4; ++column) sum += glm::dot(glm::abs(matrix[column]), dvec4(1.0));
  return std::isfinite(sum);
}

// What the rest of the toolkit takes for granted.
void check_mesh(const Scene& scene, const Mesh& mesh) {
  require(mesh.material < scene.materials.size(), "a mesh has a material of the scene");
  require(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size(), "normals: none, or one a vertex");
  require(mesh.texcoords.empty() || mesh.texcoords.size() == mesh.positions.size(),
          "texture coordinates: none, or one a vertex");
  for (const vec3& p : mesh.positions) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "positions are finite");
  }
  for (const vec3& n : mesh.normals) require(std::abs(glm::length(n) - 1.0f) < 0.01f, "normals have unit length");
  for (const vec2& t : mesh.texcoords) {
    require(std::isfinite(t.x) && std::isfinite(t.y), "texture coordinates are finite");
  }
  for (const uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) require(t[i] < mesh.positions.size(), "triangles are of the mesh's vertices");
  }
}

void check_scene(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) check_mesh(scene, mesh);
  for (const Material& material : scene.materials) {
    for (const auto member : texture_members) {
      require(!(material.*member) || *(material.*member) < scene.textures.size(),
              "a material has textures of the scene");
    }
  }
  for (const Texture& texture : scene.textures) {
    const Image<glm::u8vec4>& texels = texture.texels;
    require(!texels.empty() &&
                texels.size() == static_cast<std::size_t>(texels.width) * static_cast<std::size_t>(texels.height),
            "textures have texels");
  }
  for (const Instance& instance : scene.instances) {
    require(instance.mesh < scene.meshes.size() && instance.object < scene.objects.size(),
            "an instance is of a mesh and an object of the scene");
    require(is_finite(instance.world_from_mesh), "instances stand at finite places");
  }
  for (const Camera& camera : scene.cameras) require(is_finite(camera.world_from_camera), "cameras are finite");
  for (const Light& light : scene.lights) require(is_finite(light.world_from_light), "lights are finite");
  for (const std::string& note : scene.notes) require(note.find('\n') == std::string::npos, "notes are one line each");
  const Bounds bounds = bounds_of(scene);
  require(bounds.empty() || std::isfinite(glm::dot(glm::abs(bounds.min) + glm::abs(bounds.max), dvec3(1.0))),
          "bounds are finite");
}

// What was read can be written, and read again.
void check_round_trip(const Scene& scene, const std::filesystem::path& path) {
  const std::vector<unsigned char> bytes = to_glb(scene);
  const SceneCounts counts = count(scene);
  const SceneCounts again = count(read_gltf(bytes, path));
  require(counts.triangles == again.triangles, "a scene that was written holds what it held");
}

}  // namespace
}  // namespace umbrameter

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace umbrameter;
  const std::filesystem::path path = "folder-that-is-not-there/scene.gltf";
  // The length decides what else is tried, so that an input keeps its meaning.
  constexpr std::array parts = {"", "second", "1", "1st"};
  const std::string part = size % 8 < parts.size() ? parts[size % 8] : "";
  constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20;
  Scene scene;
  try {
    scene = read_gltf({data, size}, path, part, {.memory = most_bytes, .materials = size % 4 < 2});
  } catch (const Error& error) {
    const std::string text = error.what();
    require(error.code() == ExitCode::unreadable_input || (!part.empty() && error.code() == ExitCode::usage),
            "errors say that the input is unreadable");
    require(text.find('\n') == std::string::npos, "errors are one line");
    require(text.size() < 4000, "errors are short");
    return 0;
  }
  check_scene(scene);
  if (size % 2 == 0) check_round_trip(scene, path);
  return 0;
}
