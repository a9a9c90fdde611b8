// Writes the seed corpus of gltf_fuzz: every construct, small broken files, and a small scene of our own writer.
// usage: gltf_seeds FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "scenes/gltf.h"
#include "tests/support/gltf_constructs.h"
#include "tests/support/gltf_hostile.h"
#include "tests/support/shapes.h"

namespace {

using umbrameter::test::Bytes;

void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

umbrameter::Scene small_scene() {
  using namespace umbrameter;
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}));
  shapes::add_mesh(scene, shapes::box({0, 0, 0}, {1, 1, 1}));
  scene.meshes[0].name = "floor";
  scene.instances.push_back(scene.instances.back());
  Texture texture;
  texture.name = "checks";
  texture.texels = Image<glm::u8vec4>(2, 2, glm::u8vec4(9));
  texture.wrap_u = Wrap::mirrored_repeat;
  scene.textures.push_back(texture);
  scene.materials[0].base_color_texture = 0;
  scene.materials[0].alpha_mode = AlphaMode::mask;
  scene.lights = {shapes::directional({1, 2, 3}), Light{}, Light{}};
  scene.lights[1].shape = SpotLight{5.0, 0.1, 0.5};
  scene.lights[2].shape = PointLight{};
  scene.cameras = {Camera{}, Camera{}};
  scene.cameras[0].projection = OrthographicProjection{};
  return scene;
}

/// One object of meshes 0 and 2, another of mesh 1, so that the writer cannot number them by object; and what only a
/// written file holds: names of each mesh, all ways to wrap, a light with sides.
umbrameter::Scene mixed_scene() {
  using namespace umbrameter;
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 3; ++i) shapes::add_mesh(scene, shapes::box(vec3(2.0f * static_cast<float>(i)), vec3(1)));
  scene.instances[2].object = 0;
  scene.instances = {scene.instances[0], scene.instances[2], scene.instances[1]};
  scene.meshes[2].name = "a \"name\"\nof two \\ lines";
  for (const auto& [u, v] : {std::pair(Wrap::clamp_to_edge, Wrap::repeat), {Wrap::repeat, Wrap::mirrored_repeat}}) {
    Texture texture;
    texture.texels = Image<glm::u8vec4>(1, 1, glm::u8vec4(9));
    texture.wrap_u = u;
    texture.wrap_v = v;
    scene.textures.push_back(texture);
    Material material = scene.materials[0];
    material.base_color_texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
    scene.materials.push_back(material);
    scene.meshes[scene.textures.size()].material = static_cast<std::uint32_t>(scene.materials.size() - 1);
  }
  Light panel;
  panel.shape = SpotLight{5.0, 0.1, 0.5};
  panel.emitter = RectangleEmitter{1.0, 2.0};
  scene.lights = {panel};
  return scene;
}

void write_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  int number = 0;
  const auto put = [&](const Bytes& bytes) { write(folder / ("seed-" + std::to_string(number++)), bytes); };
  for (const umbrameter::test::Construct& construct : umbrameter::test::all_constructs()) put(construct.file);
  for (const umbrameter::test::HostileFile& file : umbrameter::test::hostile_files()) put(file.bytes);
  for (const umbrameter::test::HostileFile& file : umbrameter::test::faulty_files()) put(file.bytes);
  put(umbrameter::to_glb(small_scene()));
  put(umbrameter::to_glb(mixed_scene()));
  std::printf("%d files in %s\n", number, folder.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: gltf_seeds FOLDER\n", stderr);
    return 2;
  }
  try {
    write_all(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gltf_seeds: %s\n", error.what());
    return 5;
  }
  return 0;
}
