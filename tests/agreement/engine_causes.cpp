// umbrameter_engine_causes PROGRAM [FILTER]: the causes that rays, and flips over a sweep's bias, find in frames of our
// own rasteriser driven as an engine, against the exact ones: the tables of docs/evaluate.md. PROGRAM is umbrameter.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "core/error.h"
#include "experiments/measure/measure.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

constexpr const char* bias_key = "engine.shadow-constant-bias";
constexpr const char* axis = "0:6:25";

// Pixels of two exact causes by the cause that was found; a pixel of a filter counts in parts.
using Confusion = std::array<std::array<double, 2>, 2>;

Confusion confusion(const WrongTaps& exact, const WrongTaps& found, Cause first) {
  Confusion sums{};
  for (std::size_t i = 0; i < exact.weights.size(); ++i) {
    for (int c = 0; c < 2; ++c) {
      const int cause = static_cast<int>(first) + c;
      const double weight = static_cast<double>(exact.weights[i][cause]) / exact.weight_sum;
      const double same = std::min(weight, static_cast<double>(found.weights[i][cause]) / found.weight_sum);
      sums[static_cast<std::size_t>(c)][static_cast<std::size_t>(c)] += same;
      sums[static_cast<std::size_t>(c)][static_cast<std::size_t>(1 - c)] += weight - same;
    }
  }
  return sums;
}

double weight_lit(const WrongTaps& exact, Cause cause, const Image<float>& drawn) {
  double sum = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    sum += static_cast<double>(exact.weights[i][static_cast<int>(cause)]) / exact.weight_sum * drawn[i];
  }
  return sum;
}

Experiment experiment_of(const std::string& scene, const std::string& prefix, const std::string& filter) {
  Experiment experiment;
  experiment.scene = scene;
  experiment.view.size = {320, 180};
  experiment.view.surfels = SurfelSource::traced;
  experiment.shadow.map.resolution = 1024;
  const Parameters all = describe(experiment);
  require(all, prefix + "filter").set_text(filter);
  require(all, prefix + "resolution").set_text("1024");
  return experiment;
}

void print_tables(const std::string& program, const std::string& filter) {
  std::string dark =
      "| scene | bias | | pixels | acne | false occlusion | lit at the end |\n|---|---|---|---|---|---|---|\n";
  std::string bright =
      "| scene | bias | | pixels | rays: peter-panning | rays: leak | flips: peter-panning | flips: leak |\n"
      "|---|---|---|---|---|---|---|---|\n";
  const auto engine = std::make_shared<Engine>("'" + program + "' engine serve");
  for (const char* scene : {"courtyard", "city", "two-occluders", "room"}) {
    use_engine({});
    Stages ours(load_scene(scene), {}, Console{.quiet = true});
    const Experiment own = ours.in_metres(experiment_of(scene, "shadow.", filter));
    use_engine(engine->parameters());
    StageOptions options;
    options.frames = std::make_shared<FrameSource>(frames_of(engine));
    Stages theirs(load_scene(scene), options, Console{.quiet = true});
    Experiment driven = theirs.in_metres(experiment_of(scene, "engine.shadow-", filter));
    driven.view.light = "sun";
    const std::uint32_t light = ours.lights("sun").front();
    for (const double bias : {0.5, 1.5, 6.0}) {
      Experiment at = own;
      at.shadow.bias.constant = Length{bias, LengthUnit::texels};
      const WrongTaps exact = measure_shadow(ours, at, light, {}).raster->wrong;
      at.shadow.bias.constant.number = 6.0;
      const Image<float> end = ours.draw(at, light, false).visibility;
      require(describe(driven), bias_key).set_text(fmt::format("{}", bias));
      driven.axes.clear();
      const WrongTaps rays = measure_shadow(theirs, driven, light, {}).raster->wrong;
      driven.axes = {{bias_key, axis}};
      const ShadowMeasurement measured = measure_shadow(theirs, driven, light, {});
      const WrongTaps& flips = measured.raster->wrong;
      const Confusion too_dark = confusion(exact, flips, Cause::acne);
      const Confusion by_rays = confusion(exact, rays, Cause::peter_panning);
      const Confusion by_flips = confusion(exact, flips, Cause::peter_panning);
      for (std::size_t c = 0; c < 2; ++c) {
        const std::string head = c == 0 ? fmt::format("| `{}` | {:g} ", scene, bias) : "| | ";
        dark += fmt::format("{}| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n", head, cause_names[c],
                            too_dark[c][0] + too_dark[c][1], too_dark[c][0], too_dark[c][1],
                            weight_lit(exact, static_cast<Cause>(c), end));
        bright +=
            fmt::format("{}| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n", head, cause_names[c + 2],
                        by_rays[c][0] + by_rays[c][1], by_rays[c][0], by_rays[c][1], by_flips[c][0], by_flips[c][1]);
      }
      if (measured.cause_source == "rays") bright += "(flips not used)\n";
    }
  }
  std::printf("%s\n%s", dark.c_str(), bright.c_str());
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: umbrameter_engine_causes PROGRAM [FILTER]\n");
    return 2;
  }
  try {
    umbrameter::print_tables(argv[1], argc > 2 ? argv[2] : "nearest");
  } catch (const umbrameter::Error& error) {
    std::fprintf(stderr, "umbrameter_engine_causes: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
