#include "checker/single_channel/curve_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace veritrack::checker {

namespace {

using State = ToneState<double>;
using Rows = std::array<Weights, kToneStates>;
constexpr double kPi = std::numbers::pi;

State image(const State& x, double phase, double frequency, const TrackerValues<double>& values) {
  return tone_step(x, frequency, phase + frequency, values);
}

/// The state of the tracker at `phase` long after it started from an exact estimate.
State settled(const TrackerValues<double>& values, double frequency, double phase) {
  constexpr int kSamples = 1000;
  State x{0.0, 0.0, 0.0, values.r + values.q1, 0.0, values.r + values.q1, 0.0, 0.0, values.q2};
  for (int k = kSamples; k > 0; --k) {
    x = image(x, std::remainder(phase - k * frequency, kPi), frequency, values);
  }
  return x;
}

/// The coefficients of the curve through the settled states at this many phases.
std::vector<State> settled_curve(const TrackerValues<double>& values, double frequency, slong harmonics) {
  const slong count = 4 * harmonics;
  std::vector<State> coefficients(static_cast<std::size_t>(2 * harmonics + 1), State{});
  for (slong node = 0; node < count; ++node) {
    const double phase = kPi * static_cast<double>(node) / static_cast<double>(count);
    const State x = settled(values, frequency, phase);
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      const std::size_t harmonic = (k + 1) / 2;
      const double angle = 2.0 * static_cast<double>(harmonic) * phase;
      const double wave = k % 2 == 1 ? std::cos(angle) : std::sin(angle);
      const double part = (k == 0 ? 1.0 : 2.0 * wave) / static_cast<double>(count);
      for (std::size_t i = 0; i < kToneStates; ++i) {
        // Without a leak the errors are zero, and stay so.
        coefficients[k][i] += values.epsilon == 0.0 && i < 3 ? 0.0 : part * x[i];
      }
    }
  }
  return coefficients;
}

State along(const CurveFamily& family, double phase) {
  State x{};
  const Matrix& middle = family.terms.front();
  for (slong k = 0; k < middle.columns(); ++k) {
    const slong harmonic = (k + 1) / 2;
    const double angle = 2.0 * static_cast<double>(harmonic) * phase;
    const double wave = k % 2 == 1 ? std::cos(angle) : k == 0 ? 1.0 : std::sin(angle);
    for (std::size_t i = 0; i < kToneStates; ++i) {
      x[i] += middle(static_cast<slong>(i), k).near() * wave;
    }
  }
  return x;
}

/// The derivatives in the coordinates W x, by central differences.
Rows jacobian(const TrackerValues<double>& values, const CurveFamily& family, const Weights& weights,
              double phase) {
  constexpr double kStep = 0x1p-17;
  const State at = along(family, phase);
  Rows j{};
  for (std::size_t k = 0; k < kToneStates; ++k) {
    State above = at;
    State below = at;
    above[k] += kStep / weights[k];
    below[k] -= kStep / weights[k];
    const State high = image(above, phase, family.center, values);
    const State low = image(below, phase, family.center, values);
    for (std::size_t i = 0; i < kToneStates; ++i) {
      j[i][k] = weights[i] * (high[i] - low[i]) / (2.0 * kStep);
    }
  }
  return j;
}

Rows times(const Rows& x, const Rows& y) {
  Rows xy{};
  for (std::size_t i = 0; i < kToneStates; ++i) {
    for (std::size_t k = 0; k < kToneStates; ++k) {
      for (std::size_t j = 0; j < kToneStates; ++j) {
        xy[i][j] += x[i][k] * y[k][j];
      }
    }
  }
  return xy;
}

/// x'm x scaled by `factor`, plus the identity.
Rows pulled_back(const Rows& m, const Rows& x, double factor) {
  const Rows mx = times(m, x);
  Rows result{};
  for (std::size_t i = 0; i < kToneStates; ++i) {
    for (std::size_t k = 0; k < kToneStates; ++k) {
      for (std::size_t j = 0; j < kToneStates; ++j) {
        result[i][j] += factor * x[k][i] * mx[k][j];
      }
    }
    result[i][i] += 1.0;
  }
  return result;
}

/// R with R'R = m, by Cholesky, and its inverse, both upper triangular; x = R W in the coordinates of `m`.
Norm norm_of(const Rows& m, const Weights& weights) {
  Rows r{};
  Rows inverse{};
  Norm norm{Matrix(kToneStates, kToneStates), Matrix(kToneStates, kToneStates)};
  for (std::size_t i = 0; i < kToneStates; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= r[k][i] * r[k][j];
      }
      r[j][i] = i == j ? std::sqrt(sum) : sum / r[j][j];
    }
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (std::size_t k = j; k < i; ++k) {
        sum -= inverse[j][k] * r[k][i];
      }
      inverse[j][i] = sum / r[i][i];
      const auto row = static_cast<slong>(j);
      const auto column = static_cast<slong>(i);
      norm.root.set(row, column, Ball(r[j][i] * weights[i]));
      norm.inverse.set(row, column, Ball(inverse[j][i] / weights[j]));
    }
  }
  return norm;
}

