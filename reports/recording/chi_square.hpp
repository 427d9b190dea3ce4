// Quantiles of the chi-squared distribution.
#pragma once

namespace veritrack::reports {

/// Standard normal deviates that are not exceeded with these probabilities.
inline constexpr double kNormal975 = 1.959964;  // 0.975
inline constexpr double kNormalFive = 5.0;      // 1 - 3e-7

/// The mean of `freedom` squares of independent standard normal deviates (freedom > 0) that is not exceeded
/// with the probability with which a standard normal deviate does not exceed `deviate`. E. B. Wilson and M.
/// M. Hilferty, Proc. Nat. Acad. Sci. 17, 1931: from 30 degrees of freedom on, the relative error is below
/// 0.002 for |deviate| < 2, and below 0.01 up to 5.
[[nodiscard]] double mean_square_quantile(double freedom, double deviate);

}  // namespace veritrack::reports
