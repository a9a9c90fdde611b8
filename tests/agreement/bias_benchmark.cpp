// How much faster one pass over all biases is than a cell for each: umbrameter_bias_benchmark [SCENE] [--quick].
// Both ways are run in turn in one process, so that a busy machine slows them alike.
#include <fmt/format.h>

#include <chrono>
#include <string>
#include <vector>

#include "compare/bias_response.h"
#include "raster/rasterizer.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"
#include "scenes/view.h"
#include "tests/support/benchmark_main.h"

namespace umbrameter {
namespace {

struct Setup {
  int width = 1280;
  int height = 720;
  int resolution = 2048;
  int biases = 256;
  int timed_cells = 16;  // of the biases, evenly chosen; the others take as long
  int turns = 3;
};

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Case {
  const char* name;
  ShadowFilter filter;
};

void run(const std::string& name, const Setup& setup) {
  Scene scene = load_scene(name);
  std::vector<std::string> notes;
  add_missing_light(scene, notes);
  const View view{setup.width, setup.height,
                  select_camera(scene, "", static_cast<double>(setup.width) / setup.height, notes)};
  const gl::Context context = gl::Context::make();
  const UploadedScene uploaded = upload(context, scene);
  const GpuGBuffer surfels = draw_gbuffer(context, uploaded, view);
  const GBuffer gbuffer = read_back(context, surfels);
  const Light& light = scene.lights.front();
  const MapLayout layout = fit_light(light, bounds_of(scene), setup.resolution);
  const CountedPixels counted = count_pixels(gbuffer, light, layout);
  const Image<float> visibility = trace_visibility(Tracer(scene), gbuffer, light).visibility;
  const gl::Texture truth = upload_truth(context, visibility, counted.exclusion);
  const ShadowMap map = draw_shadow_map(context, uploaded, light, layout);
  fmt::print("{}: {}x{}, map of {} texels, {} biases from 0 to 20 texels, {}\n", name, setup.width, setup.height,
             setup.resolution, setup.biases, context.device().renderer);
  for (const Case& filter : {Case{"nearest", ShadowFilter::nearest}, {"box of 3x3", ShadowFilter::box}}) {
    ShadowParams params;
    params.pcf.filter = filter.filter;
    ShadowLookup lookup{uploaded, surfels, map, light, params.bias, make_technique(params), &truth};
    BiasAxes one;
    for (int k = 0; k < setup.biases; ++k) {
      one.constant.push_back(static_cast<float>(20.0 * counted.mean_texel * k / setup.biases));
    }
    one.slope = {0.0f};
    BiasAxes two = one;
    two.slope = {0.0f, 1.0f};
    const auto all = [&](const BiasAxes& axes) {
      const BiasHistogram histogram = draw_bias_response(context, lookup, axes);
      for (std::size_t s = 0; s < axes.slope.size(); ++s) sums_at_biases(histogram, s);
    };
    const auto cells = [&] {
      for (int k = 0; k < setup.timed_cells; ++k) {
        const int bias = k * setup.biases / setup.timed_cells;
        lookup.bias.constant = static_cast<double>(one.constant[static_cast<std::size_t>(bias)]);
        sum_wrong_taps(draw_visibility(context, lookup).wrong, counted);
      }
    };
    all(two);  // shaders are compiled before anything is timed
    cells();
    for (int turn = 0; turn < setup.turns; ++turn) {
      const double one_slope = seconds_of([&] { all(one); });
      const double two_slopes = seconds_of([&] { all(two); });
      const double cell = seconds_of(cells) / setup.timed_cells;
      fmt::print(
          "  {}: one pass {:.0f} ms; a cell {:.1f} ms; {} cells take {:.0f} times as long; a second slope factor "
          "adds {:.2f} of a pass\n",
          filter.name, 1e3 * one_slope, 1e3 * cell, setup.biases, setup.biases * cell / one_slope,
          two_slopes / one_slope - 1.0);
    }
  }
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  return umbrameter::benchmark_main<umbrameter::Setup>(argc, argv, {96, 54, 64, 16, 2, 1}, &umbrameter::run);
}
