#include "checker/quadrature/steady_rate.hpp"

#include <cmath>
#include <optional>

#include "checker/quadrature/steady_state.hpp"

namespace veritrack::checker {

namespace {

template <std::size_t N>
using Vector = std::array<double, N>;
template <std::size_t N>
using Square = std::array<std::array<double, N>, N>;

template <std::size_t N>
double dot(const Vector<N>& a, const Vector<N>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}
template <std::size_t N>
Vector<N> times(const Square<N>& m, const Vector<N>& x) {
  Vector<N> y{};
  for (std::size_t i = 0; i < N; ++i) {
    y[i] = dot(m[i], x);
  }
  return y;
}

/// The solutions x of m x = b for several b; nothing when the symmetric m is not positive definite.
template <std::size_t N, std::size_t M>
std::optional<std::array<Vector<N>, M>> solve(Square<N> m, std::array<Vector<N>, M> b) {
  for (std::size_t k = 0; k < N; ++k) {
    if (!(m[k][k] > 0.0)) {
      return std::nullopt;
    }
    for (std::size_t i = k + 1; i < N; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < N; ++j) {
        m[i][j] -= factor * m[k][j];
      }
      for (Vector<N>& side : b) {
        side[i] -= factor * side[k];
      }
    }
  }
  for (Vector<N>& side : b) {
    for (std::size_t k = N; k-- > 0;) {
      for (std::size_t j = k + 1; j < N; ++j) {
        side[k] -= m[k][j] * side[j];
      }
      side[k] /= m[k][k];
    }
  }
  return b;
}

/// Everything in double: X_i of the hidden part, of the spread and of the noise, and their weights.
constexpr std::size_t kGains = 3;
constexpr std::size_t kCell = 3;  ///< the index of tau after mu, lambda and sigma
using Four = Vector<4>;
struct Parts {
  Vector<3> image{};  ///< at the middle of the cell
  std::array<Square<3>, kGains> gains{};
  std::array<Vector<3>, 2> slopes{};  ///< columns of S
  Vector<2> middle{};
  Four weights{};  ///< 1, eta^2, noise^2, size^2
};

Parts parts_of(const Row<Ball>& row, const SteadyLimits& limits) {
  Parts parts;
  parts.weights = {1.0, row[kEta].near(), limits.noise_squared.near(), limits.size_squared.near()};
  parts.middle = {limits.middle[0].near(), limits.middle[1].near()};
  std::size_t gram = kGram;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      parts.slopes[k][i] = limits.slopes[i][k].near();
    }
    parts.image[i] =
        row[i].near() + parts.slopes[0][i] * parts.middle[0] + parts.slopes[1][i] * parts.middle[1];
    for (std::size_t j = i; j < 3; ++j, ++gram) {
      const std::array<double, kGains> entries{
          limits.hidden[i].near() * limits.hidden[j].near(), row[gram].near(),
          row[kNoise + 2 * i].near() * row[kNoise + 2 * j].near() +
              row[kNoise + 2 * i + 1].near() * row[kNoise + 2 * j + 1].near()};
      for (std::size_t k = 0; k < kGains; ++k) {
        parts.gains[k][i][j] = parts.gains[k][j][i] = entries[k];
      }
    }
  }
  return parts;
}

/// The rate squared that multipliers m prove: with A = I - sum X_i/m_i and X = (x, y) the largest of
/// (image + S d)' A^-1 (image + S d) + mu (1 - |q + d|^2) + tau (size^2 - |d|^2) over all d, and the rest of
/// the weights.
struct Rate {
  double squared = HUGE_VAL;
  Vector<2> d{};        ///< where it is the largest
  Vector<3> y{};        ///< A^-1 (image + S d) there
  Square<3> inverse{};  ///< A^-1
  Square<2> bend{};     ///< (mu + tau) I - S' A^-1 S
};
Rate rate_of(const Parts& parts, const Four& m) {
  Square<3> gap{};
  gap[0][0] = gap[1][1] = gap[2][2] = 1.0;
  for (std::size_t k = 0; k < kGains; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        gap[i][j] -= parts.gains[k][i][j] / m[k];
      }
    }
  }
  const auto inverse = solve<3, 3>(gap, {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}});
  if (!inverse) {
    return {};
  }
  Rate rate;
  rate.inverse = *inverse;
  const Vector<3> at_middle = times(rate.inverse, parts.image);
  Vector<2> push{};
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector<3> seen = times(rate.inverse, parts.slopes[k]);
    for (std::size_t j = 0; j < 2; ++j) {
      rate.bend[k][j] = (k == j ? m[0] + m[kCell] : 0.0) - dot(seen, parts.slopes[j]);
    }
    push[k] = dot(parts.slopes[k], at_middle) - m[0] * parts.middle[k];
  }
  const auto d = solve<2, 1>(rate.bend, {push});
  if (!d) {
    return {};
  }
  rate.d = d->front();
  Vector<3> image = parts.image;
  double room = 1.0;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      image[i] += parts.slopes[k][i] * rate.d[k];
    }
    room -= std::pow(parts.middle[k] + rate.d[k], 2.0);
  }
  rate.y = times(rate.inverse, image);
  rate.squared = dot(image, rate.y) + m[0] * room + m[1] * parts.weights[1] + m[2] * parts.weights[2] +
                 m[kCell] * (parts.weights[kCell] - dot(rate.d, rate.d));
  return rate;
}

