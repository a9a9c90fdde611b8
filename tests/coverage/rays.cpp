// A sampled reference of the same surfels, traced with many seeds.
#include <functional>
#include <vector>

#include "compare/ao.h"
#include "compare/soft_visibility.h"
#include "coverage.h"
#include "raytrace/pixel_shadow.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"
#include "scenes/emitter.h"
#include "scenes/light.h"

namespace umbrameter::coverage {
namespace {

struct Case {
  const char* name;
  const char* scene;
  std::uint32_t camera;
  double angle;  // of the sun, degrees; 0: without extent, against the mean over the pixel; below 0: ambient occlusion
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
      {"contact-box, over the pixel, 64 rays", "contact-box", 0, 0.0, rays(64)},
      {"courtyard, AO, 64 rays", "courtyard", 0, -1.0, rays(64)},
      {"courtyard, AO, 512 rays", "courtyard", 0, -1.0, rays(512)},
  };
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

void measure_shadow(const Case& of, const Tracer& tracer, const GBuffer& gbuffer, const View& view, Light light,
                    const TruthParams& truth, int seeds) {
  const Image<float> hard = trace_visibility(tracer, gbuffer, light).visibility;
  if (of.angle > 0.0) light.emitter = make_emitter(light, {{}, {}, {}, glm::radians(of.angle), {}});
  const auto trace = [&](const TruthParams& params, std::uint32_t seed) {
    return of.angle > 0.0 ? trace_visibility(tracer, gbuffer, light, {params, seed})
                          : trace_pixel_visibility(tracer, gbuffer, view, light, {params, seed});
  };
  const TracedVisibility right = trace(truth, seed_of_truth);
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
    print_seeds(fmt::format("{}, {}", of.name, name), seeds, describe(of_right),
                [&](std::uint32_t seed) { return statistics(trace(of.params, seed)); });
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
    print_seeds(fmt::format("{}, {}", of.name, name), seeds, describe(of_right),
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
  if (of.angle >= 0.0) {
    measure_shadow(of, tracer, gbuffer, view, scene.lights.at(0), truth, seeds);
  } else {
    measure_ao(of, tracer, gbuffer, truth, seeds);
  }
}

}  // namespace

void measure_rays(const Options& options) {
  for (const Case& each : all_cases()) {
    if (options.selects(each.name)) measure(each, options.rays, options.seeds);
  }
}

}  // namespace umbrameter::coverage
