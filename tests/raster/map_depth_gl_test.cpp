// How finely a shadow map stores depths, and the polygon offset, through maps that are drawn and read back.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "map_depth_cases.h"
#include "raster/shadow/map_layer.h"
#include "tests/support/shadow_depths.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;
using test::to_metres;

constexpr MapDepthFormat formats[] = {MapDepthFormat::f32, MapDepthFormat::f16, MapDepthFormat::f16_down,
                                      MapDepthFormat::fixed24, MapDepthFormat::fixed16};
constexpr DepthEncoding encodings[] = {DepthEncoding::linear, DepthEncoding::perspective, DepthEncoding::reversed};

TEST_F(MapDepthGl, Every_format_and_encoding_rounds_to_its_step) {
  const Scene scene = make_floor();
  for (const Light& light : lights()) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 128);
    const ShadowMapImages exact = draw(scene, light, layout);
    // Of the linear 32-bit floats that both maps are read in, and of the shader's own arithmetic.
    const double rounding = 6e-7 * layout.far_depth;
    // A cube's perspective encodings round the depth along the face's axis, which is shorter by up to √3.
    const double along_axis = layout.kind == MapKind::cube ? std::sqrt(3.0) : 1.0;
    for (const MapDepthFormat format : formats) {
      for (const DepthEncoding encoding : encodings) {
        // Steps of half a metre are no small part of a depth, and at the far end of a cube the number of the depth
        // along the face's axis has another exponent than that of the radial depth.
        const bool is_coarse = encoding == DepthEncoding::perspective && is_projective(layout.kind);
        const bool is_uneven = encoding == DepthEncoding::reversed && layout.kind == MapKind::cube;
        const bool is_half = format == MapDepthFormat::f16 || format == MapDepthFormat::f16_down;
        if (is_half && (is_coarse || is_uneven)) continue;
        const MapDepthParams params = stored_as(format, encoding, 0.05);
        const ShadowMapImages map = draw(scene, light, layout, params);
        double largest = 0.0;
        for (std::size_t view = 0; view < map.depth.size(); ++view) {
          for (std::size_t i = 0; i < map.depth[view].size(); ++i) {
            const double expected = static_cast<double>(exact.depth[view][i]) * layout.far_depth;
            const double found = static_cast<double>(map.depth[view][i]) * layout.far_depth;
            ASSERT_EQ(exact.depth[view][i] < 1.0f, map.depth[view][i] < 1.0f);
            if (exact.depth[view][i] >= 1.0f) continue;
            const double step = along_axis * depth_step(params, layout, expected);
            // A shader's depth, and the one that is read back, are 32-bit floats, whose steps are those of 24 bits. An
            // H200 computes the depths of a 16-bit buffer with 20 bits: 1/16 of a step.
            const double bound = format == MapDepthFormat::fixed24    ? 1.5
                                 : format == MapDepthFormat::fixed16  ? 0.505 + 1.0 / 16.0
                                 : format == MapDepthFormat::f16_down ? 1.005
                                                                      : 0.505;
            EXPECT_NEAR(found, expected, bound * step + rounding)
                << "format " << static_cast<int>(format) << ", encoding " << static_cast<int>(encoding) << ", view "
                << view << ", texel " << i << ", off by " << std::abs(found - expected) / step << " steps";
            largest = std::max(largest, std::abs(found - expected) / step);
          }
        }
        if (format == MapDepthFormat::fixed16 || is_half) {
          EXPECT_GT(largest, (format == MapDepthFormat::f16_down ? 0.9 : 0.4) / along_axis);
        }
      }
    }
  }
}

TEST_F(MapDepthGl, Neighbouring_stored_depths_are_one_step_apart) {
  const Scene scene = make_floor();
  struct Case {
    MapLayout layout;
    MapDepthParams params;
  };
  const MapLayout sun = exact_layout({1, 0.8, 0.2}, 512, 0.02, 0.35);
  const MapLayout spot = fit_light(spot_light({1, 3, 1}, {0, 0, 0}, 0.7), bounds_of(scene), 512);
  for (const Case& c : {Case{sun, stored_as(MapDepthFormat::fixed16, DepthEncoding::linear)},
                        Case{sun, stored_as(MapDepthFormat::fixed16, DepthEncoding::reversed)},
                        Case{spot, stored_as(MapDepthFormat::fixed16, DepthEncoding::linear)},
                        Case{spot, stored_as(MapDepthFormat::fixed16, DepthEncoding::perspective)},
                        Case{spot, stored_as(MapDepthFormat::fixed16, DepthEncoding::reversed, 0.01)},
                        Case{spot, stored_as(MapDepthFormat::fixed24, DepthEncoding::perspective, 0.0002)},
                        Case{spot, stored_as(MapDepthFormat::f32, DepthEncoding::perspective, 0.0002)}}) {
    std::vector<float> depths = to_metres(draw(scene, light_of(c.layout), c.layout, c.params), c.layout)[0].pixels;
    std::sort(depths.begin(), depths.end());
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    ASSERT_TRUE(std::isinf(depths.back()));
    int single = 0;
    int gaps = 0;
    for (std::size_t i = 1; i + 1 < depths.size(); ++i) {
      const double near_end = static_cast<double>(depths[i - 1]);
      const double far_end = static_cast<double>(depths[i]);
      const double steps = (far_end - near_end) / depth_step(c.params, c.layout, 0.5 * (near_end + far_end));
      ASSERT_GT(steps, 0.97) << near_end;
      ++gaps;
      if (steps < 1.03) ++single;
    }
    EXPECT_GT(gaps, 100);
    EXPECT_GT(single, gaps / 2);
  }
}

