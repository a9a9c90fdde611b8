#include "results/number_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace umbrameter {
namespace {

TEST(NumberText, A_share_has_three_significant_digits) {
  EXPECT_EQ(percent(0.0871234), "8.71 %");
  EXPECT_EQ(percent(0.1234), "12.3 %");
  EXPECT_EQ(percent(1.0), "100 %");
  EXPECT_EQ(percent(0.000123456), "0.0123 %");
  EXPECT_EQ(percent(0.0), "0 %");
  EXPECT_EQ(percent(std::numeric_limits<double>::quiet_NaN()), "—") << "what was not measured is no number";
}

TEST(NumberText, Numbers_of_a_column_keep_their_zeros_and_have_a_minus_sign) {
  EXPECT_EQ(digits_text(10.0), "10.0");
  EXPECT_EQ(digits_text(3.625), "3.63") << "as length_text() and the page's script";
  EXPECT_EQ(digits_text(0.35), "0.350");
  EXPECT_EQ(digits_text(-0.2727), "−0.273");
  EXPECT_EQ(digits_text(12345.6), "12346") << "the whole part is never cut";
  EXPECT_EQ(digits_text(0.0), "0");
  EXPECT_EQ(digits_text(5.96e-8), "6e-08");
  EXPECT_EQ(digits_text(8.9e-5), "0.00009");
  EXPECT_EQ(share_text(0.147406), "14.7");
  EXPECT_EQ(percent(-0.008), "−0.800 %");
}

TEST(NumberText, A_depth_has_three_significant_digits_however_small) {
  EXPECT_EQ(depth_text(0.00212), "0.00212");
  EXPECT_EQ(depth_text(6.571e-5), "6.57e-05");
}

TEST(NumberText, Zero_has_no_sign) {
  for (const char* text : {"-0", "-0.00", "-0 m"}) EXPECT_EQ(with_minus(text), std::string(text).substr(1));
  EXPECT_EQ(with_minus("-0.04 m"), "−0.04 m");
  EXPECT_EQ(with_minus("-inf"), "−inf");
  EXPECT_EQ(length_text({-0.0, LengthUnit::texels}), "0 texels");
}

TEST(NumberText, A_symmetric_interval_is_a_half_width_and_another_one_a_range) {
  EXPECT_EQ(percent(Estimate{0.105432, 0.104, 0.106}), "10.40 to 10.60 %");  // half width 0.10 %
  EXPECT_EQ(percent(Estimate{0.105432, 0.0854, 0.1254}), "10.5 ± 2.0 %");    // half width 2.0 %
  EXPECT_EQ(percent(Estimate{-0.0028, -0.0075, 0.0019}), "−0.28 ± 0.47 %");
  EXPECT_EQ(percent(Estimate{0.25, 0.25, 0.25}), "25.0 %");
  EXPECT_EQ(estimate_text({0.1759, 0.121, 0.231}, "px"), "0.176 ± 0.055 px");
  EXPECT_EQ(estimate_text({-0.1385, -0.2749, -0.0021}, ""), "−0.139 ± 0.136") << "on which side of 0 it ends";
  EXPECT_EQ(estimate_text({0.14, 0.0, 0.28}, ""), "0.14 ± 0.14");
  EXPECT_EQ(estimate_text({17.28, 0.0, 34.86}, ""), "0 to 35") << "its lower end was cut";
  EXPECT_EQ(estimate_text({0.05, -0.1, 0.06}, "px"), "−0.100 to 0.060 px");
  EXPECT_EQ(estimate_text({0.5626, -0.0044, 1.1207}, ""), "−0.004 to 1.121") << "± would exclude 0";
  EXPECT_EQ(estimate_text({-1e-5, -0.039, 0.039}, ""), "0.000 ± 0.039") << "0 has no sign";
}

TEST(NumberText, A_length_is_in_the_unit_that_suits) {
  EXPECT_EQ(metres_text(0.0123456), "1.23 cm");
  EXPECT_EQ(metres_text(0.0123456, 2), "1.2 cm");
  EXPECT_EQ(metres_text(12345.0), "12.3 km");
  EXPECT_EQ(metres_text(0.0), "0 m");
  EXPECT_EQ(metres_text(-1.73e-18), "0 m") << "a fitted constant that is 0 but for rounding";
  EXPECT_EQ(metres_text(2e-6), "2 µm");
  EXPECT_EQ(metres_text(4.84e-9), "4.84 nm");
  EXPECT_EQ(metres_text(2.273e-10), "0.227 nm") << "a step of a float near the light";
  EXPECT_EQ(metres_text(9.8456e-13), "0.985 pm") << "and of one on its plane";
  EXPECT_EQ(metres_text(-0.0123), "−1.23 cm");
  EXPECT_EQ(length_text({1.5, LengthUnit::texels}), "1.5 texels");
  EXPECT_EQ(length_text({2.70879, LengthUnit::texels}), "2.71 texels") << "three digits, as of metres";
  EXPECT_EQ(length_text({3.625, LengthUnit::texels}), "3.63 texels");
  EXPECT_EQ(length_text({1024.0, LengthUnit::texels}), "1024 texels");
  EXPECT_EQ(length_text(Length{0.5}), "50 cm");
}

}  // namespace
}  // namespace umbrameter
