#include "analysis/linear/detector_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "analysis/linear/stability.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/lyapunov.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::linear {

using rigor::Interval;
using rigor::Verdict;

namespace {

/// The same in units of the largest responses to the phase, powers of two.
DetectorLoop in_own_units(const DetectorLoop& loop) {
  constexpr int kSamples = 4096;
  const std::size_t n = loop.a.size();
  std::vector<double> state(n);
  std::vector<double> largest(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    state[i] = rigor::midpoint(loop.effect[i]);
  }
  for (int k = 0; k < kSamples; ++k) {
    std::vector<double> next(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      largest[i] = std::max(largest[i], std::fabs(state[i]));
      for (std::size_t j = 0; j < n; ++j) {
        next[i] += rigor::midpoint(loop.a[i][j]) * state[j];
      }
    }
    state = next;
  }
  std::vector<Interval> unit;
  unit.reserve(n);
  for (const double size : largest) {
    unit.emplace_back(size > 0.0 && std::isfinite(size) ? std::exp2(std::floor(std::log2(size))) : 1.0);
  }
  DetectorLoop scaled = loop;
  for (std::size_t i = 0; i < n; ++i) {
    scaled.effect[i] /= unit[i];
    scaled.phase[i] *= unit[i];
    for (std::size_t j = 0; j < n; ++j) {
      scaled.a[i][j] = loop.a[i][j] * unit[j] / unit[i];
    }
  }
  return scaled;
}

/// A - (f - 1) b c.
std::vector<Row> with_factor(const DetectorLoop& loop, const Interval& factor) {
  std::vector<Row> a = loop.a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) {
      a[i][j] -= (factor - Interval(1.0)) * loop.effect[i] * loop.phase[j];
    }
  }
  return a;
}

/// X of X = A X A' + Q; only where no two eigenvalues have the product 1.
std::optional<rigor::DynamicIntervalMatrix> solution(const std::vector<Row>& a,
                                                     const rigor::DynamicIntervalMatrix& q) {
  const auto n = static_cast<Eigen::Index>(a.size());
  rigor::DynamicIntervalMatrix matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      matrix(i, j) = a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return rigor::solve_discrete_lyapunov(matrix, q);
}

rigor::DynamicIntervalMatrix square_of(const Row& column) {
  const auto n = static_cast<Eigen::Index>(column.size());
  rigor::DynamicIntervalMatrix q(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      q(i, j) = column[static_cast<std::size_t>(i)] * column[static_cast<std::size_t>(j)];
      q(j, i) = q(i, j);
    }
  }
  return q;
}

/// A range of factors.
struct Factors {
  double low, high;
  int halvings_left;
};

/// No eigenvalue reaches the unit circle between two factors: else two would have the product 1.
bool none_crosses(const DetectorLoop& loop, double low, double high) {
  constexpr int kDeepest = 14;
  constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();
  const auto look = [&](const Factors& part) -> search::CellDecision<Factors> {
    const Interval factors = Interval::from_bounds(part.low, part.high);
    if (solution(with_factor(loop, factors), square_of(loop.effect))) {
      return {true};
    }
    const double middle = 0.5 * part.low + 0.5 * part.high;
    if (part.halvings_left == 0 || !(part.low < middle && middle < part.high)) {
      return {};
    }
    const int left = part.halvings_left - 1;
    return {false, std::array{Factors{part.low, middle, left}, Factors{middle, part.high, left}}};
  };
  return search::cover_by_bisection(Factors{low, high, kDeepest}, kUnlimited, look).is_proved;
}

}  // namespace

std::optional<Interval> noise_bandwidth(const DetectorLoop& loop) {
  if (are_within(loop.a, 1.0) != Verdict::proved) {
    return std::nullopt;
  }
  const DetectorLoop scaled = in_own_units(loop);
  const auto x = solution(scaled.a, square_of(scaled.effect));
  if (!x) {
    return std::nullopt;
  }
  Interval sum(0.0);
  for (Eigen::Index i = 0; i < x->rows(); ++i) {
    for (Eigen::Index j = 0; j < x->cols(); ++j) {
      sum +=
          scaled.phase[static_cast<std::size_t>(i)] * (*x)(i, j) * scaled.phase[static_cast<std::size_t>(j)];
    }
  }
  return rigor::is_finite(sum) ? std::optional(rigor::pi() * sum) : std::nullopt;
}

Verdict is_stable_up_to(const DetectorLoop& loop, const Interval& factor) {
  const Verdict as_it_is = are_within(loop.a, 1.0);
  if (as_it_is == Verdict::refuted || are_within(with_factor(loop, factor), 1.0) == Verdict::refuted) {
    return Verdict::refuted;
  }
  const bool is_proved = as_it_is == Verdict::proved && rigor::is_finite(factor) &&
                         none_crosses(in_own_units(loop), 1.0, factor.upper());
  return is_proved ? Verdict::proved : Verdict::undecided;
}

}  // namespace veritrack::linear