/// The factor per sample by which the product of the Jacobians along an orbit shrinks.
double observed_rate(const TrackerValues<double>& values, const CurveFamily& family, const Weights& weights) {
  constexpr int kSamples = 300;
  Rows product{};
  for (std::size_t i = 0; i < kToneStates; ++i) {
    product[i][i] = 1.0;
  }
  double logarithm = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    const Rows j = jacobian(values, family, weights, std::remainder(k * family.center, kPi));
    product = times(j, product);
    double size = 0.0;
    for (const Weights& row : product) {
      for (const double entry : row) {
        size = std::max(size, std::fabs(entry));
      }
    }
    for (Weights& row : product) {
      for (double& entry : row) {
        entry /= size;
      }
    }
    logarithm += std::log(size);
  }
  return std::exp(logarithm / kSamples);
}

}  // namespace

const std::vector<double>& curve_nodes(double half_width) {
  static const std::vector<double> middle{0.0};
  static const std::vector<double> five{-1.0, -0.5, 0.0, 0.5, 1.0};
  return half_width == 0.0 ? middle : five;
}

std::optional<CurveFamily> propose_curves(const TrackerValues<double>& values, double center,
                                          double half_width) {
  const std::vector<double>& nodes = curve_nodes(half_width);
  const auto count = static_cast<slong>(nodes.size());
  constexpr slong kMost = 96;
  constexpr double kSmall = 1e-13;
  CurveFamily family{center, half_width, 1, {}};
  const auto size = [](const State& x) {
    double largest = 0.0;
    for (const double component : x) {
      largest = std::max(largest, std::fabs(component));
    }
    return largest;
  };
  // Only the harmonics that matter.
  std::vector<std::vector<State>> curves{settled_curve(values, center, kMost / 3)};
  if (!(size(curves[0].back()) < kSmall * size(curves[0].front()))) {
    curves = {settled_curve(values, center, kMost)};
  }
  for (slong k = 1; k <= static_cast<slong>(curves[0].size() / 2); ++k) {
    const auto at = static_cast<std::size_t>(2 * k);
    if (!(std::max(size(curves[0][at - 1]), size(curves[0][at])) < kSmall * size(curves[0].front()))) {
      family.harmonics = k;
    }
  }
  curves.clear();
  Matrix powers(count, count);
  for (slong j = 0; j < count; ++j) {
    const double t = nodes[static_cast<std::size_t>(j)];
    curves.push_back(settled_curve(values, center + half_width * t, family.harmonics));
    for (slong k = 0; k < count; ++k) {
      powers.set(j, k, Ball(std::pow(t, static_cast<double>(k))));
    }
  }
  const Matrix weights = powers.inverse();
  const auto columns = static_cast<slong>(curves.front().size());
  for (slong k = 0; k < count; ++k) {
    Matrix term(kToneStates, columns);
    for (slong column = 0; column < columns; ++column) {
      for (std::size_t i = 0; i < kToneStates; ++i) {
        double sum = 0.0;
        for (slong j = 0; j < count; ++j) {
          sum +=
              weights(k, j).near() * curves[static_cast<std::size_t>(j)][static_cast<std::size_t>(column)][i];
        }
        if (!std::isfinite(sum)) {
          return std::nullopt;
        }
        term.set(static_cast<slong>(i), column, Ball(sum));
      }
    }
    family.terms.push_back(std::move(term));
  }
  return family;
}

Norms propose_norms(const TrackerValues<double>& values, const CurveFamily& family, std::size_t cells) {
  const auto mean = [&](slong i) { return family.terms.front()(i, 0).near(); };
  const double z = std::sqrt(0.5 * (mean(3) + mean(5)));
  const double f = std::sqrt(mean(8));
  Norms norms;
  norms.weights = {1.0,           1.0,           z / f,         1.0 / (z * z), 1.0 / (z * z),
                   1.0 / (z * z), 1.0 / (z * f), 1.0 / (z * f), 1.0 / (f * f)};
  const double width = kPi / static_cast<double>(cells);
  constexpr double kBetween = 0.6;
  const double rate = std::pow(observed_rate(values, family, norms.weights), kBetween);
  std::vector<Rows> jacobians(cells);
  std::vector<Rows> m(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    jacobians[i] = jacobian(values, family, norms.weights, (static_cast<double>(i) + 0.5) * width);
  }
  // The M of the phase that follows is interpolated between two cells.
  const double moved = family.center / width;
  const auto whole = static_cast<std::size_t>(moved);
  const double part = moved - std::floor(moved);
  constexpr int kMostSweeps = 400;
  constexpr double kSettled = 1e-4;
  double change = 1.0;
  for (int sweep = 0; sweep < kMostSweeps && change > kSettled; ++sweep) {
    const std::vector<Rows> last = m;
    change = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
      const Rows& before = last[(i + whole) % cells];
      const Rows& behind = last[(i + whole + 1) % cells];
      Rows next{};
      for (std::size_t k = 0; k < kToneStates; ++k) {
        for (std::size_t l = 0; l < kToneStates; ++l) {
          next[k][l] = (1.0 - part) * before[k][l] + part * behind[k][l];
        }
      }
      m[i] = pulled_back(next, jacobians[i], 1.0 / (rate * rate));
      for (std::size_t k = 0; k < kToneStates; ++k) {
        change = std::max(change, 1.0 - last[i][k][k] / m[i][k][k]);
      }
    }
  }
  norms.cells.reserve(cells);
  for (const Rows& of_cell : m) {
    norms.cells.push_back(norm_of(of_cell, norms.weights));
  }
  return norms;
}

}  // namespace veritrack::checker
