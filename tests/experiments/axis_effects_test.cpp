#include "experiments/sweep/axis_effects.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace umbrameter {
namespace {

Experiment with(const std::vector<std::string>& settings) {
  Experiment experiment;
  const Parameters parameters = describe(experiment);
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    require(parameters, setting.substr(0, equals)).set_text(setting.substr(equals + 1));
  }
  return experiment;
}

// The message of the refusal; empty if the axes are accepted.
std::string refusal(SweptQuantity quantity, const std::vector<std::string>& axes,
                    const std::vector<std::string>& settings = {}) {
  Experiment experiment = with(settings);
  std::vector<SweepAxis> parsed;
  for (const std::string& axis : axes) parsed.push_back(parse_axis(describe(experiment), axis));
  try {
    require_effect(quantity, {experiment}, parsed);
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
}

constexpr SweptQuantity shadows = SweptQuantity::visibility;

void expect_says(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
}

TEST(AxisEffects, An_axis_that_the_technique_does_not_read_is_refused_with_what_reads_it) {
  expect_says(refusal(shadows, {"shadow.esm-exponent=1:80:3"}),
              {"--vary shadow.esm-exponent", "shadow.technique pcf does not read it", "set shadow.technique to esm"});
  expect_says(refusal(SweptQuantity::ao, {"ao.gtao-falloff=0.1,0.5"}),
              {"ao.technique ssao does not read it", "set ao.technique to gtao"});
  expect_says(refusal(shadows, {"shadow.filter-size=3,5"}),
              {"shadow.filter nearest", "one of box, tent, gaussian, optimized, area-tent"});
  expect_says(refusal(shadows, {"shadow.split-lambda=0,1"}), {"shadow.cascades 1", "set shadow.cascades to 2"});
  expect_says(refusal(shadows, {"shadow.receiver-plane=false,true", "shadow.technique=vsm,msm"}),
              {"shadow.technique vsm does not read it", "one of pcf, pcss, dpcf"});
  expect_says(refusal(shadows, {"shadow.filter-taps=nearest,linear"}, {"shadow.technique=msm"}),
              {"nothing reads it with these settings"});
  expect_says(refusal(SweptQuantity::image, {"shading.normal-format=rg16,rgb8"}),
              {"shading.path forward does not read it", "set shading.path to deferred"});
}

TEST(AxisEffects, An_axis_that_the_measured_quantity_does_not_depend_on_is_refused) {
  expect_says(refusal(SweptQuantity::ao, {"shadow.resolution=16,32"}),
              {"no effect on ambient occlusion", "--measure visibility"});
  expect_says(refusal(shadows, {"ao.radius=0.1,0.2"}), {"no effect on shadows", "--measure ao"});
  expect_says(refusal(shadows, {"shading.ambient=0,1"}), {"--measure image"});
  const std::vector<std::string> of_both = {"ao.blur=none,gaussian", "shadow.constant-bias=0.1,0.2"};
  expect_says(refusal(shadows, of_both), {"no effect on shadows", "--measure image"});
}

TEST(AxisEffects, An_axis_that_one_combination_of_the_others_reads_is_accepted) {
  EXPECT_EQ(refusal(shadows, {"shadow.technique=pcf,vsm", "shadow.receiver-plane=false,true"}), "");
  EXPECT_EQ(refusal(shadows, {"shadow.filter-size=3,5", "shadow.filter=nearest,box"}), "");
  EXPECT_EQ(refusal(shadows, {"shadow.split-lambda=0,1", "shadow.cascades=1,4"}), "");
  EXPECT_EQ(refusal(shadows, {"shadow.max-distance=5,10", "shadow.split-range=seen,camera", "shadow.fit=scene,view"}),
            "");
  EXPECT_EQ(refusal(SweptQuantity::ao, {"view.camera=0,1", "truth.spp=1,2"}), "");
  EXPECT_EQ(refusal(shadows, {"view.light=0,1", "light.angle=0,2", "truth.shadow=pixel,point"}), "");
  EXPECT_EQ(refusal(SweptQuantity::image, {"shadow.resolution=16,32", "ao.radius=0.1,0.2", "truth.spp=1,2"}), "");
}

// A technique that reads a parameter is enough; which it is depends on other words and on the number of cascades.
TEST(AxisEffects, Every_parameter_of_a_technique_is_read_with_some_settings) {
  Experiment defaults;
  const auto is_read_with = [](SweptQuantity quantity, const std::string& key, std::vector<std::string> settings,
                               const std::string& technique) {
    settings.push_back(technique);
    return is_read(quantity, with(settings), key);
  };
  const std::vector<std::string> shadow_settings = {
      "shadow.cascades=2",     "shadow.fit=bounds",           "shadow.split-range=camera",
      "shadow.pancaking=true", "shadow.surface=dual",         "shadow.depth-encoding=perspective",
      "shadow.filter=box",     "shadow.contact-shadows=true", "shadow.receiver-precision=single"};
  // What a single map reads that is fitted to the view.
  const std::vector<std::string> view_settings = {"shadow.fit=view", "shadow.warp=lispsm", "shadow.split-range=camera",
                                                  "shadow.cascade-selection=depth", "shadow.normal-offset=1"};
  const std::vector<std::string> ao_settings = {"ao.blur=bilateral", "ao.resolution=half", "ao.multi-bounce=true",
                                                "ao.alchemy-mip-chain=true"};
  const std::vector<std::string> shading_settings = {"shading.path=deferred", "shading.attenuation=polynomial"};
  const auto any_of = [&](SweptQuantity quantity, const std::string& key, const std::vector<std::string>& settings,
                          const std::string& selector) {
    const Parameter choice = require(describe(defaults), selector);
    for (const std::string& name : std::get<ChoiceRef>(choice.field).names) {
      if (is_read_with(quantity, key, settings, selector + "=" + name)) return true;
    }
    return false;
  };
  for (const Parameter& parameter : describe(defaults)) {
    const std::string& key = parameter.key;
    if (key.starts_with("shadow.")) {
      EXPECT_TRUE(any_of(shadows, key, shadow_settings, "shadow.technique") ||
                  any_of(shadows, key, shadow_settings, "shadow.filter") ||
                  any_of(shadows, key, view_settings, "shadow.technique"))
          << key;
    } else if (key.starts_with("ao.")) {
      EXPECT_TRUE(any_of(SweptQuantity::ao, key, ao_settings, "ao.technique")) << key;
    } else if (key.starts_with("shading.")) {
      EXPECT_TRUE(is_read(SweptQuantity::image, with(shading_settings), key)) << key;
    }
  }
}

}  // namespace
}  // namespace umbrameter
