// Quantiles of the chi-squared distribution, to four digits.
#pragma once

namespace veritrack::reports {

/// Standard normal deviates that are not exceeded with these probabilities.
inline constexpr double kNormal975 = 1.959964;   // 0.975
inline constexpr double kNormal9995 = 3.290527;  // 0.9995

/// The mean of `freedom` squares of independent standard normal deviates (freedom > 0) that is not exceeded
/// with the probability with which a standard normal deviate does not exceed `deviate`. E. B. Wilson and M.
/// M. Hilferty, Proc. Nat. Acad. Sci. 17, 1931: relative error below 1e-3 from 30 degrees of freedom on, for
/// |deviate| < 3.3.
[[nodiscard]] double mean_square_quantile(double freedom, double deviate);

}  // namespace veritrack::reports