// 11 significant digits and exponents down to −14 (IEEE 754, binary16), ties to even.
TEST(MapDepth, A_16_bit_float_is_the_nearest_one) {
  EXPECT_EQ(shared::nearest_half(0.1f), 0x1.998p-4f);         // 0x1.99999ap-4
  EXPECT_EQ(shared::nearest_half(1.0f / 3.0f), 0x1.554p-2f);  // 0x1.555556p-2
  EXPECT_EQ(shared::nearest_half(0.75f), 0.75f);
  EXPECT_EQ(shared::nearest_half(0x1.002p-1f), 0.5f);         // between 0x1.000p-1 and 0x1.004p-1
  EXPECT_EQ(shared::nearest_half(0x1.006p-1f), 0x1.008p-1f);  // between 0x1.004p-1 and 0x1.008p-1
  EXPECT_EQ(shared::nearest_half(0x1.00201p-1f), 0x1.004p-1f);
  EXPECT_EQ(shared::nearest_half(0x1.ffep-1f), 1.0f);     // between 0x1.ffcp-1 and 1
  EXPECT_EQ(shared::nearest_half(0x1.8p-24f), 0x1p-23f);  // below 2^-14 in steps of 2^-24
  EXPECT_EQ(shared::nearest_half(0x1p-25f), 0.0f);
  EXPECT_EQ(shared::nearest_half(0.0f), 0.0f);
  EXPECT_EQ(shared::nearest_half(1.0f), 1.0f);
}

TEST(MapDepth, A_16_bit_float_is_rounded_down) {
  EXPECT_EQ(shared::half_below(0x1.003ffep-1f), 0x1.0p-1f);  // between 0x1.000p-1 and 0x1.004p-1
  EXPECT_EQ(shared::half_below(0x1.004p-1f), 0x1.004p-1f);
  EXPECT_EQ(shared::half_below(0.1f), 0x1.998p-4f);  // 0x1.99999ap-4
  EXPECT_EQ(shared::half_below(0x1.fffffep-1f), 0x1.ffcp-1f);
  EXPECT_EQ(shared::half_below(0x1.8p-24f), 0x1p-24f);  // below 2^-14 in steps of 2^-24
  EXPECT_EQ(shared::half_below(0.0f), 0.0f);
  EXPECT_EQ(shared::half_below(1.0f), 1.0f);
}

TEST_F(MapDepthGl, A_map_of_16_bit_floats_is_that_of_32_bit_ones_rounded) {
  const Scene scene = make_floor();
  for (const Light& light : lights()) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 64);
    const ShadowMapImages exact = draw(scene, light, layout);
    for (const auto& [format, half] : {std::pair(MapDepthFormat::f16, &shared::nearest_half),
                                       std::pair(MapDepthFormat::f16_down, &shared::half_below)}) {
      const ShadowMapImages map = draw(scene, light, layout, stored_as(format, DepthEncoding::linear));
      std::size_t rounded = 0;
      for (std::size_t view = 0; view < map.depth.size(); ++view) {
        for (std::size_t i = 0; i < map.depth[view].size(); ++i) {
          ASSERT_EQ(map.depth[view][i], half(exact.depth[view][i])) << exact.depth[view][i];
          if (map.depth[view][i] != exact.depth[view][i]) ++rounded;
        }
      }
      EXPECT_GT(rounded, 1000u);
    }
  }
}

