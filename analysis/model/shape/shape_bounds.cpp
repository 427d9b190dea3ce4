#include "analysis/model/shape/shape_bounds.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "analysis/search/golden_section.hpp"

namespace veritrack::model {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The largest singular value.
double spectral_norm(const MatrixXd& matrix) {
  if (matrix.size() == 0) {
    return 0.0;
  }
  const MatrixXd gram = matrix * matrix.transpose();
  return std::sqrt(std::max(0.0, rigor::largest_eigenvalue(gram)));
}

/// A tensor whose rows are n x n x n arrays, with U applied to all three indices in place.
MatrixXd third_in_coordinates(const MatrixXd& third, const MatrixXd& u) {
  const Index n = u.rows();
  MatrixXd result = third;  // n x (j n + k) n + l, symmetric in j, k, l
  MatrixXd turned(n, result.cols());
  for (int round = 0; round < 3; ++round) {
    // Applies U to the last index and makes it the first one.
    for (Index pair = 0; pair < n * n; ++pair) {
      const MatrixXd applied = result.middleCols(pair * n, n) * u;
      for (Index l = 0; l < n; ++l) {
        turned.col(l * n * n + pair) = applied.col(l);
      }
    }
    result.swap(turned);
  }
  return result;
}

/// The part of the step at one phase, or empty when the shape is invalid.
std::optional<PhaseBounds> bound_at(const CurveDynamics& dynamics, std::size_t phase, const MatrixXd& u,
                                    const MatrixXd& u_next, const DisturbanceWeights& weights) {
  const StepDerivatives& step = dynamics.step[phase];
  const Index n = u.rows();
  const Index channels = step.sample.cols();
  if (!(u.diagonal().minCoeff() > 0.0) || !(u_next.diagonal().minCoeff() > 0.0) || !u.allFinite() ||
      !u_next.allFinite()) {
    return std::nullopt;
  }
  const auto solve = [&u_next](const MatrixXd& right) -> MatrixXd {
    return u_next.triangularView<Eigen::Lower>().solve(right);
  };
  PhaseBounds bounds;
  const MatrixXd linear = solve(step.state * u);
  const MatrixXd noise = solve(step.sample);
  bounds.rate = spectral_norm(linear);
  MatrixXd room = MatrixXd::Identity(n, n) - weights.noise * noise * noise.transpose();
  if (weights.slew > 0.0) {
    const MatrixXd drift = solve(dynamics.slew.col(static_cast<Index>(phase)));
    room -= weights.slew * drift * drift.transpose();
  }
  const auto factor = rigor::cholesky(room);
  if (!factor) {
    return std::nullopt;
  }
  bounds.disturbed_rate = spectral_norm(rigor::lower_solution(*factor, linear));
  MatrixXd second(n, n * n);
  MatrixXd mixed(n, n * channels);
  MatrixXd sample(n, channels * channels);
  for (Index row = 0; row < n; ++row) {
    const MatrixXd& hessian = step.second[static_cast<std::size_t>(row)];
    const MatrixXd states = u.transpose() * hessian.topLeftCorner(n, n) * u;
    const MatrixXd cross = u.transpose() * hessian.topRightCorner(n, channels);
    const MatrixXd samples = hessian.bottomRightCorner(channels, channels);
    second.row(row) = states.reshaped().transpose();
    mixed.row(row) = cross.reshaped().transpose();
    sample.row(row) = samples.reshaped().transpose();
  }
  bounds.second = spectral_norm(solve(second));
  bounds.mixed = spectral_norm(solve(mixed));
  bounds.sample = spectral_norm(solve(sample));
  bounds.third = spectral_norm(solve(third_in_coordinates(step.third, u)));
  bounds.reach = (dynamics.gradient[phase] * u).norm();
  const double bend = spectral_norm(u.transpose() * dynamics.hessian[phase] * u);
  bounds.straight = bend > 0.0 ? 0.5 * bounds.reach / bend : std::numeric_limits<double>::infinity();
  return bounds;
}

/// The remainder of R at a phase for the linear part, under noise V.
double left_at(const PhaseBounds& b, double level, double noise) {
  return level - level * level * (0.5 * b.second + level * b.third / 6.0) - b.mixed * level * noise -
         0.5 * b.sample * noise * noise;
}

/// Whether |F| <= R at a phase under noise V, with V^2/b + W^2/c given.
bool stays(const PhaseBounds& b, double level, double noise, double disturbance_squared) {
  const double linear = std::sqrt(b.disturbed_rate * b.disturbed_rate * level * level + disturbance_squared);
  return linear <= left_at(b, level, noise);
}

/// The largest size of a disturbance at each level, and the best level.
template <typename SizeAt>
ToleratedDisturbance best_level(const std::vector<PhaseBounds>& bounds, const SizeAt& size_at) {
  double highest = std::numeric_limits<double>::infinity();
  for (const PhaseBounds& b : bounds) {
    PhaseBounds linear = b;
    linear.rate = std::max(b.rate, b.disturbed_rate);
    highest = std::min(highest, largest_start_level({linear}));
  }
  if (!(highest > 0.0) || !std::isfinite(highest)) {
    return {};
  }
  constexpr int kSteps = 20;
  const auto best =
      search::golden_section(0.05 * highest, highest, kSteps, [&](double level) { return -size_at(level); });
  return {std::max(0.0, -best.cost), best.point};
}

}  // namespace

