// One pass over all biases against the processor's and against each bias drawn on its own.
#include <gtest/gtest.h>

#include "scenes/builtin.h"
#include "tests/agreement/bias_agreement.h"
#include "tests/support/gl_fixture.h"

namespace umbrameter::test {
namespace {

class BiasResponseGl : public GlFixture {
 protected:
  /// The sun with every filter, the other lights with every other one.
  void expect_agreement(BiasGrid grid) {
    const Scene scene = load_scene("contact-box");
    std::vector<std::string> notes;
    const View view{128, 72, select_camera(scene, "", 16.0 / 9.0, notes)};
    for (const Light& light : lights_of_every_kind(scene)) {
      const Agreement found = compare_ways(context(), scene, view, light, grid);
      for (const std::string& line : found.disagreements) ADD_FAILURE() << line;
      EXPECT_EQ(found.wrong_cells, found.cells) << "every cell should have something to count";
      EXPECT_GT(found.judged_taps, 0u);
      EXPECT_LT(found.identity_gap, 1e-7);
      std::vector<NamedFilter> fewer;
      for (std::size_t i = 0; i < grid.filters.size(); i += 2) fewer.push_back(grid.filters[i]);
      grid.filters = std::move(fewer);
    }
  }
};

TEST_F(BiasResponseGl, One_pass_counts_what_the_processor_and_each_cell_count) {
  expect_agreement({{{-0.01f, 0.02f, 0.3f, 2.0f}, {0.0f, 1.5f}}, {200}, usual_filters()});
}

TEST_F(BiasResponseGl, A_normal_offset_and_slopes_below_zero_agree_too) {
  BiasGrid grid{{{0.0f, 0.05f}, {-0.5f, 0.5f, 0.0f}}, {64, 130}, usual_filters(), {0.7}};
  grid.filters.resize(3);
  grid.judged_filters = 1;
  expect_agreement(grid);
}

}  // namespace
}  // namespace umbrameter::test
