#include "core/quantiles.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

TEST(Quantiles, Student_s_are_those_of_the_tables) {
  // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, column 0.975; three decimals.
  const std::pair<int, double> table[] = {{1, 12.706}, {2, 4.303},  {7, 2.365},  {15, 2.131}, {20, 2.086}, {30, 2.042},
                                          {31, 2.040}, {40, 2.021}, {60, 2.000}, {80, 1.990}, {100, 1.984}};
  for (const auto& [degrees, quantile] : table) EXPECT_NEAR(student_95(degrees), quantile, 5.1e-4) << degrees;
  EXPECT_NEAR(student_95(1e9), 1.959964, 1e-6) << "the normal distribution's";
}

TEST(Quantiles, Fewer_degrees_of_freedom_never_make_an_interval_narrower) {
  for (double degrees = 1.0; degrees < 60.0; degrees += 0.25) {
    EXPECT_GE(student_95(degrees), student_95(degrees + 0.25)) << degrees;
  }
}

}  // namespace
}  // namespace umbrameter
