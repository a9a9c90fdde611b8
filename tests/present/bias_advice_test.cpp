// The table of recommended biases says the same as the answer.
#include <gtest/gtest.h>

#include "present/bias_advice_report.h"
#include "present/plateau_text.h"

namespace umbrameter {
namespace {

// A curve in texels whose least error is 2 %.
BiasAdvice advice(double used_mae) {
  BiasAdvice made;
  made.unit = LengthUnit::texels;
  made.mean_texel = 0.02;
  made.depth_unit = 25.0;
  made.used = BiasCell{1.5, 0.0, used_mae};
  const BiasCell best{1.9, 0.0, 0.02};
  made.line.least_error = best;
  made.plateau.recommended = made.plateau.least = best;
  made.plateau.first = BiasCell{1.2, 0.0, 0.021};
  made.plateau.last = BiasCell{2.4, 0.0, 0.021};
  made.plateau.limit = 0.021;
  return made;
}

std::vector<std::string> rows_of(const BiasAdvice& advice) {
  std::vector<std::string> names;
  for (const std::vector<Value>& row : advice_table(advice).table.rows) names.push_back(to_string(row.front()));
  return names;
}

TEST(BiasAdvice, A_bias_to_keep_is_the_only_recommended_row) {
  const BiasAdvice kept = advice(0.0205);
  ASSERT_EQ(advice_text(kept).find("keep bias 1.5 texels"), 0u) << advice_text(kept);
  EXPECT_EQ(rows_of(kept)[0], "in this run: keep it");
  EXPECT_EQ(rows_of(kept)[1], "least error");
  BiasAdvice with_acne = kept;
  with_acne.line.little_acne = kept.used;
  EXPECT_EQ(rows_of(with_acne)[4], "acne at most 0.1 %") << "as in the answer";
  const BiasAdvice changed = advice(0.05);
  ASSERT_EQ(advice_text(changed).find("use bias 1.9 texels"), 0u) << advice_text(changed);
  EXPECT_EQ(rows_of(changed)[0], "in this run");
  EXPECT_EQ(rows_of(changed)[1], "recommended");
}

TEST(BiasAdvice, Acne_that_the_run_does_not_have_is_no_reason_for_a_bias) {
  BiasAdvice changed = advice(0.05);
  changed.plateau.recommended.acne = 0.000971;
  changed.plateau.recommended.constant = 1.9;
  EXPECT_EQ(advice_text(changed).find("for acne"), std::string::npos) << advice_text(changed);
  EXPECT_TRUE(advice_text(changed).ends_with("; of these, acne is at most 0.1 % from 1.9 texels on"))
      << advice_text(changed);
  EXPECT_EQ(advice_text(changed).find("use bias 1.9 texels (3.8 cm): acne 0 % → 0.0971 %, error 5.00 % → 2.00 %"), 0u)
      << advice_text(changed);
  changed.used.acne = 0.02;
  EXPECT_EQ(advice_text(changed).find("use bias 1.9 texels (3.8 cm) for acne of at most 0.1 %: acne 2.00 % → "), 0u)
      << advice_text(changed);
}

TEST(BiasAdvice, Printed_ends_of_a_range_lie_within_it) {
  const auto expect = [](const RoundedRange& range, double first, double last, int digits) {
    EXPECT_DOUBLE_EQ(range.first, first);
    EXPECT_DOUBLE_EQ(range.last, last);
    EXPECT_EQ(range.digits, digits);
  };
  expect(rounded_inwards(2.04366, 3.1957, 2.5), 2.05, 3.19, 3);
  expect(rounded_inwards(-0.12345, 1000.0, 0.0), -0.123, 1000.0, 3);
  expect(rounded_inwards(0.0, 8.0, 0.0), 0.0, 8.0, 3);
  expect(rounded_inwards(2.0437, 2.0439, 2.0438), 2.0437, 2.0439, 5);
  expect(rounded_inwards(1.253, 1.4861, 1.253), 1.253, 1.486, 4);  // the best bias is at an end
  BiasPlateau plateau = advice(0.02).plateau;
  plateau.first.constant = 2.04366;
  plateau.least.constant = 2.5;
  plateau.last.constant = 3.1957;
  EXPECT_EQ(range_text(plateau, LengthUnit::texels, "error", "").substr(0, 19), "2.05 to 3.19 texels");
}

}  // namespace
}  // namespace umbrameter
