// Every technique and every named choice of the shadow parameters draws under every kind of light, without a message of
// the driver.
#include <gtest/gtest.h>

#include "core/error.h"
#include "experiments/stages.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

class TechniquesGl : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_shared<gl::Context>(gl::Context::make());
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  std::shared_ptr<gl::Context> context_;
};

std::vector<std::string> names_of(const Parameter& parameter) {
  if (std::holds_alternative<bool*>(parameter.field)) return {"false", "true"};
  const auto* choice = std::get_if<ChoiceRef>(&parameter.field);
  return choice != nullptr ? choice->names : std::vector<std::string>{};
}

// A driver's message is an Error that is not the user's fault.
TEST_F(TechniquesGl, Every_choice_draws_under_every_kind_of_light) {
  Stages stages(load_scene("courtyard"), {.gl_device = {}, .context = context_}, Console{.quiet = true});
  ASSERT_EQ(stages.scene().lights.size(), 3u);
  std::size_t drawn = 0;
  std::size_t refused = 0;
  for (std::uint32_t light = 0; light < 3; ++light) {
    Experiment defaults;
    for (const Parameter& parameter : describe(defaults.shadow)) {
      for (const std::string& name : names_of(parameter)) {
        Experiment experiment;
        experiment.view.size = {64, 36};
        experiment.shadow.map.resolution = 128;
        experiment.shadow.map.cascades = 3;
        require(describe(experiment.shadow), parameter.key).set_text(name);
        try {
          const Image<float> visibility = stages.draw(experiment, light, false).visibility;
          EXPECT_EQ(visibility.size(), 64u * 36u);
          for (const float value : visibility.pixels) {
            ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << parameter.key << "=" << name << ": " << value;
          }
          ++drawn;
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ExitCode::usage) << parameter.key << "=" << name << ": " << error.what();
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(drawn, 100u);
  EXPECT_LT(refused, 10u);
}

}  // namespace
}  // namespace umbrameter
