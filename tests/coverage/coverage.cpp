// umbrameter_coverage [SEEDS [RAYS [CASE]]]: how often the 95 % intervals of the statistics of a sampled reference hold
// the value that RAYS rays (16,384) give. Prints a table in Markdown. 300 seeds take some minutes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "compare/ao.h"
#include "compare/soft_visibility.h"
#include "core/error.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"
#include "scenes/emitter.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

struct Case {
  const char* name;
  const char* scene;
  std::uint32_t camera;
  double angle;  // of the sun, degrees; 0: ambient occlusion
  TruthParams params;
};

std::vector<Case> all_cases() {
  const auto rays = [](int spp) {
    TruthParams params;
    params.spp = spp;
    return params;
  };
  TruthParams random = rays(64);
  random.sampler = Sampler::random;
  TruthParams adaptive;
  adaptive.tolerance = 0.05;
  return {
      {"contact-box, sun of 8°, 16 rays", "contact-box", 0, 8.0, rays(16)},
      {"contact-box, sun of 8°, 64 rays", "contact-box", 0, 8.0, rays(64)},
      {"contact-box, sun of 8°, 64 random rays", "contact-box", 0, 8.0, random},
      {"contact-box, sun of 8°, 256 rays", "contact-box", 0, 8.0, rays(256)},
      {"contact-box, sun of 8°, tolerance 0.05", "contact-box", 0, 8.0, adaptive},
      {"two-occluders, sun of 4°, 64 rays", "two-occluders", 1, 4.0, rays(64)},
      {"two-occluders, sun of 4°, 256 rays", "two-occluders", 1, 4.0, rays(256)},
      {"courtyard, AO, 64 rays", "courtyard", 0, 0.0, rays(64)},
      {"courtyard, AO, 512 rays", "courtyard", 0, 0.0, rays(512)},
  };
}

// One statistic over all seeds.
struct Tally {
  std::string name;
  double truth = 0.0;
  int held = 0;
  int low = 0;  // the whole interval is below the truth
  int high = 0;
  double sum = 0.0;
  double squares = 0.0;
  double width = 0.0;

  void add(const Estimate& estimate) {
    held += estimate.lower <= truth && truth <= estimate.upper ? 1 : 0;
    low += estimate.upper < truth ? 1 : 0;
    high += estimate.lower > truth ? 1 : 0;
    sum += estimate.value - truth;
    squares += (estimate.value - truth) * (estimate.value - truth);
    width += 0.5 * (estimate.upper - estimate.lower);
  }
};

// `measure` returns a struct of statistics from the rays of a seed.
template <class Measure>
void tally(const std::string& name, int seeds, Statistics truth, const Measure& measure) {
  std::vector<Tally> tallies;
  for (const Statistic& each : truth) {
    if (each.has_interval()) tallies.push_back({each.name, std::get<Estimate*>(each.field)->value});
  }
  for (int seed = 1; seed <= seeds; ++seed) {
    auto measured = measure(static_cast<std::uint32_t>(seed));
    std::size_t t = 0;
    for (const Statistic& each : describe(measured)) {
      if (each.has_interval()) tallies[t++].add(*std::get<Estimate*>(each.field));
    }
  }
  for (const Tally& each : tallies) {
    const double mean = each.sum / seeds;
    const double scatter = std::sqrt(std::max(each.squares / seeds - mean * mean, 0.0));
    fmt::print("| {} | `{}` | {:.5f} | {:+.5f} | {:.5f} | {:.5f} | {:.1f} % | {} | {} |\n", name, each.name, each.truth,
               mean, 1.96 * scatter, each.width / seeds, 100.0 * each.held / seeds, each.low, each.high);
  }
  std::fflush(stdout);
}

constexpr std::uint32_t seed_of_truth = 1000003;

// Off by up to 0.02 to either side: about as much as the noise of 64 rays.
Image<float> nearly(const Image<float>& right) {
  Image<float> image = right;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const float off = 0.02f * std::sin(0.7f * static_cast<float>(i));
    if (image[i] > 0.0f && image[i] < 1.0f) image[i] = std::clamp(image[i] + off, 0.0f, 1.0f);
  }
  return image;
}

