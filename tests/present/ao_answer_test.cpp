// What the console says of ambient occlusion.
#include <gtest/gtest.h>

#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

AoMeasurement measurement() {
  AoMeasurement ao;
  ao.experiment.ao.sampling.radius = 0.5;
  ao.experiment.truth.ao_distance = 0.5;
  ao.truth = TracedAo{};
  ao.truth->ao = Image<float>(2, 2, 1.0f);
  ao.raster = Image<float>(2, 2, 0.5f);
  ao.statistics = AoStatistics{};
  ao.statistics->error.pixels = 4;
  return ao;
}

TEST(AoAnswer, Absolute_and_signed_error_have_the_digits_of_the_wider_interval) {
  AoMeasurement ao = measurement();
  SampledError& error = ao.statistics->error;
  // Half widths of 0.0535 % and 0.0022 %: two digits of the wider one are three decimals.
  error.mae = {0.107503, 0.106452, 0.107522};
  error.mean_error = {-0.089738, -0.08976, -0.089716};
  EXPECT_EQ(present_ao({}, ao).answers.at(0),
            "AO: mean absolute error 10.645 to 10.752 %, mean signed error −8.974 ± 0.002 %, too dark (95 % intervals, "
            "for the noise of the rays; SSAO "
            "radius 50 cm, reference rays up to 50 cm)");
  // An interval so much narrower that it would read as ± 0.00 is rounded up.
  error.mae = {0.064, 0.0637, 0.0658};
  EXPECT_NE(present_ao({}, ao).answers.at(0).find("6.37 to 6.58 %, mean signed error −8.97 ± 0.01 %, too dark ("),
            std::string::npos)
      << present_ao({}, ao).answers.at(0);
  // An exact reference: no interval.
  error.mae = {0.107503, 0.107503, 0.107503};
  error.mean_error = {0.089738, 0.089738, 0.089738};
  EXPECT_EQ(present_ao({}, ao).answers.at(0),
            "AO: mean absolute error 10.8 %, mean signed error +8.97 %, too bright (SSAO radius 50 cm, reference rays "
            "up to 50 cm)");
}

TEST(AoAnswer, An_error_stands_beside_that_of_no_ambient_occlusion) {
  AoMeasurement ao = measurement();
  SampledError& error = ao.statistics->error;
  error.mae = {0.1, 0.1, 0.1};
  error.mean_truth = {0.8, 0.8, 0.8};
  EXPECT_EQ(present_ao({}, ao).lines.front(), "  AO: without any AO the mean absolute error would be 20.0 %");
  error.mean_truth = {0.8, 0.798, 0.802};
  EXPECT_EQ(present_ao({}, ao).lines.front(), "  AO: without any AO the mean absolute error would be 20.00 ± 0.20 %");
  error.mean_truth = {0.95, 0.95, 0.95};
  EXPECT_EQ(present_ao({}, ao).answers.back().find(
                "warning: no AO at all would be closer to the reference: its error is 5.00 %"),
            0u)
      << present_ao({}, ao).answers.back();
  // The noise of the reference may have raised 3.9 % to 4.2 %: AO may be better than none or worse.
  error.mae = {0.042, 0.027, 0.0422};
  error.mean_truth = {0.961, 0.9606, 0.9614};
  EXPECT_EQ(
      present_ao({}, ao).answers.back(),
      "warning: no AO at all may be as close to the reference, or closer: its error is 3.900 ± 0.040 %; more rays "
      "(--truth.spp) would tell");
  // Intervals that do not touch decide, although 1 % is "about as close".
  error.mae = {0.0398, 0.0397, 0.0399};
  error.mean_truth = {0.9605, 0.9604, 0.9606};
  EXPECT_EQ(present_ao({}, ao).answers.back(),
            "warning: no AO at all would be closer to the reference: its error is 3.950 ± 0.010 %");
  error.mae = {0.0391, 0.0390, 0.0392};
  EXPECT_EQ(present_ao({}, ao).answers.size(), 1u) << "AO is better";
  error.mean_truth = {0.961, 0.9606, 0.9614};
  error.mae = {0.0365, 0.027, 0.0370};
  EXPECT_EQ(present_ao({}, ao).answers.size(), 1u) << "AO is better";
  error.mae = {0.1, 0.1, 0.1};
  error.mean_truth = {0.9005, 0.9005, 0.9005};
  EXPECT_EQ(present_ao({}, ao).answers.back(),
            "warning: no AO at all would be about as close to the reference: its error is 9.95 %");
}

