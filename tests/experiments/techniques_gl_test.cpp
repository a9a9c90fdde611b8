// Every technique and every named choice of the shadow parameters draws under every kind of light, without a message of
// the driver.
#include <gtest/gtest.h>

#include <utility>

#include "core/error.h"
#include "experiments/measure/measure.h"
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

// A setting with which the parameter has an effect.
std::pair<const char*, const char*> user_of(const std::string& key) {
  const auto has = [&](const char* part) { return key.find(part) != std::string::npos; };
  if (has("moment") || has("msm") || has("blur-kernel")) return {"shadow.technique", "msm"};
  if (has("screen")) return {"shadow.technique", "screen-space"};
  if (has("pcss")) return {"shadow.technique", "pcss"};
  if (has("rotation")) return {"shadow.filter", "vogel"};
  return {"shadow.filter", "gaussian"};
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
        experiment.shadow.map.resolution = 64;
        experiment.shadow.map.cascades = 3;
        const auto [key, value] = user_of(parameter.key);
        require(describe(experiment.shadow), key).set_text(value);
        require(describe(experiment.shadow), parameter.key).set_text(name);
        try {
          const Image<float> visibility = stages.draw(experiment, light, false).visibility;
          EXPECT_EQ(visibility.size(), 64u * 36u);
          for (const float seen : visibility.pixels) {
            ASSERT_TRUE(seen >= 0.0f && seen <= 1.0f) << parameter.key << "=" << name << ": " << seen;
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

// A light of 0.5 m at 2 m is 14.25° across. With 64 taps for the search and for the filter, and compared with the
// receiver's plane, so that the wide kernel needs no wide bias.
TEST_F(TechniquesGl, PCSS_meets_the_traced_penumbra_of_a_light_of_half_a_metre) {
  Stages stages(load_scene("contact-box"), {.gl_device = {}, .context = context_}, Console{.quiet = true});
  Experiment experiment;
  experiment.view.size = {240, 135};
  experiment.light.angle = 14.25;
  experiment.shadow.map.resolution = 2048;
  experiment.shadow.technique = ShadowTechniques::choice<Pcss>;
  experiment.shadow.bias.receiver_plane = true;
  experiment.shadow.bias.constant = {0.5, LengthUnit::texels};
  experiment.shadow.pcf.samples = 64;
  experiment.shadow.pcss.blockers = 64;
  const auto error_of = [&](const Experiment& of) {
    return std::get<SoftVisibilityStatistics>(*measure_shadow(stages, of, 0, {}).statistics);
  };
  const SoftVisibilityStatistics pcss = error_of(experiment);
  EXPECT_GT(pcss.penumbra.value, 0.02);
  EXPECT_LT(pcss.penumbra_mae.value, 0.05);
  experiment.shadow.technique = ShadowTechniques::choice<Pcf>;
  EXPECT_GT(error_of(experiment).penumbra_mae.value, 0.15);
}

}  // namespace
}  // namespace umbrameter
