#include "analysis/model/filter/filter_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::model::detail {

namespace {

using rigor::cholesky;
using rigor::combination;
using rigor::lower_solution;
using rigor::product;
using rigor::product_with_transpose;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SmallMatrix gram_of(const SmallMatrix& a) {
  return product_with_transpose(a, a);
}

/// A vector in units of the shape after the step, and its effect on the innovation within the range of gains.
struct InUnits {
  SmallMatrix error, reach;
  /// Both with the multiplier mu: R^-1 error above sqrt(mu) reach.
  [[nodiscard]] SmallMatrix with(const SmallMatrix& root, double mu) const {
    SmallMatrix below = reach;
    below *= std::sqrt(mu);
    return rigor::stacked(lower_solution(root, error), below);
  }
};

/// The parts of a step in these units.
struct StepInUnits {
  SmallMatrix spread;  ///< delta
  InUnits x, v, offset;
  std::vector<InUnits> squares;  ///< along each state
  std::optional<InUnits> w;      ///< the curve's move, if any
};

std::optional<StepInUnits> in_units(const FilterStepOnOrbit& step, const FilterNumbers& numbers,
                                    const FilterParameters& parameters) {
  const auto root = cholesky(step.after);
  const auto factor = cholesky(rigor::congruence(numbers.weighted(), step.delta));
  if (!root || !factor) {
    return std::nullopt;
  }
  const SmallMatrix reach = rigor::transposed(*factor);
  const SmallMatrix of_measured = product(reach, numbers.measured());
  const auto propagated = [&](const SmallMatrix& predicted) {
    SmallMatrix of_innovation = product(of_measured, predicted);
    of_innovation *= -1.0;
    return InUnits{lower_solution(*root, product(step.contraction, predicted)), std::move(of_innovation)};
  };
  StepInUnits parts;
  parts.spread = rigor::in_units_of(*root, step.delta);
  parts.x = propagated(product(step.slope, step.before));
  parts.v = {lower_solution(*root, step.gain), reach};
  parts.v.error *= parameters.noise;
  parts.v.reach *= parameters.noise;
  parts.offset = {lower_solution(*root, step.offset), product(reach, step.innovation)};
  for (const SmallMatrix& change : step.changes) {
    SmallMatrix second = product(change, step.before);
    second *= 0.5;
    parts.squares.push_back(propagated(second));
  }
  if (step.move.size() > 0) {
    parts.w = {lower_solution(*root, step.move), SmallMatrix::Zero(reach.rows(), 1)};
    parts.w->error *= parameters.slew;
  }
  return parts;
}

/// The square of a bound of the quadratic part.
double squares_of(const StepInUnits& step, const SmallMatrix& root, double mu) {
  const Index rows = step.x.error.rows() + step.x.reach.rows();
  SmallMatrix gram = SmallMatrix::Zero(rows, rows);
  for (const InUnits& one : step.squares) {
    gram += gram_of(one.with(root, mu));
  }
  return rigor::largest_eigenvalue(gram);
}

/// N N' of the disturbances: noise and the move of the curve; with both, each gets a half.
SmallMatrix disturbances_of(const StepInUnits& step, const SmallMatrix& root, double mu, bool has_noise) {
  const Index rows = step.x.error.rows() + step.x.reach.rows();
  const double half = has_noise && step.w ? 2.0 : 1.0;
  SmallMatrix other = SmallMatrix::Zero(rows, rows);
  if (has_noise) {
    other += half * gram_of(step.v.with(root, mu));
  }
  if (step.w) {
    other += half * gram_of(step.w->with(root, mu));
  }
  return other;
}

/// Approximately the root of the largest (log E W+ - log(1 + c0 exp(-L l^2)))/(L l^2) over the levels l,
/// where the step is N xi + B v and a quadratic part: from N N', B deviation, and the square of a bound of
/// that part.
double gaussian_growth(const SmallMatrix& gram, const SmallMatrix& of_noise, double squared,
                       double exponent) {
  const SmallMatrix noise = gram_of(of_noise);
  const SmallMatrix unit = rigor::identity(gram.rows());
  constexpr std::array<double, 5> kLevels{1.0, 0.7, 0.5, 0.34, 0.25};
  std::array<double, kLevels.size()> least{};
  least.fill(kInfinity);
  for (const double a : {0.01, 0.02, 0.04, 0.07, 0.12, 0.2, 0.35}) {
    const auto root = cholesky(combination(1.0, unit, -2.0 * exponent * (1.0 + a), noise));
    if (!root) {
      break;
    }
    const double linear = rigor::largest_eigenvalue(rigor::in_units_of(*root, gram));
    double determinant = 1.0;
    for (Index i = 0; i < root->rows(); ++i) {
      determinant *= (*root)(i, i);
    }
    const double spread = -std::log(determinant);
    for (std::size_t i = 0; i < kLevels.size(); ++i) {
      const double square = kLevels[i] * kLevels[i];
      const double all = exponent * square;
      least[i] = std::min(least[i], (1.0 + a) * linear + (1.0 + 1.0 / a) * squared * square +
                                        (spread - std::log1p(kProposedConstant * std::exp(-all))) / all);
    }
  }
  return std::sqrt(std::max(0.0, *std::max_element(least.begin(), least.end())));
}

}  // namespace