/// Newton's step of the logarithms of the multipliers.
Four newton_step(const Parts& parts, const Four& m, const Rate& rate) {
  // Derivatives by the multipliers, and those of the derivative by d, half of it.
  Four slope = parts.weights;
  Square<4> curvature{};
  std::array<Vector<2>, 4> cross{};
  std::array<Vector<3>, kGains> pushed{};
  for (std::size_t i = 0; i < kGains; ++i) {
    pushed[i] = times(parts.gains[i], rate.y);
    const double pull = dot(rate.y, pushed[i]) / (m[i] * m[i]);
    slope[i] -= pull;
    curvature[i][i] = 2.0 * pull / m[i];
    for (double& entry : pushed[i]) {
      entry /= m[i] * m[i];
    }
    const Vector<3> back = times(rate.inverse, pushed[i]);
    for (std::size_t j = 0; j <= i; ++j) {
      const double both = 2.0 * dot(back, pushed[j]);
      curvature[i][j] += both;
      curvature[j][i] += i == j ? 0.0 : both;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      cross[i][k] = -dot(parts.slopes[k], back);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const double at = parts.middle[k] + rate.d[k];
    slope[0] -= at * at;
    cross[0][k] -= at;
    cross[kCell][k] = -rate.d[k];
  }
  slope[kCell] -= dot(rate.d, rate.d);
  const auto moved = solve<2, 4>(rate.bend, cross);
  if (!moved) {
    return {};
  }
  Four fall{};
  Square<4> by_logarithms{};
  for (std::size_t i = 0; i < 4; ++i) {
    fall[i] = -(m[i] * slope[i]);
    for (std::size_t j = 0; j < 4; ++j) {
      by_logarithms[i][j] = m[i] * m[j] * (curvature[i][j] + 2.0 * dot((*moved)[i], cross[j]));
    }
  }
  // It is convex in the multipliers; only the positive part of the logarithms' contribution is taken.
  for (std::size_t i = 0; i < 4; ++i) {
    by_logarithms[i][i] += std::fmax(m[i] * slope[i], 0.0) + 1e-6 * std::fabs(fall[i]) + 1e-12;
  }
  const auto step = solve<4, 1>(by_logarithms, {fall});
  return step ? step->front() : Four{};
}

/// The derivatives of the rate squared by the entries of the row.
Row<double> weights_of(const Rate& rate, const Four& m, const Row<Ball>& row) {
  const Vector<3>& y = rate.y;
  Row<double> weights{};
  std::size_t gram = kGram;
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = 2.0 * y[i];
    for (std::size_t j = i; j < 3; ++j, ++gram) {
      weights[gram] = (i == j ? 1.0 : 2.0) * y[i] * y[j] / m[1];
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const double seen = y[0] * row[kNoise + k].near() + y[1] * row[kNoise + 2 + k].near() +
                          y[2] * row[kNoise + 4 + k].near();
      weights[kNoise + 2 * i + k] = 2.0 * y[i] * seen / m[2];
    }
  }
  weights[kEta] = m[1];
  return weights;
}

/// Multipliers for which the rate is finite: I - sum X_i/m_i and the bend are positive definite.
Four feasible(const Parts& parts) {
  Four m{};
  double sum = 0.0;
  for (std::size_t k = 0; k < kGains; ++k) {
    double trace = parts.gains[k][0][0] + parts.gains[k][1][1] + parts.gains[k][2][2];
    if (k == 0) {
      trace += dot(parts.slopes[0], parts.slopes[0]) + dot(parts.slopes[1], parts.slopes[1]);
    }
    m[k] = std::sqrt(std::fmax(trace, 1e-300) / parts.weights[k]);
    sum += parts.weights[k] * m[k];
  }
  for (double& multiplier : m) {
    multiplier *= 1.5 * sum;
  }
  m[kCell] = m[0];
  return m;
}

}  // namespace