TEST(AoAnswer, An_error_of_rounding_has_no_row_of_zeros) {
  AoMeasurement ao = measurement();
  ao.statistics->error.mae = {0.0, 0.0, 9e-8};
  ao.statistics->error.mean_error = {0.0, -9e-8, 9e-8};
  EXPECT_EQ(
      present_ao({}, ao).answers.at(0).find("AO: mean absolute error below 0.0001 %, mean signed error 0.0000 % ("), 0u)
      << present_ao({}, ao).answers.at(0);
}

TEST(AoAnswer, Where_both_look_equally_far_one_distance_is_given) {
  AoMeasurement ao = measurement();
  ao.experiment.ao.technique = AoTechniques::choice<Alchemy>;
  expect_words(present_ao({}, ao).section.text, {"Technique and reference look for occluders up to 50 cm."});
  ao.experiment.truth.ao_distance = 2.0;
  expect_words(present_ao({}, ao).section.text,
               {"The technique looks for occluders up to 50 cm, the reference up to 2 m."});
}

// The points of SSAO lie within the radius, what hides them in the image may not.
TEST(AoAnswer, A_technique_that_tests_points_is_not_said_to_limit_the_distance_of_occluders) {
  AoMeasurement ao = measurement();
  expect_words(present_ao({}, ao).section.text,
               {"The reference looks for occluders up to 50 cm. The technique tests points up to 50 cm away:",
                "The range check fades out surfaces whose depth differs from the pixel's by more than 50 cm."});
  ao.experiment.ao.ssao.range_check = false;
  expect_words(present_ao({}, ao).section.text, {"from any distance, as ao.range-check is false"});
}

// Its rays start at the pixel's centre whatever the reference of shadows does.
TEST(AoAnswer, Shadows_over_whole_pixels_do_not_change_what_is_said_of_its_rays) {
  AoMeasurement ao = measurement();
  ao.truth->precision.pixels = 4;
  const std::string text = present_ao({}, ao).section.text;
  expect_words(text, {"rays per pixel on average, the interval"});
  ao.experiment.truth.shadow = ShadowReference::pixel;
  EXPECT_EQ(present_ao({}, ao).section.text, text);
}

TEST(AoAnswer, A_falloff_without_an_end_is_no_limit) {
  AoMeasurement ao = measurement();
  ao.experiment.truth.ao_falloff = AoFalloff::ssao;
  expect_words(present_ao({}, ao).answers.at(0), {"reference rays without distance limit, fading out beyond 50 cm"});
}

TEST(AoAnswer, A_stage_that_changes_more_than_the_error_is_said_to_be_undone_in_part) {
  AoMeasurement ao = measurement();
  ao.stages = AoStages{};
  for (Image<float>& image : ao.stages->images.accessibility) image = Image<float>(2, 2, 1.0f);
  AoStageStatistics& statistics = ao.stages->statistics;
  statistics.total.pixels = 4;
  statistics.total.rmse.value = 0.1;
  AoStageError& thin = statistics.stages[static_cast<std::size_t>(AoStage::thin)];
  thin.mean.value = -0.05;
  thin.rms.value = 0.2;
  const std::string thin_is =
      "AO by stage: 'thin' (everything behind the visible surface counts as solid, as thick as the method assumes) has "
      "the largest RMS, ";
  EXPECT_EQ(present_ao_stages({}, ao).lines.at(0),
            thin_is + "20.0 % (mean −5.00 %), partly undone by other stages; all stages together: RMS 10.0 %");
  statistics.total.rmse.upper = 0.2;
  EXPECT_EQ(present_ao_stages({}, ao).lines.at(0), thin_is + "20.0 % (mean −5.00 %); all stages together: RMS 10.0 %");
  thin.rms.value = 0.05;
  EXPECT_EQ(present_ao_stages({}, ao).lines.at(0), thin_is + "5.00 % (mean −5.00 %); all stages together: RMS 10.0 %");
}

}  // namespace
}  // namespace umbrameter
