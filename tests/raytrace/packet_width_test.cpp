// The reference does not depend on how many rays are traced at once, nor on the processor's vector units.
#include "raytrace/packet_width.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "core/random.h"
#include "raytrace/ao_samples.h"
#include "scenes/builtin.h"
#include "scenes/view.h"

namespace umbrameter {
namespace {

GBuffer surfels_of(const Tracer& tracer, int width, int height) {
  std::vector<std::string> notes;
  return trace_gbuffer(tracer,
                       {width, height, select_camera(tracer.scene(), "", static_cast<double>(width) / height, notes)});
}

template <class Value>
int different(const Image<Value>& a, const Image<Value>& b) {
  EXPECT_EQ(a.size(), b.size());
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] == b[i] ? 0 : 1;
  return count;
}

class PacketWidth : public testing::TestWithParam<const char*> {};

TEST_P(PacketWidth, Changes_no_bit_of_ambient_occlusion) {
  const Scene scene = load_scene(GetParam());
  const Tracer tracer(scene);
  const GBuffer surfels = surfels_of(tracer, 64, 36);
  for (const bool is_adaptive : {false, true}) {
    for (const AoLayers layers : {AoLayers::none, AoLayers::all}) {
      TruthParams params;
      params.spp = 77;  // no width divides it
      params.tolerance = is_adaptive ? 0.05 : 0.0;
      params.max_spp = 512;
      params.ao_layers = layers;
      const TracedAo best = trace_ao(tracer, surfels, params, 3);
      for (const int width : {4, 8, 16}) {
        const TracedAo other = trace_ao_in_packets(width, {tracer, surfels, params, 3});
        EXPECT_EQ(different(best.ao, other.ao), 0) << width;
        EXPECT_EQ(different(best.standard_error, other.standard_error), 0) << width;
        EXPECT_EQ(different(best.variance, other.variance), 0) << width;
        EXPECT_EQ(different(best.samples, other.samples), 0) << width;
        EXPECT_EQ(different(best.bent_normal, other.bent_normal), 0) << width;
        EXPECT_EQ(different(best.hit_distance, other.hit_distance), 0) << width;
        EXPECT_EQ(best.statistics.rays, other.statistics.rays) << width;
      }
    }
  }
}

// Pixels share packets with others that show the same triangle.
TEST_P(PacketWidth, Leaves_a_pixel_ignorant_of_its_neighbours) {
  const Scene scene = load_scene(GetParam());
  const Tracer tracer(scene);
  const GBuffer surfels = surfels_of(tracer, 64, 36);
  GBuffer some = surfels;
  for (std::size_t i = 0; i < some.instance.size(); ++i) {
    if (hash(static_cast<std::uint32_t>(i)) % 3 == 0) some.instance[i] = no_id;
  }
  for (const bool is_adaptive : {false, true}) {
    for (const AoLayers layers : {AoLayers::none, AoLayers::all}) {
      TruthParams params;
      params.spp = 77;
      params.tolerance = is_adaptive ? 0.05 : 0.0;
      params.max_spp = 512;
      params.ao_layers = layers;
      const TracedAo with_all = trace_ao(tracer, surfels, params, 3);
      const TracedAo with_some = trace_ao(tracer, some, params, 3);
      int wrong = 0;
      for (std::size_t i = 0; i < some.instance.size(); ++i) {
        if (!some.is_surface(i)) continue;
        wrong += with_all.ao[i] == with_some.ao[i] && with_all.variance[i] == with_some.variance[i] &&
                         with_all.samples[i] == with_some.samples[i] &&
                         (layers == AoLayers::none || with_all.bent_normal[i] == with_some.bent_normal[i])
                     ? 0
                     : 1;
      }
      EXPECT_EQ(wrong, 0);
      EXPECT_LT(with_some.statistics.rays, with_all.statistics.rays);
    }
  }
}

TEST_P(PacketWidth, Changes_no_bit_of_visibility) {
  const Scene scene = load_scene(GetParam());
  const Tracer tracer(scene);
  const GBuffer surfels = surfels_of(tracer, 192, 108);
  ASSERT_FALSE(scene.lights.empty());
  for (const Light& light : scene.lights) {
    const TracedVisibility best = trace_visibility(tracer, surfels, light);
    for (const int width : {4, 8, 16}) {
      const TracedVisibility other = trace_sharp_visibility_in_packets(width, {tracer, surfels, light});
      EXPECT_EQ(different(best.visibility, other.visibility), 0) << light.name << ", " << width;
      EXPECT_EQ(best.statistics.rays, other.statistics.rays) << light.name << ", " << width;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PacketWidth, testing::Values("courtyard", "contact-box", "fence"));

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
    using Ray = std::array<float, 7>;  // source, origin, direction
    std::vector<Ray> expected;
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
    std::vector<Ray> made;
    std::array<float, 16> x{}, y{}, z{}, dx{}, dy{}, dz{}, reach{};
    LiftedLanes lifted;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::size_t lane = i % 16;
      if (lane == 0) {
        samples.lift<16>(i, {x.data(), y.data(), z.data(), dx.data(), dy.data(), dz.data(), reach.data()}, lifted);
      }
      made.push_back({static_cast<float>(samples.source(i)), x[lane], y[lane], z[lane], dx[lane], dy[lane], dz[lane]});
    }
    std::sort(expected.begin(), expected.end());
    std::sort(made.begin(), made.end());
    EXPECT_EQ(made, expected);
  }
}

}  // namespace
}  // namespace umbrameter
