#include "analysis/quadrature/gaussian/lock_start.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;

/// Cells of the phase error: enough that the covariance hardly turns within one.
constexpr int kCells = 64;

IntervalMatrix<3> turn(const Interval& angle) {
  const auto [sine, cosine] = rigor::sin_cos(angle);
  IntervalMatrix<3> u = IntervalMatrix<3>::Zero();
  u(0, 0) = u(1, 1) = cosine;
  u(1, 0) = sine;
  u(0, 1) = -sine;
  u(2, 2) = Interval(1.0);
  return u;
}

/// True only when both, turned, lie between lo(s) and hi(s).
bool is_level(const LockSet& set, double s, const IntervalMatrix<3>& lowest,
              const IntervalMatrix<3>& highest) {
  const Interval level(s);
  return rigor::is_positive_definite(IntervalMatrix<3>(upper_covariance(set, level) - highest)) ==
             rigor::Verdict::proved &&
         rigor::is_positive_definite(IntervalMatrix<3>(lowest - lower_covariance(set, level))) ==
             rigor::Verdict::proved;
}

/// The level of the covariance, nearly the least that can be shown; empty when it is not below `most`.
Interval covariance_level(const LockSet& set, double most, const IntervalMatrix<3>& lowest,
                          const IntervalMatrix<3>& highest) {
  if (!is_level(set, most, lowest, highest)) {
    return Interval::empty();
  }
  constexpr int kBisections = 20;
  double low = 0.0;
  double high = most;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    (is_level(set, middle, lowest, highest) ? high : low) = middle;
  }
  return Interval(high);
}

}  // namespace

Interval start_level(const LockSet& set, const LockStarts& starts) {
  rigor::require_upward_rounding();
  const IntervalMatrix<3> lowest = starts.covariance.lower_end();
  const IntervalMatrix<3> highest = starts.covariance.upper_end();
  const Interval one(1.0);
  const double widest = starts.phase_error.upper();
  const Interval most_squared = Interval(2.0) * Interval(set.level) / Interval(set.weight);
  const double most = rigor::sqrt(most_squared).lower();
  // cannot bind (most): at the level 0, or at none, no covariance is strictly between its bounds.
  if (!(widest >= 0.0) || !certainly_positive(Interval(most))) {
    return Interval::empty();
  }
  const Interval length = one + rigor::symmetric(starts.amplitude_error.upper());
  const Interval frequency = rigor::symmetric(starts.frequency_error.upper()) - Interval(set.bias[2]);
  Interval worst(0.0);
  for (int k = 0; k < kCells; ++k) {
    // Neighbours share their ends, and the last end is the widest phase error.
    const auto node = [&](int i) { return i == kCells ? widest : widest * (2 * i - kCells) / kCells; };
    const Interval phase = Interval::from_bounds(k == 0 ? -widest : node(k), node(k + 1));
    const IntervalMatrix<3> u = turn(phase);
    const Interval s = covariance_level(set, most, IntervalMatrix<3>(u * lowest * u.transpose()),
                                        IntervalMatrix<3>(u * highest * u.transpose()));
    const auto [sine, cosine] = rigor::sin_cos(phase);
    const Interval real = length * cosine - one - Interval(set.bias[0]);
    const Interval imaginary = length * sine - Interval(set.bias[1]);
    const BlockMetric<double>& t = set.metric;
    const Interval level =
        Interval(0.5) *
        (rigor::square(Interval(t.amplitude) * real) +
         rigor::square(Interval(t.phase) * imaginary + Interval(t.coupling) * frequency) +
         rigor::square(Interval(t.frequency) * frequency) + Interval(set.weight) * rigor::square(s));
    if (!certainly_less_equal(level, Interval(set.level))) {
      return Interval::empty();
    }
    worst = max(worst, level);
  }
  return Interval(worst.upper());
}

}  // namespace veritrack::quadrature
