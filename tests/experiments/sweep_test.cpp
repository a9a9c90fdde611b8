#include "experiments/settings/sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace umbrameter {
namespace {

struct SweptSample {
  int resolution = 256;
  double bias = 0.0;
  std::string name = "a";
};

Parameters describe(SweptSample& s) {
  return Description("s")
      .field("resolution", s.resolution, {"texels", "a resolution", 1, 4096})
      .field("bias", s.bias, {"m", "a bias", -1, 1})
      .field("name", s.name, {"", "a name"})
      .take();
}

std::vector<double> numbers(const SweepAxis& axis) {
  std::vector<double> result;
  for (const Value& value : axis.values) result.push_back(to_number(value));
  return result;
}

TEST(Sweep, A_linear_axis_meets_both_ends) {
  SweptSample sample;
  EXPECT_EQ(numbers(parse_axis(describe(sample), "s.bias=0:1:5")), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(numbers(parse_axis(describe(sample), "s.bias=0.3:0.3:1")), (std::vector<double>{0.3}));
  EXPECT_EQ(numbers(parse_axis(describe(sample), "s.bias=-0.02:0.08:51"))[10], 0.0) << "not what rounding leaves";
  EXPECT_EQ(numbers(parse_axis(describe(sample), "s.bias=0:0.8:9"))[7], 0.7) << "0.7, not 0.7000000000000001";
  EXPECT_EQ(sample.bias, 0.0) << "reading an axis leaves the parameter as it was";
}

TEST(Sweep, A_log_axis_has_a_constant_ratio_and_meets_both_ends) {
  SweptSample sample;
  const std::vector<double> values = numbers(parse_axis(describe(sample), "s.bias=0.001:1:4:log"));
  ASSERT_EQ(values.size(), 4u);
  EXPECT_EQ(values.front(), 0.001);
  EXPECT_NEAR(values[1], 0.01, 1e-15);
  EXPECT_NEAR(values[2], 0.1, 1e-14);
  EXPECT_EQ(values.back(), 1.0);
}

TEST(Sweep, An_axis_of_lengths_has_one_unit_and_a_bare_zero_goes_with_any) {
  Length bias{1.5, LengthUnit::texels};
  const Parameters parameters = Description("s").field("bias", bias, {.unit = "m", .units = {.texels = true}}).take();
  SweepAxis axis = parse_axis(parameters, "s.bias=0:4texels:5");
  EXPECT_EQ(numbers(axis), (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(axis.unit, "texels");
  EXPECT_EQ(bias, (Length{1.5, LengthUnit::texels})) << "reading an axis leaves the parameter as it was";
  set_value(parameters, axis, axis.values[3]);
  EXPECT_EQ(bias, (Length{3.0, LengthUnit::texels}));

  axis = parse_axis(parameters, "s.bias=0,5mm,2cm");
  EXPECT_EQ(numbers(axis), (std::vector<double>{0, 0.005, 0.02}));
  EXPECT_EQ(axis.unit, "m");
  EXPECT_EQ(numbers(parse_axis(parameters, "s.bias=1cm:1m:3:log")), (std::vector<double>{0.01, 0.1, 1}));

  for (const char* text :
       {"s.bias=0.02,1texel", "s.bias=1cm:4texels:3", "s.bias=1%,2%", "s.bias=auto", "s.bias=a:b:2"}) {
    EXPECT_THROW(parse_axis(parameters, text), Error) << text;
  }
}

TEST(Sweep, Lists_hold_numbers_or_names) {
  SweptSample sample;
  EXPECT_EQ(numbers(parse_axis(describe(sample), "s.resolution=256,512,1024")), (std::vector<double>{256, 512, 1024}));
  EXPECT_EQ(parse_axis(describe(sample), "s.name=a,b").values, (std::vector<Value>{"a", "b"}));
}

TEST(Sweep, What_is_no_axis_is_a_usage_error_that_names_it) {
  SweptSample sample;
  const Parameters parameters = describe(sample);
  for (const char* text :
       {"s.bias", "s.bias=", "s.bias=0:1", "s.bias=0:1:0", "s.bias=0:1:2.5", "s.bias=0:1:1", "s.bias=0:1:9999999",
        "s.bias=0:1:4:log", "s.bias=-1:1:4:log", "s.bias=0:1:4:cubic", "s.bias=a:b:c", "s.bias=0:2:3", "s.bias=nan,0",
        "s.bias=0,0", "s.name=0:1:3", "s.resolution=1:3:9", "s.unknown=1,2", "s.bias=0:1:1e99"}) {
    try {
      parse_axis(parameters, text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage) << text;
      EXPECT_NE(std::string(error.what()).find("s."), std::string::npos) << error.what();
    }
  }
}

TEST(Sweep, An_endless_grid_is_refused) {
  const SweepAxis bias{"s.bias", "", std::vector<Value>(1'000'000, 0.0)};
  const SweepAxis resolution{"s.resolution", "", std::vector<Value>(1'000, std::int64_t{1})};
  const SweepAxis name{"s.name", "", {"a", "b"}};
  EXPECT_EQ(count_cells({bias, resolution}), 1'000'000'000u);
  EXPECT_THROW(count_cells({bias, resolution, name}), Error);
}

}  // namespace
}  // namespace umbrameter
