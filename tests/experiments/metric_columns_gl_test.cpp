// Image metrics are columns of sweeps, and each has the value that a comparison of its cell reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/measure/measure_image.h"
#include "experiments/sweep/sweep_table.h"
#include "results/known_statistics.h"
#include "tests/experiments/two_occluders_gl.h"

namespace umbrameter {
namespace {

constexpr const char* shadow_metrics = "ldr-flip,ssim,mae,edge-displacement,edge-roughness,edge-width,edges-found";

class MetricColumnsGl : public TwoOccludersGl {
 protected:
  void SetUp() override {
    TwoOccludersGl::SetUp();
    experiment_.view.size = {160, 90};
    experiment_.truth.spp = 16;
    experiment_.run.metrics = shadow_metrics;
  }

  static double value(const Table& table, std::size_t row, const std::string& name) {
    return to_number(table.rows[row][column_index(table, name)]);
  }

  // Every score has a column of the sweep with the same value, unless a described statistic has its name.
  static std::size_t expect_scores(const Table& table, std::size_t row, const std::vector<MetricScore>& scores) {
    std::size_t known = 0;
    for (const MetricScore& scored : scores) {
      const double found = value(table, row, scored.column.name);
      if (std::isnan(scored.score)) {
        EXPECT_TRUE(std::isnan(found)) << scored.column.name;
        continue;
      }
      EXPECT_NEAR(found, scored.score, scored.column.name == "mae" ? 1e-6 : 0.0) << scored.column.name;
      ++known;
    }
    return known;
  }
};

TEST_F(MetricColumnsGl, Of_biases_that_one_pass_measures) {
  const Table table =
      sweep_table(*stages_, experiment_, {"shadow.constant-bias=0.5texels,2texels", "shadow.filter=nearest,box"});
  ASSERT_EQ(table.rows.size(), 4u);
  for (std::size_t row = 0; row < 4; ++row) {
    Experiment cell = experiment_;
    cell.shadow.bias.constant = {row < 2 ? 0.5 : 2.0, LengthUnit::texels};
    cell.shadow.pcf.filter = row % 2 == 0 ? ShadowFilter::nearest : ShadowFilter::box;
    const ShadowMeasurement measured = measure_shadow(*stages_, cell, 0, {});
    EXPECT_EQ(measured.metrics.size(), 13u) << "seven metrics, three of them in texels and metres too";
    EXPECT_GE(expect_scores(table, row, measured.metrics), 10u);
  }
  EXPECT_NE(value(table, 0, "ldr-flip"), value(table, 1, "ldr-flip"));
}

TEST_F(MetricColumnsGl, Of_a_technique_without_causes) {
  experiment_.shadow.technique = ShadowTechniques::choice<Vsm>;
  const Table table = sweep_table(*stages_, experiment_, {"shadow.constant-bias=0.5texels,2texels"});
  for (std::size_t row = 0; row < 2; ++row) {
    Experiment cell = experiment_;
    cell.shadow.bias.constant = {row == 0 ? 0.5 : 2.0, LengthUnit::texels};
    EXPECT_GE(expect_scores(table, row, measure_shadow(*stages_, cell, 0, {}).metrics), 10u);
  }
}

TEST_F(MetricColumnsGl, Of_ambient_occlusion_in_one_pass_and_cell_by_cell) {
  experiment_.run.metrics = "ldr-flip,psnr";
  for (const AoBlur blur : {AoBlur::none, AoBlur::box}) {
    experiment_.ao.blur.kind = blur;
    const Table table = sweep_table(*stages_, experiment_, {"ao.power=1,2"});
    for (std::size_t row = 0; row < 2; ++row) {
      Experiment cell = stages_->in_metres(experiment_);
      cell.ao.tone.power = row == 0 ? 1.0 : 2.0;
      EXPECT_EQ(expect_scores(table, row, measure_ao(*stages_, cell, {}).metrics), 2u);
    }
  }
}

TEST_F(MetricColumnsGl, Of_the_shaded_image) {
  experiment_.run.metrics = "ldr-flip,hdr-flip,ssim,edge-roughness";
  experiment_.run.measure = SweepMeasure::image;
  const Table table = sweep_table(*stages_, experiment_, {"shadow.filter=nearest,tent"});
  Experiment cell = stages_->in_metres(experiment_);
  cell.shadow.pcf.filter = ShadowFilter::nearest;
  const ImageMeasurement measured = measure_image(*stages_, cell, stages_->lights(""), {});
  EXPECT_EQ(measured.metrics.size(), 4u) << "an image has no texels";
  EXPECT_GE(expect_scores(table, 0, measured.metrics), 3u);
}

TEST_F(MetricColumnsGl, Are_absent_unless_named) {
  experiment_.run.metrics = "";
  const Table table = sweep_table(*stages_, experiment_, {"shadow.constant-bias=0.5texels,2texels"});
  EXPECT_THROW(column_index(table, "ldr-flip"), std::out_of_range);
  EXPECT_EQ(table.rows[0].size(), table.columns.size());
}

TEST(KnownMetrics, Each_unit_of_an_edge_metric_of_shadows_measures_the_metric) {
  EXPECT_EQ(metric_to_measure("edge-roughness-texels"), "edge-roughness");
  EXPECT_EQ(metric_to_measure("shadow.edge-displacement-m"), "edge-displacement");
  EXPECT_EQ(metric_to_measure("image.ldr-flip"), "ldr-flip");
  EXPECT_EQ(metric_to_measure("mae"), "");
  EXPECT_THROW(require_statistic({"ao", "edge-roughness-m"}, "--fail-if"), Error);
}

}  // namespace
}  // namespace umbrameter