std::optional<std::vector<PhaseBounds>> bound_along(const CurveDynamics& dynamics, const ShapeOnGrid& shape,
                                                    const DisturbanceWeights& weights) {
  const int n = dynamics.cocycle.states();
  std::vector<std::optional<PhaseBounds>> found(dynamics.step.size());
  const auto bound = [&](std::size_t j) {
    const auto column = static_cast<Index>(j);
    found[j] = bound_at(dynamics, j, shape.here.col(column).reshaped(n, n),
                        shape.next.col(column).reshaped(n, n), weights);
  };
  constexpr int kFew = 5;
  if (n <= kFew) {
    for (std::size_t j = 0; j < found.size(); ++j) {
      bound(j);
    }
  } else {
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t j) {
      const rigor::NearestRounding nearest;
      bound(j);
    });
  }
  std::vector<PhaseBounds> result;
  result.reserve(found.size());
  for (const std::optional<PhaseBounds>& bounds : found) {
    if (!bounds) {
      return std::nullopt;
    }
    result.push_back(*bounds);
  }
  return result;
}

double largest_start_level(const std::vector<PhaseBounds>& bounds) {
  double level = std::numeric_limits<double>::infinity();
  for (const PhaseBounds& b : bounds) {
    if (!(b.rate < 1.0)) {
      return 0.0;
    }
    // The positive root of third R^2/6 + second R/2 - (1 - rate), in the form without cancellation.
    const double room = 1.0 - b.rate;
    level = std::min(level, b.straight);
    level = std::min(
        level, 2.0 * room / (0.5 * b.second + std::sqrt(0.25 * b.second * b.second + b.third * room / 1.5)));
  }
  return bounds.empty() ? 0.0 : level;
}

ToleratedDisturbance largest_noise(const std::vector<PhaseBounds>& bounds, double weight) {
  return best_level(bounds, [&](double level) {
    double largest = std::numeric_limits<double>::infinity();
    for (const PhaseBounds& b : bounds) {
      double low = 0.0;
      double high = std::min(largest, level / std::sqrt(1.0 / weight));
      for (int step = 0; step < 40 && high > 0.0 && !stays(b, level, high, high * high / weight); ++step) {
        const double middle = 0.5 * (low + high);
        (stays(b, level, middle, middle * middle / weight) ? low : high) = middle;
        if (high - low < 1e-6 * high) {
          high = low;
        }
      }
      largest = std::min(largest, high);
    }
    return largest;
  });
}

ToleratedDisturbance largest_slew(const std::vector<PhaseBounds>& bounds, double weight) {
  return best_level(bounds, [&](double level) {
    double largest = std::numeric_limits<double>::infinity();
    for (const PhaseBounds& b : bounds) {
      const double left = std::max(0.0, left_at(b, level, 0.0));
      const double squared = weight * (left * left - b.disturbed_rate * b.disturbed_rate * level * level);
      largest = std::min(largest, std::sqrt(std::max(0.0, squared)));
    }
    return largest;
  });
}

ToleratedDisturbance largest_deviation(const std::vector<PhaseBounds>& bounds, double weight,
                                       double exponent) {
  // A deviation of `share` R has the weight of the shape's equation.
  const double share = std::sqrt(weight / (2.0 * exponent));
  constexpr double kLongest = 8.0;  // errors, in deviations
  double level = std::numeric_limits<double>::infinity();
  for (const PhaseBounds& b : bounds) {
    const double room = 1.0 - b.disturbed_rate;
    if (!(room > 0.0)) {
      return {};
    }
    const double linear = 0.5 * b.second + b.mixed * share + 0.5 * kLongest * b.sample * share * share;
    level = std::min(level, b.straight);
    level = std::min(level, 2.0 * room / (linear + std::sqrt(linear * linear + b.third * room / 1.5)));
  }
  return bounds.empty() ? ToleratedDisturbance{} : ToleratedDisturbance{share * level, level};
}

double long_run_level(const std::vector<PhaseBounds>& bounds, const DisturbanceWeights& weights, double noise,
                      double slew) {
  const bool is_linear = noise == 0.0 && slew == 0.0;
  const double v = is_linear ? 1.0 : noise;
  const double squared =
      (v > 0.0 ? v * v / weights.noise : 0.0) + (slew > 0.0 ? slew * slew / weights.slew : 0.0);
  double level = 0.0;
  for (const PhaseBounds& b : bounds) {
    level = std::max(level, std::sqrt(squared / std::max(0.0, 1.0 - b.disturbed_rate * b.disturbed_rate)));
  }
  constexpr int kSteps = 200;
  for (int step = 0; !is_linear && step < kSteps && std::isfinite(level); ++step) {
    if (std::ranges::all_of(bounds, [&](const PhaseBounds& b) { return stays(b, level, noise, squared); })) {
      return level;
    }
    level *= 1.02;
  }
  return is_linear && !bounds.empty() ? level : std::numeric_limits<double>::infinity();
}

}  // namespace veritrack::model
