// No stage may answer from a result that an earlier experiment left behind.
#include "tests/experiments/stages_gl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "experiments/measure/measure.h"
#include "experiments/measure/measure_image.h"
#include "experiments/stages/stages.h"
#include "experiments/sweep/sweep_evaluator.h"
#include "experiments/sweep/sweep_table.h"

namespace umbrameter {
namespace {

class StagesGl : public ContactBoxGl {
 protected:
  // Beginnings of the keys that a setting can interact with.
  using Groups = std::vector<std::string_view>;
  static inline const Groups all_groups = {""};
  static inline const Groups of_shadows = {"shadow.", "light.", "truth.", "view."};
  static inline const Groups of_ao = {"ao.", "truth.", "view."};
  static inline const Groups of_look_ups = {"shadow."};

  // What a run yields for the first light, as values that compare bit by bit: of shadows alone where their groups are
  // varied, of ambient occlusion alone where its are.
  static std::vector<float> measure(Stages& stages, const Experiment& experiment, const Groups& groups) {
    std::vector<float> all;
    const auto add = [&](const Image<float>& image) {
      all.insert(all.end(), image.pixels.begin(), image.pixels.end());
    };
    if (groups == of_ao || groups == all_groups) {
      const AoMeasurement ao = measure_ao(stages, experiment, {});
      add(*ao.raster);
      add(ao.truth->ao);
    }
    if (groups == of_ao) return all;
    const ShadowMeasurement shadow = measure_shadow(stages, experiment, 0, {});
    add(shadow.raster->visibility);
    add(shadow.truth->visibility);
    for (const uvec4& wrong : shadow.raster->wrong.weights.pixels) {
      for (int c = 0; c < 4; ++c) all.push_back(static_cast<float>(wrong[c]));
    }
    if (experiment.run.measure != SweepMeasure::image) return all;
    const std::vector<std::uint32_t> lights = {0};
    const ImageMeasurement image = measure_image(stages, experiment, lights, {});
    for (const Image<vec3>* colors : {&image.raster->radiance, &*image.truth}) {
      for (const vec3& color : colors->pixels) all.insert(all.end(), {color.x, color.y, color.z});
    }
    ImageStatistics statistics = *image.statistics;
    for (const Value& value : row_of(describe(statistics))) {
      if (const auto* number = std::get_if<double>(&value)) all.push_back(static_cast<float>(*number));
    }
    return all;
  }

  void expect_fresh(const std::vector<std::string>& settings, const Groups& groups) const {
    const std::unique_ptr<Stages> kept = make_stages();
    Experiment experiment = base(settings);
    const std::vector<float> fresh_base = measure(*make_stages(), experiment, groups);
    std::size_t varied = 0;
    for (const Parameter& parameter : describe(experiment)) {
      const bool selects_scene = parameter.key.starts_with("scene.") || parameter.key == "view.scene";
      const std::vector<std::string> values = values_of(parameter);
      const bool is_in_groups =
          std::ranges::any_of(groups, [&](std::string_view group) { return parameter.key.starts_with(group); });
      if (selects_scene || values.size() < 2 || !is_in_groups) continue;
      ++varied;
      for (const std::string& value : values) {
        Experiment changed = base(settings);
        require(describe(changed), parameter.key).set_text(value);
        std::vector<float> again;
        try {
          again = measure(*kept, changed, groups);
        } catch (const Error&) {
          continue;  // the value makes no sense for this light
        }
        const bool is_base = parameter.value() == require(describe(changed), parameter.key).value();
        EXPECT_TRUE(again == (is_base ? fresh_base : measure(*make_stages(), changed, groups)))
            << parameter.key << " = " << value;
      }
    }
    EXPECT_GT(varied, 30u);
  }