Proposal propose(const Row<Ball>& row, const SteadyLimits& limits) {
  constexpr double kLeast = 1e-9;
  constexpr int kSteps = 25;
  constexpr double kEnough = 1e-5;
  constexpr double kLongest = 3.0;
  Parts parts = parts_of(row, limits);
  for (double& weight : parts.weights) {
    weight = std::fmax(weight, kLeast);
  }
  Four m = feasible(parts);
  Rate best = rate_of(parts, m);
  for (int i = 0; i < kSteps && std::isfinite(best.squared); ++i) {
    Four step = newton_step(parts, m, best);
    for (double& part : step) {
      part = std::fmin(std::fmax(part, -kLongest), kLongest);
    }
    Rate found;
    Four trial{};
    for (int halving = 0; halving < 8 && !(found.squared < best.squared); ++halving) {
      for (std::size_t k = 0; k < 4; ++k) {
        trial[k] = m[k] * std::exp(step[k]);
        step[k] *= 0.5;
      }
      found = rate_of(parts, trial);
    }
    if (!(found.squared < best.squared)) {
      break;
    }
    const bool slow = found.squared > (1.0 - kEnough) * best.squared;
    m = trial;
    best = found;
    if (slow) {
      break;
    }
  }
  const Row<double> weights = weights_of(best, m, row);
  const double left = limits.rate_squared.near() - best.squared;
  for (std::size_t k = 0; k < kGains && left > 0.0; ++k) {
    constexpr double kShare = 0.1;  // of the slack, for each of the multipliers
    m[k] += std::fmin(kShare * left / parts.weights[k], m[k]);
  }
  return {best.squared, {m[0], m[1], m[2], m[kCell]}, weights};
}

ErrorInequality::ErrorInequality(const SteadyLimits& limits, const Multipliers& multipliers)
    : lambda_(multipliers.spread) {
  const Ball mu(multipliers.hidden);
  const Ball sigma(multipliers.noise);
  const Ball tau(multipliers.cell);
  meaningful_ = certainly_positive(mu) && certainly_positive(lambda_) && certainly_positive(sigma) &&
                certainly_not_negative(tau);
  if (!meaningful_) {
    return;
  }
  const Ball over_mu = one / mu;
  const Ball over_both = one / (mu + tau);
  const Ball theta = tau * over_both;
  over_lambda_ = one / lambda_;
  over_sigma_ = one / sigma;
  head_ = limits.rate_squared - mu + mu * theta * (square(limits.middle[0]) + square(limits.middle[1])) -
          tau * limits.size_squared - sigma * limits.noise_squared;
  const auto& s = limits.slopes;
  std::size_t k = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    shift_[i] = theta * (s[i][0] * limits.middle[0] + s[i][1] * limits.middle[1]);
    for (std::size_t j = i; j < 3; ++j, ++k) {
      gap_[k] = Ball(i == j ? 1.0 : 0.0) - over_both * (s[i][0] * s[j][0] + s[i][1] * s[j][1]) -
                over_mu * (limits.hidden[i] * limits.hidden[j]);
    }
  }
}

bool ErrorInequality::contracts(const Row<Ball>& row) const {
  if (!meaningful_) {
    return false;
  }
  const Ball head = head_ - lambda_ * row[kEta];
  if (!certainly_positive(head)) {
    return false;
  }
  const Ball over_head = one / head;
  const std::array<Ball, 3> image{row[0] + shift_[0], row[1] + shift_[1], row[2] + shift_[2]};
  Matrix3 gap;
  std::size_t k = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j, ++k) {
      const std::size_t first = kNoise + 2 * i;
      const std::size_t second = kNoise + 2 * j;
      gap[j][i] = gap_[k] - over_head * (image[i] * image[j]) - over_lambda_ * row[kGram + k] -
                  over_sigma_ * (row[first] * row[second] + row[first + 1] * row[second + 1]);
    }
  }
  return definite(gap);
}

bool keeps_covariance(const Symmetric<Ball>& low, const Symmetric<Ball>& high,
                      const std::array<Symmetric<Ball>, 2>& reach, const SteadySetting& setting,
                      const Ball& share) {
  const auto both = [](const Symmetric<Ball>& gap, const Symmetric<Ball>& way) {
    return definite(matrix_of(gap + way)) && definite(matrix_of(gap + scaled(Ball(-1.0), way)));
  };
  return both(scaled(share, setting.below) + low, reach[0]) &&
         both(scaled(share, setting.above) + scaled(Ball(-1.0), high), reach[1]);
}

}  // namespace veritrack::checker