// 16 bits of a spot light of range 10 m, near plane 0.1 m: z² (f − n) / (n f 65535).
TEST(MapDepth, The_step_follows_its_formula) {
  MapLayout layout;
  layout.kind = MapKind::perspective;
  layout.far_depth = 10.0;
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::fixed16, DepthEncoding::linear), layout, 3.0), 1.526e-4, 1e-7);
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::fixed16, DepthEncoding::perspective), layout, 5.0), 3.777e-3, 1e-6);
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::fixed16, DepthEncoding::reversed), layout, 5.0), 3.777e-3, 1e-6);
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::fixed24, DepthEncoding::perspective), layout, 5.0), 1.475e-5, 1e-8);
  // A 16-bit float between ½ and 1 has steps of 2^-11; the reversed depth at 9 m has steps of 2^-20.
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::f16, DepthEncoding::linear), layout, 6.0), 4.883e-3, 1e-6);
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::f16, DepthEncoding::reversed), layout, 9.0), 7.648e-4, 1e-6);
  // A float between ½ and 1 has steps of 2^-24; the reversed depth at 9 m, 0.00112, has steps of 2^-33.
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::f32, DepthEncoding::linear), layout, 6.0), 5.96e-7, 1e-9);
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::f32, DepthEncoding::perspective), layout, 9.0), 4.78e-5, 1e-7);
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::f32, DepthEncoding::reversed), layout, 9.0), 9.34e-8, 1e-10);
  // An orthographic projection has no perspective depth.
  layout.kind = MapKind::orthographic;
  EXPECT_NEAR(depth_step(stored_as(MapDepthFormat::fixed16, DepthEncoding::perspective), layout, 5.0), 1.526e-4, 1e-7);
}

TEST_F(MapDepthGl, Nothing_before_the_near_plane_of_a_perspective_encoding_casts) {
  Scene scene = make_floor();
  const std::uint32_t plate = add_mesh(scene, quad({-4, 2, 4}, {4, 2, 4}, {4, 2, -4}, {-4, 2, -4}));
  const Light light = spot_light({0, 2.5, 0.01}, {0, 0, 0}, 0.5);
  const MapLayout layout = fit_light(light, bounds_of(scene), 32);
  const std::size_t middle = 16 * 32 + 16;
  EXPECT_EQ(
      draw(scene, light, layout, stored_as(MapDepthFormat::f32, DepthEncoding::reversed, 0.4)).instance[0][middle],
      plate);
  EXPECT_EQ(
      draw(scene, light, layout, stored_as(MapDepthFormat::f32, DepthEncoding::reversed, 0.6)).instance[0][middle], 0u);
  EXPECT_EQ(draw(scene, light, layout, stored_as(MapDepthFormat::f32, DepthEncoding::linear, 0.6)).instance[0][middle],
            plate);
}

// A plane across the light's axis, whose depth does not change from texel to texel.
TEST_F(MapDepthGl, The_measured_unit_of_the_polygon_offset_is_the_shift_that_is_found) {
  const Scene scene = make_floor();
  for (const Light& light : {directional_light({0, 1, 0}), spot_light({0, 3, 0}, {0, 0, 0}, 0.7)}) {
    MapLayout layout = fit_light(light, bounds_of(scene), 16);
    layout.far_depth = 5.0;
    if (layout.kind == MapKind::orthographic) {
      layout.light_from_world[3] = dvec4(0, 0, -3, 1);
    }
    const double depth = depth_of(layout, dvec3(0));
    ASSERT_NEAR(depth, 3.0, 1e-9);
    for (const MapDepthFormat format : formats) {
      const double unit = measure_offset_unit(context(), format);
      const double expected_unit = format == MapDepthFormat::fixed16 ? 0x1p-16 : 0x1p-24;
      EXPECT_GT(unit, 0.49 * expected_unit);
      EXPECT_LT(unit, 2.01 * expected_unit);
      for (const DepthEncoding encoding : encodings) {
        MapDepthParams params = stored_as(format, encoding, 0.5);
        const auto depth_at_middle = [&] {
          return static_cast<double>(draw(scene, light, layout, params).depth[0].at(8, 8)) * layout.far_depth;
        };
        const double plain = depth_at_middle();
        // Enough that the linear 32-bit float, in which the depth is read back, resolves it.
        params.polygon_offset_units = format == MapDepthFormat::fixed16 ? 200.0 : 20000.0;
        const double shifted = depth_at_middle();
        const int mapping = depth_mapping(params, layout);
        const double stored = shared::encode_depth(mapping, depth, 0.5, 5.0);
        const bool is_float = format != MapDepthFormat::fixed24 && format != MapDepthFormat::fixed16;
        const double scale = is_float ? std::exp2(std::ilogb(stored) + 1) : 1.0;
        const double shift = params.polygon_offset_units * unit * scale;
        const bool is_reversed = encoding == DepthEncoding::reversed;
        const double expected =
            shared::decode_depth(mapping, stored + (is_reversed ? -shift : shift), 0.5, 5.0) - depth;
        EXPECT_NEAR(shifted - plain, expected, 0.01 * expected + depth_step(params, layout, 3.0) + 1e-6)
            << static_cast<int>(format) << static_cast<int>(encoding) << static_cast<int>(layout.kind);
      }
    }
  }
}