  // The cells of one sweep against a fresh run of each.
  void expect_single_runs(const std::vector<std::string>& settings, const std::vector<std::string>& axes) const {
    const std::unique_ptr<Stages> stages = make_stages();
    const Experiment experiment = base(settings);
    const Table table = sweep_table(*stages, experiment, axes);
    ASSERT_GE(table.rows.size(), 2u);
    for (const std::vector<Value>& row : table.rows) {
      Experiment cell = experiment;
      const Parameters parameters = describe(cell);
      for (std::size_t a = 0; a < axes.size(); ++a) {
        const std::string& column = table.columns[a].name;
        std::string value = to_string(row[a]);
        if (axes[a].ends_with("texels")) value += "texels";
        require(parameters, column).set_text(value);
      }
      const std::unique_ptr<Stages> fresh = make_stages();
      const ShadowMeasurement shadow = measure_shadow(*fresh, cell, 0, {});
      ShadowStatistics single = *shadow.statistics;
      // Beside techniques without causes, those with causes are measured by edge distance.
      if (row.size() == axes.size() + row_of(EdgeStatistics{}).size() &&
          std::holds_alternative<VisibilityStatistics>(single)) {
        single = analyze_shadow(*fresh, cell, 0, ShadowKind::by_edges, *shadow.raster, shadow.counted);
      }
      const std::vector<Value> expected = std::visit([](auto& each) { return row_of(describe(each)); }, single);
      ASSERT_EQ(row.size(), axes.size() + expected.size());
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), row.begin() + static_cast<std::ptrdiff_t>(axes.size())))
          << axes.front();
    }
  }
};

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_GTAO) {
  expect_fresh({"ao.technique=gtao"}, of_ao);
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_a_box_filter) {
  expect_fresh({"shadow.filter=box"}, of_shadows);
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_cascades) {
  expect_fresh(
      {"shadow.cascades=3", "shadow.fit=view", "shadow.cascade-fit=stable", "shadow.split-range=camera",
       "shadow.max-distance=12", "shadow.cascade-selection=depth", "shadow.cascade-blend=0.2", "shadow.pancaking=true"},
      of_shadows);
  expect_fresh({"shadow.fit=bounds", "shadow.fit-size=6"}, of_look_ups);
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_a_disk) {
  expect_fresh({"shadow.filter=poisson"}, of_look_ups);
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_a_filtered_map) {
  expect_fresh({"shadow.technique=esm"}, of_shadows);
  for (const std::string technique : {"vsm", "msm", "csm"})
    expect_fresh({"shadow.technique=" + technique}, of_look_ups);
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_screen_space_shadows) {
  expect_fresh({"shadow.technique=screen-space"}, of_shadows);
  expect_fresh({"shadow.technique=pcf", "shadow.contact-shadows=true"}, of_look_ups);
}

TEST_F(StagesGl, A_sweep_that_switches_contact_shadows_on_splits_every_error_by_sign_and_edge_distance) {
  const std::unique_ptr<Stages> stages = make_stages();
  const Table table = sweep_table(*stages, base({"shadow.technique=pcf"}), {"shadow.contact-shadows=false,true"});
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.columns.size(), 1 + row_of(EdgeStatistics{}).size());
  EXPECT_NE(table.rows[0], table.rows[1]);
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_other_depths_of_a_point_light) {
  has_point_light_ = true;
  expect_fresh({"shadow.surface=dual", "shadow.depth-encoding=perspective", "shadow.depth-format=24"}, of_shadows);
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_an_area_light) {
  expect_fresh({"light.angle=2"}, of_shadows);
  for (const std::string technique : {"pcss", "dpcf"}) {
    expect_fresh({"light.angle=2", "shadow.technique=" + technique}, of_look_ups);
  }
}

TEST_F(StagesGl, Every_parameter_varied_gives_what_fresh_stages_give_with_a_deferred_image) {
  expect_fresh({"run.measure=image", "shading.path=deferred"}, all_groups);
}

TEST_F(StagesGl, Refuse_a_length_of_ambient_occlusion_that_is_not_in_metres) {
  const std::unique_ptr<Stages> stages = make_stages();
  for (const std::string setting : {"ao.radius=2%", "ao.bias=1%", "truth.ao-distance=auto"}) {
    const Experiment relative = base({setting});
    if (setting.starts_with("ao.")) {
      EXPECT_THROW(stages->draw_ao(relative), Error) << setting;
    } else {
      EXPECT_THROW(stages->ao_truth(relative), Error) << setting;
      EXPECT_THROW(stages->begin_ao_truth(relative), Error) << setting;
    }
    EXPECT_NO_THROW(measure_shadow(*stages, relative, 0, {})) << "shadows read no length of ambient occlusion";
    EXPECT_NO_THROW(measure_ao(*stages, stages->in_metres(relative), {})) << setting;
  }
}

