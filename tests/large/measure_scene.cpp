#include "measure_scene.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>

#include "raster/rasterizer.h"
#include "raytrace/tracer.h"
#include "reports/files/output.h"
#include "scenes/builtin.h"
#include "scenes/gltf.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

constexpr int width = 1280;
constexpr int height = 720;
constexpr int map_resolution = 2048;

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double least_seconds_of(const std::function<void()>& work, int repeats) {
  double least = seconds_of(work);
  double sum = least;
  for (int i = 1; i < std::min(repeats, 2) || (i < repeats && sum < 4.0); ++i) {
    const double seconds = seconds_of(work);
    least = std::min(least, seconds);
    sum += seconds;
  }
  return least;
}

double peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

Measurements write_scene(const std::string& scene, const std::filesystem::path& file) {
  const Scene made = load_scene(scene);
  const std::vector<unsigned char> bytes = to_glb(made);
  write_text(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const SceneCounts counts = count(made);
  return {{"triangles", static_cast<double>(counts.triangles)},
          {"stored triangles", static_cast<double>(counts.stored_triangles)},
          {"instances", static_cast<double>(made.instances.size())},
          {"file MiB", static_cast<double>(bytes.size()) / (1024.0 * 1024.0)}};
}

Measurements measure_scene(const std::filesystem::path& file, int repeats) {
  Measurements found;
  const auto least_seconds = [&](const std::function<void()>& work) { return least_seconds_of(work, repeats); };
  std::optional<Scene> scene;
  const auto load = [&] {
    scene.reset();
    scene = load_gltf(file);
  };
  double seconds = seconds_of(load);
  found.emplace_back(stage_names[0], peak_mebibytes());
  if (repeats > 1) seconds = std::min(seconds, least_seconds(load));
  found.emplace_back(step_names[0], seconds);

  std::vector<std::string> notes;
  const View view{width, height, select_camera(*scene, {}, static_cast<double>(width) / height, notes)};
  add_missing_light(*scene, notes);
  const Light& light = scene->lights[0];
  const MapLayout layout = fit_light(light, bounds_of(*scene), map_resolution);

  // Reading back waits until everything is drawn.
  const gl::Context context = gl::Context::make();
  std::optional<UploadedScene> uploaded;
  found.emplace_back(step_names[1], least_seconds([&] {
                       uploaded.reset();
                       uploaded = upload(context, *scene);
                       read_back(context, draw_gbuffer(context, *uploaded, view));
                     }));
  found.emplace_back(step_names[2],
                     least_seconds([&] { read_back(context, draw_shadow_map(context, *uploaded, light, layout)); }));
  found.emplace_back(stage_names[1], peak_mebibytes());

  std::optional<Tracer> tracer;
  found.emplace_back(step_names[3], least_seconds([&] {
                       tracer.reset();
                       tracer.emplace(*scene);
                     }));
  GBuffer gbuffer;
  found.emplace_back(step_names[4], least_seconds([&] { gbuffer = trace_gbuffer(*tracer, view); }));
  found.emplace_back(step_names[5], least_seconds([&] { trace_visibility(*tracer, gbuffer, light); }));
  found.emplace_back(stage_names[2], peak_mebibytes());
  return found;
}

}  // namespace umbrameter
