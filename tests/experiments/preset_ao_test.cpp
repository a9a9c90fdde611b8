// The numbers of every preset of ambient occlusion, against those that its source states: formulas of the preset's
// head.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "experiments/settings/experiment.h"
#include "store/preset.h"

namespace umbrameter {
namespace {

constexpr double half_digit = 5e-4;  // presets are rounded, at most to three digits

struct Stated {
  std::map<std::string, double> numbers;  // our parameters without "ao.": the engine's numbers
  std::set<std::string> ours;             // those that stand for what the engine does not state as a number
};

std::map<std::string, Stated> stated() {
  const double wall = 2.0 / 3.0;  // mean of HBAO's falloff over a wall
  return {
      {"babylon-ssao",
       // 16 samples two pixels apart on each axis; 3 mm of a radius of 2 m.
       {{{"radius", 2.0}, {"samples", 8}, {"bias", 0.02}, {"blur-size", 16 * 2}, {"blur-plane-distance", 0.003 / 2.0}},
        {"blur-normal-exponent"}}},
      {"bevy-ssao",
       {{{"radius", 0.5 * 1.457},
         {"slices", 3},
         {"steps", 3},
         {"bitmask-thickness", 0.25 / (0.5 * 1.457)},
         {"bitmask-distribution", 2},
         {"blur-passes", 1}},
        {}}},
      {"eevee-ao",
       // Two slices in each of 16 samples.
       {{{"radius", 0.2}, {"slices", 2 * 16}, {"steps", 8}, {"gtao-distribution", 2}, {"gtao-power", 1}},
        {"gtao-radius-multiplier", "gtao-falloff", "gtao-thin-compensation"}}},
      {"filament-ssao",
       {{{"radius", 0.3},
         {"samples", 7},
         {"alchemy-turns", 1},
         {"alchemy-bias", 0.0005 / 0.3},
         {"alchemy-intensity", 1},
         {"blur-size", 11}},
        {"blur-normal-exponent"}}},
      {"godot-ssao",
       // The horizon is a sine; the intensity of 2 counts taps whose mean weight is 0.283.
       {{{"radius", 1.0},
         {"hbao-tangent-bias", std::asin(0.06) * 180.0 / pi},
         {"hbao-intensity", 2 * 0.283 / wall},
         {"power", 1.5},
         {"blur-passes", 2}},
        {"hbao-directions", "hbao-steps"}}},
      {"n8ao",
       // A size is four deviations of 5.5 pixels; 1 m of a radius of 5 m.
       {{{"radius", 5.0},
         {"samples", 16},
         {"power", 5},
         {"blur-size", 4 * 5.5},
         {"blur-passes", 2},
         {"blur-plane-distance", 1.0 / 5.0},
         {"blur-normal-exponent", 1}},
        {"bias"}}},
      {"threejs-gtao",
       // 2 m of a radius of 0.25 m.
       {{{"radius", 0.25},
         {"slices", 3},
         {"steps", 6},
         {"noise-size", 5},
         {"gtao-distribution", 1},
         {"gtao-power", 1},
         {"blur-plane-distance", 2.0 / 0.25},
         {"blur-normal-exponent", 3}},
        {"gtao-radius-multiplier", "gtao-falloff", "gtao-thin-compensation", "blur-size"}}},
      {"threejs-ssao",
       // 0.005 of a camera from 0.1 to 100 m.
       {{{"radius", 8.0}, {"samples", 32}, {"bias", 0.005 * (100.0 - 0.1)}, {"noise-size", 4}, {"blur-size", 5}}, {}}},
      {"unity-hdrp-ssao",
       // It searches half the radius in the image.
       {{{"radius", 2.0 / 2},
         {"slices", 6},
         {"steps", 6},
         {"gtao-distribution", 1},
         {"gtao-power", 1},
         {"blur-size", 4}},
        {"gtao-radius-multiplier", "gtao-falloff", "gtao-thin-compensation", "blur-normal-exponent"}}},
      {"xegtao",
       {{{"radius", 0.5},
         {"slices", 3},
         {"steps", 3},
         {"gtao-radius-multiplier", 1.457},
         {"gtao-falloff", 0.615},
         {"gtao-distribution", 2},
         {"gtao-thin-compensation", 0},
         {"gtao-power", 2.2},
         {"blur-passes", 1}},
        {}}},
  };
}

TEST(PresetAo, Every_number_is_the_one_that_the_source_states_or_is_listed_as_ours) {
  const std::map<std::string, Stated> all = stated();
  std::set<std::string> found;
  for (const Preset& preset : installed_presets()) {
    if (preset.kind != "ao") continue;
    SCOPED_TRACE(preset.name);
    ASSERT_TRUE(all.contains(preset.name)) << "state its numbers here";
    found.insert(preset.name);
    Experiment experiment;
    const Parameters parameters = describe(experiment);
    apply_preset(preset, parameters);
    const Stated& expected = all.at(preset.name);
    std::size_t numbers = 0;
    for (const auto& [key, value] : preset.values) {
      const Parameter& parameter = require(parameters, key);
      if (!parameter.is_number()) continue;
      ++numbers;
      const std::string name = key.substr(3);
      const auto number = expected.numbers.find(name);
      EXPECT_NE(number != expected.numbers.end(), expected.ours.contains(name)) << name;
      if (number == expected.numbers.end()) continue;
      EXPECT_NEAR(to_number(parameter.value()), number->second, half_digit * number->second) << name;
    }
    EXPECT_EQ(numbers, expected.numbers.size() + expected.ours.size()) << "a stated number is not set";
  }
  EXPECT_EQ(found.size(), all.size());
}

}  // namespace
}  // namespace umbrameter