// Factor times the largest difference to the next texel, in x or y: t tan θ max(|cos ψ|, |sin ψ|) of an orthographic
// map.
TEST_F(MapDepthGl, The_factor_of_the_polygon_offset_counts_slopes_per_texel) {
  Scene scene;
  add_mesh(scene, ground(60));
  const double theta = 50.0 * degrees;
  const double psi = 25.0 * degrees;
  const MapLayout layout = exact_layout({std::sin(theta), std::cos(theta), 0}, 64, 0.1, psi);
  MapDepthParams params;
  const std::vector<Image<float>> plain = to_metres(draw(scene, light_of(layout), layout), layout);
  params.polygon_offset_factor = 2.0;
  const std::vector<Image<float>> shifted = to_metres(draw(scene, light_of(layout), layout, params), layout);
  const double expected = 2.0 * 0.1 * std::tan(theta) * std::cos(psi);
  for (std::size_t i = 0; i < plain[0].size(); ++i) {
    ASSERT_NEAR(static_cast<double>(shifted[0][i] - plain[0][i]), expected, 1e-4);
  }
  // Where a shader adds it.
  const Scene floor = make_floor();
  for (const Light& light : {lights()[1], lights()[2]}) {
    const MapLayout fitted = fit_light(light, bounds_of(floor), 128);
    const std::vector<Image<float>> bare = to_metres(draw(floor, light, fitted), fitted);
    const std::vector<Image<float>> moved = to_metres(draw(floor, light, fitted, params), fitted);
    int compared = 0;
    for (std::size_t view = 0; view < bare.size(); ++view) {
      for (int y = 1; y < 127; ++y) {
        for (int x = 1; x < 127; ++x) {
          const auto at = [&](int dx, int dy) { return static_cast<double>(bare[view].at(x + dx, y + dy)); };
          const double slope_x = 0.5 * std::abs(at(1, 0) - at(-1, 0));
          const double slope_y = 0.5 * std::abs(at(0, 1) - at(0, -1));
          const auto shifted_depth = static_cast<double>(moved[view].at(x, y));
          if (!std::isfinite(at(0, 0) + slope_x + slope_y + shifted_depth)) continue;  // beyond the far plane
          const double slope = std::max(slope_x, slope_y);
          // A shader's differences are those of a quad of two by two texels: half a texel to either side.
          const double curvature = std::max(std::abs(at(1, 0) - 2.0 * at(0, 0) + at(-1, 0)),
                                            std::abs(at(0, 1) - 2.0 * at(0, 0) + at(0, -1)));
          ASSERT_NEAR(shifted_depth - at(0, 0), 2.0 * slope, 1.1 * curvature + 0.02 * slope + 2e-5);
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 1000);
  }
}

TEST_F(MapDepthGl, The_range_of_depths_is_that_of_the_map) {
  const Scene scene = make_floor();
  for (const Light& light : lights()) {
    const MapLayout layout = fit_light(light, bounds_of(scene), 64);
    const ShadowMap map = draw_shadow_map(context(), upload(context(), scene), light, layout);
    double nearest = layout.far_depth;
    double farthest = 0.0;
    for (const Image<float>& view : read_back(context(), map).depth) {
      for (const float depth : view.pixels) {
        if (depth >= 1.0f) continue;
        nearest = std::min(nearest, static_cast<double>(depth) * layout.far_depth);
        farthest = std::max(farthest, static_cast<double>(depth) * layout.far_depth);
      }
    }
    const std::optional<DepthRange> range = depth_range_of(context(), map);
    ASSERT_TRUE(range);
    EXPECT_EQ(range->nearest, nearest);
    EXPECT_EQ(range->farthest, farthest);
    EXPECT_FALSE(depth_range_of(context(), draw_shadow_map(context(), upload(context(), Scene{}), light, layout)));
  }
}

TEST_F(MapDepthGl, Parameters_that_make_no_sense_are_errors_that_name_them) {
  const Scene scene = make_floor();
  const Light light = spot_light({0, 3, 0}, {0, 0, 0}, 0.7);
  const MapLayout layout = fit_light(light, bounds_of(scene), 16);
  MapDepthParams offset = of_surface(StoredSurface::dual);
  offset.polygon_offset_units = 1.0;
  struct Case {
    MapDepthParams params;
    std::string name;
  };
  for (const Case& c : {Case{stored_as(MapDepthFormat::f32, DepthEncoding::perspective, 50.0), "shadow.depth-near"},
                        Case{offset, "shadow.surface"}}) {
    try {
      draw(scene, light, layout, c.params);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find(c.name), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace umbrameter
