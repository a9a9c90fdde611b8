#include "compare/ao_stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/random.h"

namespace umbrameter {
namespace {

constexpr int columns = 24;
constexpr int rows = 16;

// Stage k changes every pixel by a random amount about `step_of(k)`.
double step_of(std::size_t k) { return 0.01 * (static_cast<double>(k) - 2.5); }

AoStageImages random_images() {
  AoStageImages images;
  images.accessibility[0] = Image<float>(columns, rows);
  for (std::size_t i = 0; i < images.accessibility[0].size(); ++i) {
    images.accessibility[0][i] = 0.4f + 0.3f * to_unit_float(hash(static_cast<std::uint32_t>(i), 7u));
  }
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    images.accessibility[k + 1] = images.accessibility[k];
    for (std::size_t i = 0; i < images.accessibility[k].size(); ++i) {
      const float noise = to_unit_float(hash(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k))) - 0.5f;
      images.accessibility[k + 1][i] += static_cast<float>(step_of(k)) + 0.02f * noise;
    }
  }
  return images;
}

GBuffer surfaces() {
  GBuffer gbuffer(columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const std::size_t i = gbuffer.instance.index(x, y);
      if (x < 2) continue;  // background
      gbuffer.instance[i] = 0;
      gbuffer.position[i] = vec3(x, y, -5.0f);
      gbuffer.geometric_normal[i] = vec3(0, 0, 1);
      gbuffer.depth[i] = 1.0f + static_cast<float>(x);
    }
  }
  return gbuffer;
}

View orthographic() {
  View view{columns, rows, {}};
  view.camera.projection = OrthographicProjection{8.0, 8.0, 0.1, 100.0};
  return view;
}

TEST(AoStages, Signed_means_add_up_to_the_total_in_linear_and_in_sRGB) {
  const AoStageImages images = random_images();
  const GBuffer gbuffer = surfaces();
  const AoStageStatistics s = analyze_ao_stages(images, [&](std::size_t i) { return gbuffer.is_surface(i); });
  EXPECT_EQ(s.total.pixels, static_cast<std::uint64_t>((columns - 2) * rows));
  double sum = 0.0;
  double srgb = 0.0;
  for (const AoStageError& stage : s.stages) {
    sum += stage.mean.value;
    srgb += stage.srgb_mean;
  }
  EXPECT_NEAR(sum, s.total.mean_error.value, 1e-12);
  EXPECT_NEAR(srgb, s.srgb_mean_error, 1e-12);
  // Uniform noise of columns 0.02 has the variance 0.02²/12.
  for (std::size_t k = 0; k < ao_stage_count; ++k) {
    EXPECT_NEAR(s.stages[k].mean.value, step_of(k), 1e-3) << k;
    EXPECT_NEAR(s.stages[k].rms.value, std::sqrt(step_of(k) * step_of(k) + 0.02 * 0.02 / 12.0), 1e-3) << k;
  }
}

TEST(AoStages, An_error_of_one_pixel_in_four_has_the_PSNR_of_its_encoded_difference) {
  // sRGB of 0.5 is 0.735357, of 0.25 it is 0.537099 (IEC 61966-2-1): mse = 0.198258²/4, psnr = −10 log₁₀ mse.
  AoStageImages images;
  for (Image<float>& image : images.accessibility) image = Image<float>(2, 2, 0.5f);
  images.accessibility.back()[3] = 0.25f;
  const AoStageStatistics s = analyze_ao_stages(images, [](std::size_t) { return true; });
  EXPECT_NEAR(s.srgb_mse, 0.198258 * 0.198258 / 4.0, 1e-6);
  EXPECT_NEAR(s.srgb_psnr, 20.0757, 1e-3);
  EXPECT_NEAR(s.srgb_mean_error, -0.198258 / 4.0, 1e-6);
  EXPECT_DOUBLE_EQ(s.stages[static_cast<std::size_t>(AoStage::blur)].mean.value, -0.0625);
}

