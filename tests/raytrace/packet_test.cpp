// A pixel's reference depends neither on the pixels that share its packets nor on the processor's vector units.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "raytrace/ao_integral.h"
#include "raytrace/ao_samples.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"
#include "scenes/view.h"
#include "techniques/ao/integral.h"

namespace umbrameter {
namespace {

View view_of(const Scene& scene, int width, int height) {
  std::vector<std::string> notes;
  return {width, height, select_camera(scene, "", static_cast<double>(width) / height, notes)};
}

GBuffer surfels_of(const Tracer& tracer, int width, int height) {
  return trace_gbuffer(tracer, view_of(tracer.scene(), width, height));
}

GBuffer two_thirds_of(GBuffer surfels) {
  for (std::size_t i = 0; i < surfels.instance.size(); ++i) {
    if (hash(static_cast<std::uint32_t>(i)) % 3 == 0) surfels.instance[i] = no_id;
  }
  return surfels;
}

class Packets : public testing::TestWithParam<const char*> {};

// Pixels share packets with others that show the same triangle.
TEST_P(Packets, Do_not_carry_occlusion_from_pixel_to_pixel) {
  const Scene scene = load_scene(GetParam());
  const Tracer tracer(scene);
  const GBuffer surfels = surfels_of(tracer, 64, 36);
  const GBuffer some = two_thirds_of(surfels);
  for (const bool is_adaptive : {false, true}) {
    for (const auto& [falloff, layers] :
         {std::pair(AoFalloff::none, AoLayers::none), std::pair(AoFalloff::none, AoLayers::all),
          std::pair(AoFalloff::gtao, AoLayers::none), std::pair(AoFalloff::sao, AoLayers::all)}) {
      TruthParams params;
      params.spp = 77;
      params.tolerance = is_adaptive ? 0.05 : 0.0;
      params.max_spp = 512;
      params.ao_distance = {1.5, LengthUnit::metres};
      params.ao_falloff = falloff;
      params.ao_layers = layers;
      const TracedAo with_all = trace_ao(tracer, surfels, params, 3);
      const TracedAo with_some = trace_ao(tracer, some, params, 3);
      const bool has_layers = layers == AoLayers::all;
      int wrong = 0;
      for (std::size_t i = 0; i < some.instance.size(); ++i) {
        if (!some.is_surface(i)) continue;
        const bool is_same = with_all.ao[i] == with_some.ao[i] && with_all.variance[i] == with_some.variance[i] &&
                             with_all.samples[i] == with_some.samples[i] &&
                             (!has_layers || (with_all.bent_normal[i] == with_some.bent_normal[i] &&
                                              with_all.hit_distance[i] == with_some.hit_distance[i]));
        wrong += is_same ? 0 : 1;
      }
      EXPECT_EQ(wrong, 0);
      EXPECT_LT(with_some.statistics.rays, with_all.statistics.rays);
    }
  }
}

TEST_P(Packets, Do_not_carry_a_methods_integral_from_pixel_to_pixel_or_from_thread_to_thread) {
  const Scene scene = load_scene(GetParam());
  const Tracer tracer(scene);
  const View view = view_of(scene, 64, 36);
  const GBuffer surfels = trace_gbuffer(tracer, view);
  const GBuffer some = two_thirds_of(surfels);
  AoSamplingParams sampling;
  sampling.radius = 1.5;
  const AoIntegral integral = integral_of(Hbao{sampling, {}, {}});
  const auto trace = [&](const GBuffer& gbuffer, int threads) {
    const ThreadLimit limit(threads);
    return trace_integral(tracer, gbuffer, view, integral, {77, 3});
  };
  const TracedIntegral with_all = trace(surfels, 1);
  const TracedIntegral on_two_threads = trace(surfels, 2);
  for (std::size_t k = 0; k < occluder_kinds; ++k) {
    EXPECT_EQ(with_all.accessibility[k].pixels, on_two_threads.accessibility[k].pixels);
    EXPECT_EQ(with_all.step_variance[k].pixels, on_two_threads.step_variance[k].pixels);
  }
  // The other occluders are surfaces of the image's other pixels.
  const TracedIntegral with_some = trace(some, 1);
  for (const Occluders occluders : {Occluders::all, Occluders::in_view}) {
    const auto k = static_cast<std::size_t>(occluders);
    int wrong = 0;
    for (std::size_t i = 0; i < some.instance.size(); ++i) {
      if (!some.is_surface(i)) continue;
      wrong += with_all.accessibility[k][i] == with_some.accessibility[k][i] &&
                       with_all.variance[k][i] == with_some.variance[k][i]
                   ? 0
                   : 1;
    }
    EXPECT_EQ(wrong, 0);
  }
  EXPECT_LT(with_some.statistics.rays, with_all.statistics.rays);
}

TEST_P(Packets, Do_not_carry_visibility_from_pixel_to_pixel) {
  const Scene scene = load_scene(GetParam());
  const Tracer tracer(scene);
  const GBuffer surfels = surfels_of(tracer, 192, 108);
  const GBuffer some = two_thirds_of(surfels);
  ASSERT_FALSE(scene.lights.empty());
  for (const Light& light : scene.lights) {
    const TracedVisibility with_all = trace_visibility(tracer, surfels, light);
    const TracedVisibility with_some = trace_visibility(tracer, some, light);
    int wrong = 0;
    for (std::size_t i = 0; i < some.instance.size(); ++i) {
      const float expected = some.is_surface(i) ? with_all.visibility[i] : 1.0f;
      wrong += with_some.visibility[i] == expected ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0) << light.name;
    EXPECT_LT(with_some.statistics.rays, with_all.statistics.rays) << light.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Packets, testing::Values("courtyard", "contact-box", "fence"));

using PacketRay = std::array<float, 7>;  // source, origin, direction

std::vector<PacketRay> rays_of(const HemisphereSamples& samples) {
  std::vector<PacketRay> rays;
  std::array<float, packet_width> x{}, y{}, z{}, dx{}, dy{}, dz{}, reach{};
  LiftedLanes lifted;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t lane = i % packet_width;
    if (lane == 0) {
      samples.lift(i, {x.data(), y.data(), z.data(), dx.data(), dy.data(), dz.data(), reach.data()}, lifted);
    }
    rays.push_back({static_cast<float>(samples.source(i)), x[lane], y[lane], z[lane], dx[lane], dy[lane], dz[lane]});
  }
  return rays;
}

// The library's loops run on the best vector unit of this processor; this file is compiled for the plainest one.
TEST(HemisphereSamples, Are_the_same_on_every_processor) {
  for (const AoWeight weight : {AoWeight::cosine, AoWeight::uniform}) {
    TruthParams params;
    params.ao_weight = weight;
    Hemisphere hemisphere;
    hemisphere.frame = frame_about(glm::normalize(vec3(0.3f, -0.8f, 0.4f)));
    hemisphere.normal = hemisphere.frame[2];
    hemisphere.offset = 1e-4;
    hemisphere.reach = 2.0;
    const PixelRays pixels[] = {{vec3(1, 2, 3), {{16, 1037}, 0}, 99},
                                {vec3(4, 5, 6), {{8, 301}, 100}, 7},
                                {vec3(7, 8, 9), {{16, 50}, 0}, 3},  // less than the widest vector of each randomisation
                                {vec3(7, 8, 9), {{16, 61}, 50}, 3}};
    HemisphereSamples samples;
    samples.make(params, hemisphere, pixels);
    ASSERT_EQ(samples.size(), 1037u + 201u + 50u + 11u);
    std::vector<PacketRay> expected;
    for (std::size_t p = 0; p < std::size(pixels); ++p) {
      const PixelRays& pixel = pixels[p];
      const Randomisations before{pixel.range.split.count, pixel.range.begin};
      for (int r = 0; r < pixel.range.split.count; ++r) {
        const std::uint32_t scramble = hash(pixel.stream, static_cast<std::uint32_t>(r));
        const vec2 shift(to_unit_float(hash(scramble, 2u)), to_unit_float(hash(scramble, 3u)));
        const vec2 turn = direction_at(to_unit_float(hash(scramble, 4u)));
        const auto source = static_cast<float>(HemisphereSamples::source_of(p, static_cast<std::size_t>(r)));
        for (int i = before.size(r); i < pixel.range.split.size(r); ++i) {
          vec2 point = owen_sobol(static_cast<std::uint32_t>(i), scramble) + shift;
          if (point.x >= 1.0f) point.x -= 1.0f;
          if (point.y >= 1.0f) point.y -= 1.0f;
          const vec2 d = concentric_disk(point);
          const vec2 disk(d.x * turn.x - d.y * turn.y, d.x * turn.y + d.y * turn.x);
          const vec3 local = weight == AoWeight::cosine ? lift_cosine(disk) : lift_uniform(disk);
          const mat3& f = hemisphere.frame;
          expected.push_back({source, pixel.origin.x, pixel.origin.y, pixel.origin.z,
                              f[0].x * local.x + f[1].x * local.y + f[2].x * local.z,
                              f[0].y * local.x + f[1].y * local.y + f[2].y * local.z,
                              f[0].z * local.x + f[1].z * local.y + f[2].z * local.z});
        }
      }
    }
    std::vector<PacketRay> made = rays_of(samples);
    std::sort(expected.begin(), expected.end());
    std::sort(made.begin(), made.end());
    EXPECT_EQ(made, expected);
  }
}

// For sums of floating-point numbers, which depend on their order.
TEST(HemisphereSamples, Of_a_pixel_keep_their_order_among_those_of_others_if_asked) {
  const Hemisphere hemisphere;
  // The pixel of the source is left out: alone, it is another.
  const auto rays_of_pixel = [&](std::span<const PixelRays> pixels, std::size_t pixel) {
    HemisphereSamples samples;
    samples.make(TruthParams{}, hemisphere, pixels, RayOrder::as_alone);
    std::vector<PacketRay> of_pixel;
    for (PacketRay ray : rays_of(samples)) {
      const auto source = static_cast<std::size_t>(ray[0]);
      if (HemisphereSamples::pixel_of(source) != pixel) continue;
      ray[0] = static_cast<float>(HemisphereSamples::randomisation_of(source));
      of_pixel.push_back(ray);
    }
    return of_pixel;
  };
  for (const int rays : {16, 77, 301}) {
    // As many rays each; the last ones of a longer sequence.
    const PixelRays pixels[] = {{vec3(1, 2, 3), {{8, rays}, 0}, 99},
                                {vec3(4, 5, 6), {{8, rays}, 0}, 7},
                                {vec3(4, 5, 6), {{8, rays + 40}, 40}, 3}};
    for (std::size_t p = 0; p < std::size(pixels); ++p) {
      EXPECT_EQ(rays_of_pixel(pixels, p), rays_of_pixel(std::span(pixels).subspan(p, 1), 0))
          << rays << " rays, pixel " << p;
    }
  }
}

}  // namespace
}  // namespace umbrameter