TEST_F(StagesGl, One_pass_measures_ambient_occlusion_at_every_bias_number_of_samples_and_tone_like_single_runs) {
  const std::vector<std::string> axes = {"ao.power=1,2.2", "ao.bias=0,0.05,0.01,1", "truth.ao-distance=0.3,0.2",
                                         "ao.samples=5,8,1", "ao.intensity=1,1.4"};
  for (const std::string kernel : {"progressive", "learnopengl"}) {
    const std::vector<std::string> settings = {"ao.kernel=" + kernel, "ao.blur=none"};
    const std::unique_ptr<Stages> stages = make_stages();
    const Experiment experiment = base(settings);
    const SweptQuantity ao = SweptQuantity::ao;
    std::vector<SweepAxis> parsed;
    Experiment described = experiment;
    for (const std::string& axis : axes) parsed.push_back(parse_axis(describe(described), axis));
    EXPECT_EQ(inner_keys(experiment, parsed, ao).size(), kernel == "progressive" ? 4u : 3u);
    const Table table = sweep_table(*stages, experiment, axes);
    ASSERT_EQ(table.rows.size(), 2u * 4 * 2 * 3 * 2);
    for (const std::vector<Value>& row : table.rows) {
      Experiment cell = experiment;
      const Parameters parameters = describe(cell);
      for (std::size_t a = 0; a < axes.size(); ++a) {
        require(parameters, table.columns[a].name).set_text(to_string(row[a]));
      }
      const std::vector<Value> single = row_of(*measure_ao(*stages, cell, {}).statistics);
      ASSERT_EQ(row.size(), axes.size() + single.size());
      for (std::size_t i = 0; i < single.size(); ++i) {
        const double expected = to_number(single[i]);
        EXPECT_NEAR(to_number(row[axes.size() + i]), expected, 1e-9) << table.columns[axes.size() + i].name;
      }
    }
  }
  // A blur needs the image of each cell; so does a technique whose samples do not flip at the bias.
  Experiment blurred = base({"ao.blur=box"});
  const std::vector<SweepAxis> bias = {parse_axis(describe(blurred), "ao.bias=0,0.01")};
  EXPECT_TRUE(inner_keys(blurred, bias, SweptQuantity::ao).empty());
  EXPECT_FALSE(inner_keys(base({"ao.blur=none"}), bias, SweptQuantity::ao).empty());
  EXPECT_TRUE(inner_keys(base({"ao.blur=none", "ao.technique=gtao"}), bias, SweptQuantity::ao).empty());
  const std::vector<SweepAxis> kinds = {parse_axis(describe(blurred), "ao.blur=none,box")};
  EXPECT_TRUE(inner_keys(base({"ao.blur=none"}), kinds, SweptQuantity::ao).empty());
}

TEST_F(StagesGl, Cells_of_a_sweep_are_those_of_single_runs) {
  for (const std::string technique : {"pcf", "esm", "evsm4"}) {
    expect_single_runs({"shadow.technique=" + technique}, {"shadow.resolution=32,64", "shadow.cascades=1,2",
                                                           "shadow.constant-bias=0.01,0.05", "shadow.slope-bias=0,1"});
  }
}

TEST_F(StagesGl, Cells_that_differ_only_in_the_look_up_are_those_of_single_runs) {
  expect_single_runs({"shadow.technique=vsm"}, {"shadow.min-variance=1e-6,1e-4", "shadow.constant-bias=1texels,2texels",
                                                "shadow.moment-blur=3,5", "shadow.bleeding-reduction=0,0.1,0.3"});
  expect_single_runs({"shadow.technique=msm", "shadow.moment-mipmaps=true"},
                     {"shadow.msm-bound=hamburger,hausdorff", "shadow.msm-moment-bias=1e-5,1e-3"});
  expect_single_runs({}, {"shadow.technique=pcf,csm", "shadow.csm-contrast=1,2,4", "shadow.slope-bias=0,1"});
  expect_single_runs({"shadow.technique=vsm", "shadow.contact-shadows=true"}, {"shadow.bleeding-reduction=0,0.3"});
  expect_single_runs({"light.angle=2", "shadow.technique=evsm2"}, {"shadow.min-variance=1e-6,1e-4"});
}

}  // namespace
}  // namespace umbrameter
