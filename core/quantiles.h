// Quantiles for confidence intervals.
#pragma once

#include <algorithm>

namespace umbrameter {

/// 97.5 % quantile of the normal distribution: 95 in 100 values are at most as many standard deviations from the mean.
inline constexpr double normal_975 = 1.959963984540054;

/// Two-sided 95 % quantile of Student's t distribution: |T| is below it in 95 of 100 cases. Between whole degrees of
/// freedom that of the next lower, which is wider. Without a degree of freedom a scatter is unknown: then 2, so that
/// the largest standard error of a value in [0, 1], ½, gives an interval that holds all of it.
/// Up to 30 degrees from the tables (NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2); above by expansion
/// about the normal quantile (Abramowitz and Stegun 1964, 26.7.5), exact to 10⁻⁶ there.
inline double student_95(double degrees_of_freedom) {
  constexpr double table[] = {2.0,      12.706205, 4.302653, 3.182446, 2.776445, 2.570582, 2.446912, 2.364624,
                              2.306004, 2.262157,  2.228139, 2.200985, 2.178813, 2.160369, 2.144787, 2.131450,
                              2.119905, 2.109816,  2.100922, 2.093024, 2.085963, 2.079614, 2.073873, 2.068658,
                              2.063899, 2.059539,  2.055529, 2.051831, 2.048407, 2.045230, 2.042272};
  constexpr double largest = 30.0;
  if (degrees_of_freedom < largest + 1.0) return table[static_cast<int>(std::max(degrees_of_freedom, 0.0))];
  constexpr double z = normal_975;
  constexpr double z2 = z * z;
  const double v = degrees_of_freedom;
  return z + z * (z2 + 1.0) / (4.0 * v) + z * ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * v * v) +
         z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * v * v * v);
}

}  // namespace umbrameter
