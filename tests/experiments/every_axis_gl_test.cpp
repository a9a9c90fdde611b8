// Every parameter varied together with every technique, as a sweep measures it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "experiments/sweep/axis_effects.h"
#include "experiments/sweep/sweep_table.h"
#include "tests/experiments/stages_gl.h"

namespace umbrameter {
namespace {

class EveryAxisGl : public ContactBoxGl {
 protected:
  static Experiment small(const std::vector<std::string>& settings) {
    Experiment experiment = base(settings);
    experiment.view.size = {32, 18};
    experiment.run.classes = ClassRule::fast;
    return experiment;
  }

  // Sweeps each parameter of a group beside `techniques`, an axis of words: every cell has a row, and rows of the same
  // technique that differ only in a parameter which is said not to be read are equal.
  void expect_rows(const Experiment& experiment, SweptQuantity quantity, const std::string& group,
                   const std::string& techniques) const {
    const std::unique_ptr<Stages> stages = make_stages();
    const std::string selector = techniques.substr(0, techniques.find('='));
    std::size_t read = 0;
    std::size_t unread = 0;
    Experiment described = experiment;
    for (const Parameter& parameter : describe(described)) {
      if (!parameter.key.starts_with(group) || parameter.key == selector || values_of(parameter).empty()) continue;
      // Two are enough: what goes wrong goes wrong for a kind of value.
      const std::vector<std::string> all = values_of(parameter);
      const std::string values = all.front() + "," + all.back();
      Table table;
      try {
        table = sweep_table(*stages, experiment, {techniques, parameter.key + "=" + values});
      } catch (const Error& error) {
        // Some values exclude one another.
        EXPECT_EQ(error.code(), ExitCode::usage) << parameter.key << ": " << error.what();
        continue;
      }
      std::map<std::string, std::vector<Value>> of_technique;
      for (const std::vector<Value>& row : table.rows) {
        ASSERT_EQ(row.size(), table.columns.size()) << parameter.key;
        Experiment cell = experiment;
        require(describe(cell), selector).set(row[0]);
        if (is_read(quantity, cell, parameter.key)) {
          ++read;
          continue;
        }
        ++unread;
        const std::vector<Value> measured(row.begin() + 2, row.end());
        const auto [first, is_new] = of_technique.emplace(to_string(row[0]), measured);
        EXPECT_TRUE(is_new || std::ranges::equal(first->second, measured, is_same))
            << parameter.key << "=" << to_string(row[1]) << " with " << to_string(row[0]);
      }
    }
    EXPECT_GT(read, 20u);
    EXPECT_GT(unread, 20u);
  }

  // NaN is the same as NaN.
  static bool is_same(const Value& a, const Value& b) { return a == b || to_string(a) == to_string(b); }
};

constexpr const char* maps = "shadow.technique=pcf,esm,vsm,evsm2,evsm4,msm,csm,pcss,dpcf";

TEST_F(EveryAxisGl, Every_parameter_of_shadows_is_swept_beside_every_technique) {
  expect_rows(small({"light.angle=2"}), SweptQuantity::visibility, "shadow.", std::string(maps) + ",screen-space");
}

TEST_F(EveryAxisGl, Every_parameter_of_shadows_is_swept_beside_every_technique_with_contact_shadows) {
  expect_rows(small({"shadow.contact-shadows=true", "shadow.filter=gaussian"}), SweptQuantity::visibility, "shadow.",
              maps);
}

TEST_F(EveryAxisGl, Every_parameter_of_shadows_is_swept_beside_every_kernel) {
  expect_rows(small({"shadow.cascades=2", "shadow.fit=bounds", "shadow.fit-size=6"}), SweptQuantity::visibility,
              "shadow.", "shadow.filter=nearest,box,poisson");
}

TEST_F(EveryAxisGl, Every_parameter_of_ambient_occlusion_is_swept_beside_every_technique) {
  expect_rows(small({}), SweptQuantity::ao, "ao.", "ao.technique=all");
}

TEST_F(EveryAxisGl, Every_parameter_of_shading_is_swept_beside_both_paths) {
  expect_rows(small({"run.measure=image"}), SweptQuantity::image, "shading.", "shading.path=all");
}

TEST_F(EveryAxisGl, A_switch_beside_techniques_of_which_some_look_it_up_in_one_pass_is_swept) {
  const std::unique_ptr<Stages> stages = make_stages();
  const Table table =
      sweep_table(*stages, small({"shadow.filter=box", "shadow.filter-size=5", "shadow.constant-bias=0.1texels"}),
                  {"shadow.technique=pcf,vsm", "shadow.receiver-plane=false,true", "shadow.bleeding-reduction=0,0.2"});
  ASSERT_EQ(table.rows.size(), 8u);
  const auto measured = [&](std::size_t cell) {
    return std::vector<Value>(table.rows[cell].begin() + 3, table.rows[cell].end());
  };
  EXPECT_NE(measured(0), measured(2)) << "PCF compares with the receiver's plane";
  EXPECT_EQ(measured(0), measured(1)) << "and reduces no bleeding";
  EXPECT_EQ(measured(4), measured(6)) << "VSM does not";
  EXPECT_NE(measured(4), measured(5));
}

}  // namespace
}  // namespace umbrameter
