// One pass over the taps gives the image of causes at every bias of an axis.
#include <gtest/gtest.h>

#include <memory>

#include "core/error.h"
#include "experiments/stages/stages.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

// The cause of a pixel at constant[k] of the axis.
PixelClass class_at(const TapFlips& flips, std::size_t k, std::size_t pixel, PixelExclusion exclusion) {
  if (exclusion == PixelExclusion::background) return PixelClass::background;
  if (exclusion != PixelExclusion::none) return PixelClass::not_counted;
  if (flips.bin[pixel] == 0) return PixelClass::correct;
  const Cause cause = flips.cause[pixel];
  const bool is_lit = k + 1 >= flips.bin[pixel];
  const bool is_wrong_when_lit = cause == Cause::peter_panning || cause == Cause::light_leak;
  if (is_lit != is_wrong_when_lit) return PixelClass::correct;
  return static_cast<PixelClass>(static_cast<std::size_t>(PixelClass::acne) + static_cast<std::size_t>(cause));
}

class TapFlipsGl : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_shared<gl::Context>(gl::Context::make());
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  // Compares with a fresh drawing at each bias; returns the number of wrong pixels over all of them.
  std::size_t compare(const Experiment& experiment, const BiasAxes& axes) const {
    StageOptions options;
    options.context = context_;
    Stages stages(load_scene("courtyard"), options, Console{.quiet = true});
    std::size_t wrong = 0;
    for (const std::uint32_t light : stages.lights("")) {
      const TapFlips flips = stages.tap_flips(experiment, light, axes);
      for (std::size_t k = 0; k < axes.constant.size(); ++k) {
        Experiment fresh = experiment;
        fresh.shadow.bias.constant = {axes.constant[k], axes.unit};
        RasterVisibility drawn = stages.draw(fresh, light, true);
        if (fresh.run.classes == ClassRule::exact) stages.reclassify(fresh, light, drawn.wrong);
        const auto counted = stages.counted(fresh, light);
        const Image<PixelClass> expected = classify(drawn.wrong, *counted);
        std::size_t different = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          const PixelClass found = class_at(flips, k, i, counted->exclusion[i]);
          if (found != expected[i]) ++different;
          wrong += found != PixelClass::correct && found < PixelClass::not_counted ? 1 : 0;
        }
        EXPECT_EQ(different, 0u) << stages.title(light) << " at " << axes.constant[k];
      }
    }
    return wrong;
  }

  std::shared_ptr<gl::Context> context_;
};

TEST_F(TapFlipsGl, Causes_at_every_bias_are_those_of_a_fresh_drawing_for_each_light) {
  Experiment experiment;
  experiment.view.size = {160, 90};
  experiment.shadow.map.resolution = 512;
  for (const ClassRule rule : {ClassRule::fast, ClassRule::exact}) {
    experiment.run.classes = rule;
    EXPECT_GT(compare(experiment, {{0.0f, 0.02f, 0.05f, 0.3f}, {0.0f}, LengthUnit::metres}), 100u);
  }
}

TEST_F(TapFlipsGl, Biases_in_texels_with_a_slope_scaled_bias_count_the_same) {
  Experiment experiment;
  experiment.view.size = {160, 90};
  experiment.shadow.map.resolution = 512;
  experiment.shadow.bias.slope = 0.75;
  EXPECT_GT(compare(experiment, {{0.0f, 0.5f, 1.5f, 20.0f}, {0.75f}, LengthUnit::texels}), 100u);
}

}  // namespace
}  // namespace umbrameter
