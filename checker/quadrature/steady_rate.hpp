// The two inequalities that a step about the steady state must satisfy at a point (docs/leak.md, sections 4
// and 5).
#pragma once

#include <algorithm>
#include <array>

#include "checker/quadrature/steady_step.hpp"

namespace veritrack::checker {

/// The entries of the errors' inequality, in one row: moved - S (x, y) (3), gram (6), noise (6, line by line)
/// and the bound on |y|^2.
enum Column : std::size_t { kGram = 3, kNoise = 9, kEta = 15, kColumns = 16 };
template <typename S>
using Row = std::array<S, kColumns>;

/// With S = 0.
template <typename S>
Row<S> row_of(const SteadyStep<S>& step) {
  Row<S> row;
  std::copy(step.moved.begin(), step.moved.end(), row.begin());
  std::copy(step.gram.begin(), step.gram.end(), row.begin() + kGram);
  for (std::size_t i = 0; i < 3; ++i) {
    std::copy(step.noise[i].begin(), step.noise[i].end(), row.begin() + kNoise + 2 * i);
  }
  row[kEta] = step.eta_squared;
  return row;
}

/// The remainder of the level, squared, and the quantities that do not change over a cell.
struct SteadyLimits {
  Ball rate_squared;
  Ball noise_squared;  ///< of v / s
  std::array<Ball, 3> hidden;
  std::array<std::array<Ball, 2>, 3> slopes;  ///< S: any constants
  std::array<Ball, 2> middle;                 ///< q, of (x, y)
  Ball size_squared;                          ///< |(x, y) - q|^2 is at most that
};

/// mu, lambda, sigma > 0 and tau >= 0 of section 4.
struct Multipliers {
  double hidden = 0.0, spread = 0.0, noise = 0.0, cell = 0.0;
};

/// The least rate of steps that multipliers prove, approximately (in double precision), and these
/// multipliers, moved so that some slack remains.
struct Proposal {
  double rate_squared;
  Multipliers multipliers;
  Row<double> weights;  ///< the derivatives of the rate squared by the entries of the row
};
Proposal propose(const Row<Ball>& row, const SteadyLimits& limits);

/// With multipliers and limits that do not change over a cell:
///     p p'/h + S S'/(mu + tau) + hidden hidden'/mu + gram/lambda + noise noise'/sigma < I for certain,
/// p = moved - S (x, y) + theta S q, theta = tau/(mu + tau), and
///     h = rate^2 - mu + mu theta |q|^2 - tau size^2 - lambda eta^2 - sigma noise^2 > 0.
/// For each vector the left side is convex in the row, so that it is enough to look at corners.
class ErrorInequality {
 public:
  ErrorInequality(const SteadyLimits& limits, const Multipliers& multipliers);
  [[nodiscard]] bool contracts(const Row<Ball>& row) const;

 private:
  bool meaningful_;
  Ball head_;  ///< h without eta
  Ball lambda_, over_lambda_, over_sigma_;
  std::array<Ball, 3> shift_;  ///< theta S q
  Symmetric<Ball> gap_;        ///< I - S S'/(mu + tau) - hidden hidden'/mu
};

/// -share below < low +- reach[0] and high +- reach[1] < share above, for certain: affine in low and high.
bool keeps_covariance(const Symmetric<Ball>& low, const Symmetric<Ball>& high,
                      const std::array<Symmetric<Ball>, 2>& reach, const SteadySetting& setting,
                      const Ball& share);

}  // namespace veritrack::checker