void measure_shadow(const Case& of, const Tracer& tracer, const GBuffer& gbuffer, Light light, TruthParams truth,
                    int seeds) {
  const Image<float> hard = trace_visibility(tracer, gbuffer, light).visibility;
  light.emitter = make_emitter(light, {{}, {}, {}, glm::radians(of.angle), {}});
  const TracedVisibility right = trace_visibility(tracer, gbuffer, light, {truth, seed_of_truth});
  CountedPixels counted{Image<PixelExclusion>(gbuffer.width, gbuffer.height, PixelExclusion::back_facing)};
  for (std::size_t i = 0; i < counted.exclusion.size(); ++i) {
    if (right.samples[i] > 0.0f) counted.exclusion[i] = PixelExclusion::none;
  }
  const Image<float> near = nearly(right.visibility);
  for (const auto& [name, technique] : {std::pair("hard shadow", &hard), std::pair("nearly right", &near)}) {
    const auto statistics = [&, technique = technique](const TracedVisibility& traced) {
      return analyze_soft_visibility(
          *technique, {traced.visibility, traced.variance, traced.samples, traced.degrees_of_freedom}, counted);
    };
    SoftVisibilityStatistics of_right = statistics(right);
    tally(fmt::format("{}, {}", of.name, name), seeds, describe(of_right), [&](std::uint32_t seed) {
      return statistics(trace_visibility(tracer, gbuffer, light, {of.params, seed}));
    });
  }
}

void measure_ao(const Case& of, const Tracer& tracer, const GBuffer& gbuffer, TruthParams truth, int seeds) {
  const TracedAo right = trace_ao(tracer, gbuffer, truth, seed_of_truth);
  TruthParams nearer = truth;
  nearer.ao_distance.number *= 0.7;
  const Image<float> other = trace_ao(tracer, gbuffer, nearer, seed_of_truth + 1).ao;
  const Image<float> near = nearly(right.ao);
  TruthParams params = of.params;
  params.ao_distance = truth.ao_distance;
  for (const auto& [name, technique] : {std::pair("another distance", &other), std::pair("nearly right", &near)}) {
    const auto statistics = [&, technique = technique](const TracedAo& traced) {
      return analyze_ao(*technique, {traced.ao, traced.variance, traced.samples, traced.degrees_of_freedom}, gbuffer);
    };
    AoStatistics of_right = statistics(right);
    tally(fmt::format("{}, {}", of.name, name), seeds, describe(of_right),
          [&](std::uint32_t seed) { return statistics(trace_ao(tracer, gbuffer, params, seed)); });
  }
}

void measure(const Case& of, int rays, int seeds) {
  const Scene scene = load_scene(of.scene);
  const Tracer tracer(scene);
  const View view{96, 54, scene.cameras.at(of.camera)};
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  TruthParams truth;
  truth.spp = rays;
  truth.ao_distance = {0.04 * bounds_of(scene).radius(), LengthUnit::metres};
  if (of.angle > 0.0) {
    measure_shadow(of, tracer, gbuffer, scene.lights.at(0), truth, seeds);
  } else {
    measure_ao(of, tracer, gbuffer, truth, seeds);
  }
}

int run(int seeds, int rays, const std::string& only) {
  fmt::print(
      "| case | statistic | {} rays | mean deviation | 1.96 σ of the values | mean half width | held | too low | too "
      "high |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      rays);
  for (const Case& each : all_cases()) {
    if (only.empty() || std::string(each.name).find(only) != std::string::npos) measure(each, rays, seeds);
  }
  return 0;
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  try {
    return umbrameter::run(argc > 1 ? std::stoi(argv[1]) : 300, argc > 2 ? std::stoi(argv[2]) : 16384,
                           argc > 3 ? argv[3] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "umbrameter_coverage: {}\n", error.what());
    return 1;
  }
}
