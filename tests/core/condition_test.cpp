#include "core/condition.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/error.h"

namespace umbrameter {
namespace {

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "";
}

TEST(Condition, Has_a_name_a_relation_and_a_bound_in_any_spacing) {
  const Condition condition = parse_condition(" |mean_error|<=  0.1 % ", "--constraint");
  EXPECT_EQ(condition.name, "mean_error");
  EXPECT_TRUE(condition.is_magnitude);
  EXPECT_EQ(condition.bound.relation, Relation::at_most);
  EXPECT_EQ(condition.bound.quantity.number, 0.1);
  EXPECT_EQ(condition.bound.quantity.unit, "%");
  EXPECT_EQ(parse_condition("ms-ssim>0.9", "").name, "ms-ssim");
  EXPECT_EQ(parse_condition("ao.samples>=16", "").bound.relation, Relation::at_least);
}

TEST(Condition, Without_a_name_relation_or_number_is_refused_by_name_of_the_option) {
  for (const char* text :
       {"", "acne", "acne<", "<0.1", "|acne<0.1", "acne=0.1", "acne<nan", "acne<inf", "acne<1e999"}) {
    const std::string message = refusal([&] { parse_condition(text, "--fail-if"); });
    EXPECT_EQ(message.rfind("--fail-if '", 0), 0u) << text << ": " << message;
  }
}

TEST(Condition, Bound_without_a_relation_means_at_most) {
  EXPECT_EQ(parse_bound("0.5%", "").relation, Relation::at_most);
  EXPECT_EQ(parse_bound("> 30 dB", "").relation, Relation::greater);
  EXPECT_EQ(parse_bound("> 30 dB", "").quantity.unit, "dB");
}

TEST(Condition, Number_is_converted_to_the_unit_of_the_statistic) {
  EXPECT_DOUBLE_EQ(in_unit({0.1, "%"}, "1", "acne", ""), 0.001);
  EXPECT_EQ(in_unit({0.1, ""}, "1", "acne", ""), 0.1);
  EXPECT_EQ(in_unit({30.0, "dB"}, "dB", "psnr", ""), 30.0);
  EXPECT_DOUBLE_EQ(in_unit({5.0, "cm"}, "m", "mean_texel", ""), 0.05);
  EXPECT_NE(refusal([] { in_unit({1.0, "%"}, "m", "mean_texel", "x"); }).find("mean_texel is in m"), std::string::npos);
  EXPECT_NE(refusal([] { in_unit({1.0, "m"}, "1", "acne", "x"); }).find("acne is a share"), std::string::npos);
}

TEST(WeightedSum, Has_terms_with_weights) {
  const std::vector<WeightedTerm> terms = parse_weighted_sum("acne + 0.5*rmse+2e-3 * |mean_error|+-1*psnr", "");
  ASSERT_EQ(terms.size(), 4u);
  EXPECT_EQ(terms[0].weight, 1.0);
  EXPECT_EQ(terms[1].name, "rmse");
  EXPECT_EQ(terms[2].weight, 2e-3);
  EXPECT_TRUE(terms[2].is_magnitude);
  EXPECT_EQ(terms[3].weight, -1.0);
  for (const char* text : {"", "acne +", "2 acne", "acne rmse", "acne - rmse", "2*", "nan*acne"}) {
    EXPECT_NE(refusal([&] { parse_weighted_sum(text, "--minimize"); }), "") << text;
  }
}

TEST(Relation, Of_a_value_that_is_not_a_number_never_holds) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Relation each : {Relation::less, Relation::at_most, Relation::greater, Relation::at_least}) {
    EXPECT_FALSE(holds(nan, each, 0.0));
  }
  EXPECT_TRUE(holds(1.0, Relation::at_most, 1.0));
  EXPECT_FALSE(holds(1.0, Relation::less, 1.0));
}

}  // namespace
}  // namespace umbrameter
