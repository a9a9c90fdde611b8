// Writes the seed corpus of gltf_fuzz: every construct, small broken files, and a small scene of our own writer.
// usage: gltf_seeds FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

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

void write_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  int number = 0;
  const auto put = [&](const Bytes& bytes) { write(folder / ("seed-" + std::to_string(number++)), bytes); };
  for (const umbrameter::test::Construct& construct : umbrameter::test::all_constructs()) put(construct.file);
  for (const umbrameter::test::HostileFile& file : umbrameter::test::hostile_files()) put(file.bytes);
  for (const umbrameter::test::HostileFile& file : umbrameter::test::faulty_files()) put(file.bytes);
  put(umbrameter::to_glb(small_scene()));
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
