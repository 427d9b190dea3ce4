#include "checker/quadrature/steady_rate.hpp"

#include <cmath>

#include "checker/quadrature/steady_state.hpp"

namespace veritrack::checker {

namespace {

/// mu + lambda eta^2 + c' (I - N N'/mu - G/lambda)^-1 c: the square of the rate that these multipliers prove,
/// in double; infinity when they prove none.
double rate_squared_of(const Row<double>& row, const Multipliers& by) {
  std::array<std::array<double, 3>, 3> m{};
  std::size_t gram = kGram;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = j; i < 3; ++i, ++gram) {
      m[i][j] = (i == j ? 1.0 : 0.0) - row[gram] / by.lambda;
      for (std::size_t k = 0; k < 3; ++k) {
        m[i][j] -= row[kSlope + 3 * i + k] * row[kSlope + 3 * j + k] / by.mu;
      }
    }
  }
  double rate = by.mu + by.lambda * row[kEta];
  std::array<double, 3> c{row[0], row[1], row[2]};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(m[k][k] > 0.0)) {
      return HUGE_VAL;
    }
    rate += c[k] * c[k] / m[k][k];
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = m[i][k] / m[k][k];
      c[i] -= factor * c[k];
      for (std::size_t j = k + 1; j <= i; ++j) {
        m[i][j] -= factor * m[j][k];
      }
    }
  }
  return rate;
}

}  // namespace

Multipliers propose(const Row<Ball>& row, const Ball& rate_squared) {
  Row<double> at{};
  for (std::size_t i = 0; i < kColumns; ++i) {
    at[i] = row[i].near();
  }
  const double trace = at[kGram] + at[kGram + 3] + at[kGram + 5];
  Multipliers best{8.0 * trace, 0.8};
  double least = rate_squared_of(at, best);
  for (double step = 1.0; step > 0.02; step *= 0.6) {
    const Multipliers centre = best;
    for (int i = -2; i <= 2; ++i) {
      for (int j = -2; j <= 2; ++j) {
        const Multipliers trial{centre.lambda * std::exp(step * i), centre.mu * std::exp(0.2 * step * j)};
        const double rate = rate_squared_of(at, trial);
        if (rate < least) {
          least = rate;
          best = trial;
        }
      }
    }
  }
  const double scale = (0.7 * rate_squared.near() + 0.3 * least) / least;
  return {best.lambda * scale, best.mu * scale};
}

bool contracts(const Row<Ball>& row, const Ball& rate_squared, const Multipliers& multipliers) {
  const Ball lambda(multipliers.lambda);
  const Ball mu(multipliers.mu);
  const Ball head = rate_squared - mu - lambda * row[kEta];
  if (!certainly_positive(lambda) || !certainly_positive(mu) || !certainly_positive(head)) {
    return false;
  }
  const Ball over_head = one / head;
  const Ball over_mu = one / mu;
  const Ball over_lambda = one / lambda;
  Matrix3 gap;
  std::size_t gram = kGram;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j, ++gram) {
      Ball products(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        products += row[kSlope + 3 * i + k] * row[kSlope + 3 * j + k];
      }
      gap[j][i] = Ball(i == j ? 1.0 : 0.0) - over_head * (row[i] * row[j]) - over_mu * products -
                  over_lambda * row[gram];
    }
  }
  return definite(gap);
}

bool keeps_covariance(const Row<Ball>& row, const std::array<Symmetric<Ball>, 2>& reach,
                      const SteadySetting& setting, const Ball& share) {
  Symmetric<Ball> low;
  Symmetric<Ball> high;
  for (std::size_t i = 0; i < low.size(); ++i) {
    low[i] = share * setting.below[i] + row[kLow + i];
    high[i] = share * setting.above[i] - row[kHigh + i];
  }
  const auto both = [](const Symmetric<Ball>& gap, const Symmetric<Ball>& way) {
    return definite(matrix_of(gap + way)) && definite(matrix_of(gap + scaled(Ball(-1.0), way)));
  };
  return both(low, reach[0]) && both(high, reach[1]);
}

}  // namespace veritrack::checker
