// The two inequalities that a step about the steady state must satisfy at a point (docs/leak.md, sections 4
// and 5).
#pragma once

#include <algorithm>
#include <array>

#include "checker/quadrature/steady_step.hpp"

namespace veritrack::checker {

/// What they look at, in one row: constant (3), slope (9), gram (6), eta_squared, the deviations of the
/// covariance from P* after the step, over s, low (6) and high (6).
enum Column : std::size_t { kSlope = 3, kGram = 12, kEta = 18, kLow = 19, kHigh = 25, kColumns = 31 };
template <typename S>
using Row = std::array<S, kColumns>;

template <typename S>
Row<S> row_of(const SteadyStep<S>& step, const Symmetric<S>& low, const Symmetric<S>& high) {
  Row<S> row;
  std::copy(step.constant.begin(), step.constant.end(), row.begin());
  for (std::size_t i = 0; i < 3; ++i) {
    std::copy(step.slope[i].begin(), step.slope[i].end(), row.begin() + kSlope + 3 * i);
  }
  std::copy(step.gram.begin(), step.gram.end(), row.begin() + kGram);
  row[kEta] = step.eta_squared;
  std::copy(low.begin(), low.end(), row.begin() + kLow);
  std::copy(high.begin(), high.end(), row.begin() + kHigh);
  return row;
}

/// lambda and mu of section 4: any positive ones will do.
struct Multipliers {
  double lambda = 0.0, mu = 0.0;
};
/// Of an exact row, such that something is left of what there is to spare up to the square of a rate.
Multipliers propose(const Row<Ball>& row, const Ball& rate_squared);

/// constant constant'/h + slope slope'/mu + gram/lambda < I, h = rate^2 - mu - lambda eta^2 > 0, for certain.
/// For each vector the left side is convex in the row, so that it is enough to look at corners.
bool contracts(const Row<Ball>& row, const Ball& rate_squared, const Multipliers& multipliers);

/// -share below < low +- reach[0] and high +- reach[1] < share above, for certain: affine in the row.
bool keeps_covariance(const Row<Ball>& row, const std::array<Symmetric<Ball>, 2>& reach,
                      const SteadySetting& setting, const Ball& share);

}  // namespace veritrack::checker