FilterGrowth FilterGrowthBound::of(const FilterStepOnOrbit& step, const FilterNumbers& numbers,
                                   const FilterParameters& parameters, double enough) {
  FilterGrowth worst{kInfinity, 1.0};
  const auto parts = in_units(step, numbers, parameters);
  if (!parts) {
    return worst;
  }
  const double top = rigor::largest_eigenvalue(parts->spread);
  const SmallMatrix unit = rigor::identity(parts->spread.rows());
  const bool has_noise = parameters.noise > 0.0;
  constexpr std::array<double, 7> kShares{1.08, 1.2, 1.4, 1.8, 3.0, 8.0, 40.0};
  for (std::size_t tried = 0; tried < kShares.size(); ++tried) {
    // The multipliers that were good at the last sample first.
    const std::size_t number = (tried + good_share_) % kShares.size();
    const double most = enough > 0.0 ? enough : worst.whole;
    const double mu = kShares.at(number) * top + 1e-300;
    const auto root = cholesky(combination(1.0, unit, -1.0 / mu, parts->spread));
    if (!root) {
      continue;
    }
    const SmallMatrix gram = gram_of(parts->x.with(*root, mu));
    const double alone = std::sqrt(rigor::largest_eigenvalue(gram));
    if (parameters.exponent > 0.0) {
      const double drift =
          gaussian_growth(gram, parts->v.with(*root, mu), squares_of(*parts, *root, mu), parameters.exponent);
      if (drift < worst.whole) {
        worst = {drift, alone};
      }
      continue;
    }
    double others = parts->offset.with(*root, mu).norm();
    if (alone + others > most) {
      continue;
    }
    others += std::sqrt(squares_of(*parts, *root, mu));
    if (alone + others > most) {
      continue;
    }
    const double linear = has_noise || parts->w
                              ? with_disturbances(gram, disturbances_of(*parts, *root, mu, has_noise), alone,
                                                  most - others, enough > 0.0)
                              : alone;
    const double whole = linear + others;
    if (whole < worst.whole) {
      worst = {whole, alone};
      best_share_ = number;
    }
    if (enough > 0.0 && worst.whole <= enough) {
      break;
    }
  }
  good_share_ = best_share_;
  if (enough > 0.0 && !(worst.whole <= enough)) {
    worst.whole = kInfinity;
  }
  return worst;
}

double FilterGrowthBound::with_disturbances(const SmallMatrix& gram, const SmallMatrix& other, double alone,
                                            double most, bool any) {
  constexpr std::array<double, 5> kSplits{0.5, 0.7, 0.82, 0.9, 0.95};
  double least = kInfinity;
  std::size_t best = good_split_;
  for (std::size_t tried = 0; tried < kSplits.size(); ++tried) {
    const std::size_t number = (tried + good_split_) % kSplits.size();
    const double t = kSplits.at(number);
    if (alone / std::sqrt(t) > std::min(most, least)) {
      continue;
    }
    const double length =
        std::sqrt(rigor::largest_eigenvalue(combination(1.0 / t, gram, 1.0 / (1.0 - t), other)));
    if (length < least) {
      least = length;
      best = number;
    }
    if (any && least <= most) {
      break;
    }
  }
  good_split_ = best;
  return least;
}

}  // namespace veritrack::model::detail
