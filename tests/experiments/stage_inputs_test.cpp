// What a stage declares is all that it sees of an experiment.
#include "experiments/settings/stage_inputs.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

TEST(StageInputs, A_stage_sees_the_parameters_of_its_key_and_defaults_for_all_others) {
  Experiment given;
  Parameters set = describe(given);
  const char* changed[][2] = {{"view.camera", "1"},         {"view.size", "320x200"},
                              {"view.light", "2"},          {"view.scene", "second"},
                              {"light.angle", "3"},         {"shadow.resolution", "256"},
                              {"shadow.filter", "box"},     {"shadow.constant-bias", "2"},
                              {"shadow.technique", "vsm"},  {"shadow.esm-exponent", "9"},
                              {"ao.radius", "0.3"},         {"ao.power", "2"},
                              {"shading.path", "deferred"}, {"truth.spp", "17"},
                              {"truth.shadow", "point"},    {"run.seed", "5"},
                              {"run.classes", "fast"}};
  for (const auto& [key, value] : changed) require(set, key).set_text(value);
  Experiment defaults;
  const Parameters of_defaults = describe(defaults);
  for (std::size_t s = 0; s < stage_count; ++s) {
    const auto stage = static_cast<Stage>(s);
    Experiment seen = declared(stage, given);
    EXPECT_EQ(key_of(stage, seen), key_of(stage, given));
    for (const Parameter& each : describe(seen)) {
      const bool is_seen = depends_on(stage, each.key) || each.key == "view.scene";
      EXPECT_EQ(each.value(), require(is_seen ? set : of_defaults, each.key).value())
          << inputs_of(stage).name << ": " << each.key;
    }
  }
}

}  // namespace
}  // namespace umbrameter