TEST(AoStages, Noise_of_the_references_is_not_taken_for_an_error) {
  // Every stage changes nothing but by noise of variance 0.01; the corrected RMS is near 0.
  AoStageImages images;
  images.degrees_of_freedom = 7;
  constexpr int side = 128;
  for (std::size_t k = 0; k <= ao_stage_count; ++k) images.accessibility[k] = Image<float>(side, side, 0.5f);
  Image<float>& model = images.accessibility[1];
  for (std::size_t i = 0; i < model.size(); ++i) {
    // Uniform of columns √12 · 0.1.
    model[i] += 0.34641f * (to_unit_float(hash(static_cast<std::uint32_t>(i), 3u)) - 0.5f);
  }
  images.variance[0] = images.variance[1] = Image<float>(side, side, 0.01f);
  images.samples[0] = images.samples[1] = Image<float>(side, side, 64.0f);
  const AoStageStatistics s = analyze_ao_stages(images, [](std::size_t) { return true; });
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_LT(s.stages[k].rms.value, 0.02) << k;  // 0.1 without the correction
    EXPECT_LE(s.stages[k].mean.lower, 0.0) << k;
    EXPECT_GE(s.stages[k].mean.upper, 0.0) << k;
  }
}

TEST(AoStages, The_bins_of_each_split_hold_every_surface_pixel_once) {
  const AoStageImages images = random_images();
  const GBuffer gbuffer = surfaces();
  // A depth edge between the columns 11 and 12.
  const auto is_joined = [](std::size_t a, std::size_t b) { return !(a % columns == 11 && b % columns == 12); };
  const std::vector<AoStageBin> bins = split_ao_stages(images, gbuffer, orthographic(), is_joined);
  const AoStageStatistics all = analyze_ao_stages(images, [&](std::size_t i) { return gbuffer.is_surface(i); });
  for (const std::string split : {"depth", "cosine_to_viewer", "depth_edge_distance", "image_edge_distance", "error"}) {
    std::uint64_t pixels = 0;
    double error = 0.0;
    for (const AoStageBin& bin : bins) {
      if (bin.split != split) continue;
      pixels += bin.statistics.total.pixels;
      if (bin.statistics.total.pixels == 0) continue;
      error += static_cast<double>(bin.statistics.total.pixels) * bin.statistics.total.mean_error.value;
    }
    EXPECT_EQ(pixels, all.total.pixels) << split;
    EXPECT_NEAR(error / static_cast<double>(pixels), all.total.mean_error.value, 1e-12) << split;
  }
  for (const AoStageBin& bin : bins) {
    if (bin.statistics.total.pixels == 0) continue;
    EXPECT_EQ(std::isnan(bin.statistics.total.mean_error.lower), bin.split == "error")
        << "pixels that the noisy error selects have no interval";
    EXPECT_EQ(std::isnan(bin.statistics.stages[0].mean.upper), bin.split == "error");
  }
  // Two columns to either side have a centre within 2 px of the edge.
  for (const AoStageBin& bin : bins) {
    if (bin.split != "depth_edge_distance" || bin.first != 0.0) continue;
    EXPECT_EQ(bin.statistics.total.pixels, static_cast<std::uint64_t>(4 * rows));
  }
}

TEST(AoStages, The_table_has_a_row_for_all_pixels_and_one_for_each_bin) {
  const AoStageImages images = random_images();
  const GBuffer gbuffer = surfaces();
  const AoStageStatistics all = analyze_ao_stages(images, [&](std::size_t i) { return gbuffer.is_surface(i); });
  const std::vector<AoStageBin> bins =
      split_ao_stages(images, gbuffer, orthographic(), [](std::size_t, std::size_t) { return true; });
  const Table table = ao_stage_table(all, bins);
  ASSERT_EQ(table.rows.size(), bins.size() + 1);
  for (const std::vector<Value>& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_EQ(to_string(table.rows[0][0]), "all");
  EXPECT_DOUBLE_EQ(to_number(table.rows[0][column_index(table, "thin_mean")]),
                   all.stages[static_cast<std::size_t>(AoStage::thin)].mean.value);
}

}  // namespace
}  // namespace umbrameter
