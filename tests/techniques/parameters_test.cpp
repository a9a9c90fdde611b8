#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "techniques/ao/technique.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

TEST(RasterParameters, Every_field_is_described) {
  const auto expect_all = [](auto params) {
    if constexpr (std::is_aggregate_v<decltype(params)>) {
      int fields = count_fields<decltype(params)>();
      // The fields of a NormalOffset are described one by one.
      if constexpr (
          requires { params.normal_offset; } || requires { params.caster_offset; }) {
        fields += count_fields<NormalOffset>() - 1;
      }
      EXPECT_EQ(describe(params).size(), static_cast<std::size_t>(fields));
    }
  };
  ShadowParams shadow;
  std::apply([&](auto... groups) { (expect_all(groups), ...); }, shadow.groups());
  // Every member is one of the groups.
  EXPECT_EQ(std::tuple_size_v<decltype(shadow.groups())>, count_fields<ShadowParams>());
  AoParams ao;
  std::apply([&](auto... groups) { (expect_all(groups), ...); }, ao.groups());
  EXPECT_EQ(std::tuple_size_v<decltype(ao.groups())>, count_fields<AoParams>());
}

TEST(RasterParameters, Every_default_keeps_to_its_own_limits) {
  ShadowParams shadow;
  AoParams ao;
  for (const Parameter& parameter : concatenate({describe(shadow), describe(ao)})) {
    EXPECT_NO_THROW(parameter.set(parameter.value())) << parameter.key;
    EXPECT_FALSE(parameter.description.meaning.empty()) << parameter.key;
    EXPECT_TRUE(!parameter.is_number() || !parameter.description.unit.empty()) << parameter.key;
  }
}

TEST(RasterParameters, Keys_reach_the_fields_that_they_name) {
  ShadowParams shadow;
  const Parameters parameters = describe(shadow);
  require(parameters, "shadow.resolution").set_text("300");
  require(parameters, "shadow.constant-bias").set_text("-0.25");
  require(parameters, "shadow.slope-bias").set_text("1.5");
  require(parameters, "shadow.filter").set_text("box");
  require(parameters, "shadow.filter-size").set_text("29");
  EXPECT_EQ(shadow.map.resolution, 300);
  EXPECT_EQ(shadow.bias.constant, Length{-0.25});
  EXPECT_EQ(shadow.bias.slope, 1.5);
  EXPECT_EQ(shadow.pcf.filter, ShadowFilter::box);
  EXPECT_EQ(shadow.pcf.size, 29);

  AoParams ao;
  const Parameters ao_parameters = describe(ao);
  require(ao_parameters, "ao.range-check").set_text("false");
  require(ao_parameters, "ao.blur").set_text("none");
  require(ao_parameters, "ao.noise-size").set_text("64");
  EXPECT_FALSE(ao.ssao.range_check);
  EXPECT_EQ(ao.blur.kind, AoBlur::none);
  EXPECT_EQ(ao.noise.size, 64);
}

struct Rejected {
  const char* key;
  const char* value;
};

TEST(RasterParameters, Values_outside_the_limits_are_errors_that_name_the_key) {
  ShadowParams shadow;
  AoParams ao;
  const Parameters parameters = concatenate({describe(shadow), describe(ao)});
  for (const Rejected& bad :
       {Rejected{"shadow.resolution", "0"}, Rejected{"shadow.resolution", "16385"},
        Rejected{"shadow.constant-bias", "nan"}, Rejected{"shadow.filter", "vsm"}, Rejected{"shadow.filter-size", "0"},
        Rejected{"shadow.filter-size", "31"}, Rejected{"ao.samples", "0"}, Rejected{"ao.samples", "1025"},
        Rejected{"ao.radius", "0"}, Rejected{"ao.noise-size", "65"}, Rejected{"ao.blur-size", "33"}}) {
    try {
      require(parameters, bad.key).set_text(bad.value);
      ADD_FAILURE() << bad.key << " took " << bad.value;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find(bad.key), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace umbrameter
