// Percentage-closer soft shadows through a real map, against the penumbra of similar triangles.
#include <algorithm>
#include <array>
#include <cmath>

#include "techniques/shadow/reference/lookup.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class PcssGl : public GlTest {};

// Share of a disk of radius 1 that lies at x > −u.
double open_share(double u) {
  if (u <= -1.0) return 0.0;
  if (u >= 1.0) return 1.0;
  return 0.5 + (u * std::sqrt(1.0 - u * u) + std::asin(u)) / pi;
}

// A half plane parallel to the ground at height h hides the sun, a disk of angular radius a, from directly above: the
// penumbra has radius h tan a.
TEST_F(PcssGl, A_parallel_occluder_has_the_penumbra_of_similar_triangles) {
  constexpr double texel = 0.02;
  const MapLayout layout = exact_layout({1e-4, 1, 0}, 512, texel, 0.3);
  for (const double height : {0.5, 1.0, 2.0}) {
    Scene scene;
    const auto y = static_cast<float>(height);
    add_mesh(scene, ground(20.0f));
    add_mesh(scene, quad({-20, y, 20}, {0, y, 20}, {0, y, -20}, {-20, y, -20}));
    const UploadedScene uploaded = upload(context(), scene);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout);
    for (const double tangent : {0.1, 0.3}) {
      const double radius = height * tangent;
      constexpr int side = 256;
      const GBuffer on_ground = surfels_on_ground(side, side, -1.5 * radius, 1.5 * radius, -1, 1);
      const GpuGBuffer surfels = upload(context(), on_ground);
      for (const bool in_cone : {false, true}) {
        ShadowParams params;
        params.technique = ShadowTechniques::choice<Pcss>;
        params.pcf.samples = 64;
        params.pcss.blockers = 64;
        params.pcss.search_cone = in_cone;
        params.pcss.max_radius = 1.25 * radius / texel;  // of the search too: a wide one misses small blockers
        params.bias.constant = 0.05;
        const ShadowTechnique technique = make_technique(params, tangent);
        const Image<float> found =
            draw_visibility(context(), {uploaded, surfels, map, light_of(layout), params.bias, technique}).visibility;
        // Mean over 15 strips of the penumbra's width.
        std::array<double, 15> sum{};
        std::array<double, 15> expected{};
        std::array<int, 15> count{};
        for (std::size_t i = 0; i < found.size(); ++i) {
          const double u = static_cast<double>(on_ground.position[i].x) / radius;
          const auto strip = static_cast<std::size_t>(std::clamp((u + 1.5) * 5.0, 0.0, 14.0));
          sum[strip] += static_cast<double>(found[i]);
          expected[strip] += open_share(u);
          ++count[strip];
        }
        for (std::size_t strip = 0; strip < sum.size(); ++strip) {
          ASSERT_GT(count[strip], 1000);
          // The edge is drawn to a texel, and a search of 64 taps misses a blocker that covers less than 1/64 of it.
          const double tolerance = 0.5 * texel / radius + 1.0 / 64.0;
          EXPECT_NEAR(sum[strip] / count[strip], expected[strip] / count[strip], tolerance)
              << height << " " << tangent << " strip " << strip << (in_cone ? " in the cone" : "");
        }
      }
    }
  }
}

// The same occluder through one disk as wide as the sun seems to be at the map's near plane.
TEST_F(PcssGl, One_disk_has_the_sharpened_profile_of_its_penumbra) {
  constexpr double texel = 0.02;
  constexpr double disk = 1.0;  // metres
  const MapLayout layout = exact_layout({1e-4, 1, 0}, 512, texel, 0.3);
  const double tangent = disk / project_to_map(layout, dvec3(0.0)).depth;
  for (const double height : {0.5, 2.0}) {
    Scene scene;
    const auto y = static_cast<float>(height);
    add_mesh(scene, ground(20.0f));
    add_mesh(scene, quad({-20, y, 20}, {0, y, 20}, {0, y, -20}, {-20, y, -20}));
    const UploadedScene uploaded = upload(context(), scene);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout);
    const GBuffer on_ground = surfels_on_ground(256, 256, -1.5 * disk, 1.5 * disk, -1, 1);
    ShadowParams params;
    params.technique = ShadowTechniques::choice<Dpcf>;
    params.pcf.samples = 64;
    params.pcss.max_radius = 512;
    params.bias.constant = 0.05;
    const Image<float> found =
        draw_visibility(context(), {uploaded, upload(context(), on_ground), map, light_of(layout), params.bias,
                                    make_technique(params, tangent)})
            .visibility;
    std::array<double, 15> sum{};
    std::array<double, 15> expected{};
    std::array<int, 15> count{};
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double u = static_cast<double>(on_ground.position[i].x) / disk;
      const auto strip = static_cast<std::size_t>(std::clamp((u + 1.5) * 5.0, 0.0, 14.0));
      const double y_blocked = 1.0 - 2.0 * open_share(u);  // between -1 and 1
      const double hard = std::copysign(1.0 - std::pow(1.0 - std::abs(y_blocked), 3.0), y_blocked);
      const double softness = height * tangent / disk;
      sum[strip] += static_cast<double>(found[i]);
      expected[strip] += 0.5 - 0.5 * std::lerp(hard, y_blocked, softness);
      ++count[strip];
    }
    for (std::size_t strip = 0; strip < sum.size(); ++strip) {
      // As above; the sharpened profile is up to three times as steep.
      EXPECT_NEAR(sum[strip] / count[strip], expected[strip] / count[strip], 3.0 * (0.5 * texel / disk + 1.0 / 64.0))
          << height << " strip " << strip;
    }
  }
}

// Without extent, and where the search finds nothing, the kernel has its least radius: 0 is one tap.
TEST_F(PcssGl, A_light_without_extent_gives_the_nearest_tap) {
  const MapLayout layout = exact_layout({0.3, 1, 0}, 128, 0.08, 0.3);
  Scene scene;
  add_mesh(scene, ground(20.0f));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  const UploadedScene uploaded = upload(context(), scene);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout);
  const GpuGBuffer surfels = upload(context(), surfels_on_ground(128, 128, -3, 3, -3, 3));
  ShadowParams params;
  const auto draw = [&] {
    return draw_visibility(context(),
                           {uploaded, surfels, map, light_of(layout), params.bias, make_technique(params, 0.0)})
        .visibility;
  };
  const Image<float> nearest = draw();
  for (const ShadowTechniques::Choice name : {ShadowTechniques::choice<Pcss>, ShadowTechniques::choice<Dpcf>}) {
    params.technique = name;
    EXPECT_EQ(draw().pixels, nearest.pixels);
  }
}

}  // namespace
}  // namespace umbrameter
