// All ways to the error of every cell, over a grid too large for the tests: umbrameter_bias_check SCENE [WxH].
#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "core/error.h"
#include "scenes/builtin.h"
#include "tests/agreement/bias_agreement.h"

namespace umbrameter::test {
namespace {

std::size_t run(const std::string& name, int width, int height) {
  Scene scene = load_scene(name);
  std::vector<std::string> notes;
  add_missing_light(scene, notes);
  const View view{width, height, select_camera(scene, "", static_cast<double>(width) / height, notes)};
  BiasGrid grid;
  grid.axes.slope = {0.0f, 0.5f, 1.0f, 2.0f};
  grid.resolutions = {512, 1024, 2048};
  grid.filters = usual_filters();
  grid.filters.resize(5);
  const auto reach = static_cast<float>(bounds_of(scene).radius() / 100.0);
  for (int k = 0; k < 64; ++k) grid.axes.constant.push_back(reach * static_cast<float>(k) / 63.0f);
  const gl::Context context = gl::Context::make();
  std::size_t disagreements = 0;
  const char* kinds[] = {"directional", "spot", "point"};
  const std::vector<Light> lights = lights_of_every_kind(scene);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Agreement found = compare_ways(context, scene, view, lights[i], grid);
    for (const std::string& line : found.disagreements) fmt::print("{}: {}\n", kinds[i], line);
    fmt::print("{}, {} light, {}x{}: {} cells, {} with wrong taps, {} disagreements, identity within {:.1e}\n", name,
               kinds[i], width, height, found.cells, found.wrong_cells, found.disagreements.size(), found.identity_gap);
    std::fflush(stdout);
    disagreements += found.disagreements.size();
  }
  return disagreements;
}

}  // namespace
}  // namespace umbrameter::test

int main(int argc, char** argv) {
  int width = 320;
  int height = 180;
  if (argc < 2 || argc > 3 || (argc == 3 && std::sscanf(argv[2], "%dx%d", &width, &height) != 2)) {
    fmt::print(stderr, "usage: umbrameter_bias_check SCENE [WxH]\n");
    return 2;
  }
  try {
    return umbrameter::test::run(argv[1], width, height) == 0 ? 0 : 1;
  } catch (const umbrameter::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  }
}
