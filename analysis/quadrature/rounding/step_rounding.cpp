#include "analysis/quadrature/rounding/step_rounding.hpp"

#include <limits>
#include <tuple>
#include <vector>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounded.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Rounded;
using Estimate = trackers::QuadratureEstimate<Rounded>;

/// The factors of P (trackers/factored_covariance.hpp) where P_33 lies in a part of its range.
struct Factors {
  Interval m11, m12, m22, u1, u2, d;
  Interval eigenvalues;  ///< of M
};

/// |X_ij| for 0 <= X <= D in the Loewner order, given that X_jj <= x: |X_ij|^2 <= X_ii X_jj.
Interval beside(const Interval& room, const Interval& x) {
  const Interval none(0.0);
  return rigor::symmetric(upper_or_infinite(rigor::sqrt(rigor::max(room, none) * rigor::max(x, none))));
}

/// Number `index` of `count` pieces of x, which cover it.
Interval piece(const Interval& x, int index, int count) {
  const auto cut = [&](int i) {
    const double share = static_cast<double>(i) / count;
    return i == 0 ? x.lower() : i == count ? x.upper() : x.lower() + (x.upper() - x.lower()) * share;
  };
  return Interval::from_bounds(cut(index), cut(index + 1));
}

Factors factors_of(const HeldStates& box, const Interval& frequency_variance) {
  const Interval half(0.5);
  const auto& low = box.lower;
  const auto& high = box.upper;
  const auto room = [&](int i) { return high(i, i) - low(i, i); };
  Factors f;
  f.d = frequency_variance;
  // P - lower and upper - P are positive semidefinite.
  const auto regression = [&](int i) {
    const Interval above = low(i, 2) + beside(room(i), f.d - low(2, 2));
    const Interval below = high(i, 2) - beside(room(i), high(2, 2) - f.d);
    return intersection(above, below) / f.d;
  };
  f.u1 = regression(0);
  f.u2 = regression(1);
  // The Schur complement M = P_zz - P_z3 P_z3' / P_33 is monotone, too.
  const auto conditional = [](const rigor::IntervalMatrix<3>& p, int i, int j) {
    return i == j ? p(i, i) - rigor::square(p(i, 2)) / p(2, 2) : p(i, j) - p(i, 2) * p(j, 2) / p(2, 2);
  };
  const Interval low11 = conditional(low, 0, 0);
  const Interval low22 = conditional(low, 1, 1);
  const Interval high11 = conditional(high, 0, 0);
  const Interval high22 = conditional(high, 1, 1);
  f.m11 = Interval::from_bounds(low11.lower(), high11.upper());
  f.m22 = Interval::from_bounds(low22.lower(), high22.upper());
  // 0 <= X <= D gives |X_12 - D_12/2| <= sqrt(D_11 D_22)/2.
  f.m12 = half * (conditional(low, 0, 1) + conditional(high, 0, 1)) +
          half * beside(high11 - low11, high22 - low22);
  const Interval least = rigor::min(low11, low22) - rigor::abs(conditional(low, 0, 1));
  const Interval most = rigor::max(high11, high22) + rigor::abs(conditional(high, 0, 1));
  f.eigenvalues = Interval::from_bounds(rigor::max(least, Interval(0.0)).lower(), most.upper());
  return f;
}

/// An orientation.
struct Turn {
  Interval sine, cosine, sine_twice, cosine_twice;
  explicit Turn(const Interval& angle) {
    std::tie(sine, cosine) = rigor::sin_cos(angle);
    std::tie(sine_twice, cosine_twice) = rigor::sin_cos(Interval(2.0) * angle);
  }
};

/// The states turned by the angles, as the program holds them.
Estimate turned(const HeldStates& box, const Factors& f, const Turn& turn, double largest_frequency) {
  const auto& [sine, cosine, sine_twice, cosine_twice] = turn;
  const Interval half(0.5);
  const Interval mean = half * (f.m11 + f.m22);
  const Interval half_difference = half * (f.m11 - f.m22);
  const Interval moved = half_difference * cosine_twice - f.m12 * sine_twice;
  const Interval aside =
      intersection(half_difference * sine_twice + f.m12 * cosine_twice,
                   rigor::symmetric((half * rigor::Interval(rigor::width(f.eigenvalues))).upper()));
  return {Rounded(box.z1 * cosine - box.z2 * sine),
          Rounded(box.z1 * sine + box.z2 * cosine),
          Rounded(rigor::symmetric(largest_frequency)),
          {Rounded(intersection(mean + moved, f.eigenvalues)), Rounded(aside),
           Rounded(intersection(mean - moved, f.eigenvalues)), Rounded(f.u1 * cosine - f.u2 * sine),
           Rounded(f.u1 * sine + f.u2 * cosine), Rounded(f.d)}};
}

}  // namespace

StateDifference step_rounding(const Program& program, const HeldStates& box, const Pieces& pieces) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  rigor::require_upward_rounding();
  const bool in_range = certainly_less_equal(Interval(Rounded::kSmallestUnit), program.amplitude) &&
                        certainly_less_equal(program.amplitude, Interval(Rounded::kLargestUnit));
  // cannot bind (box.lower(2, 2)): regressions are quotients by every variance up to upper(2, 2), which is
  // positive: where zero is among them nothing is finite.
  if (!in_range || !certainly_positive(box.lower(2, 2))) {
    return {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  }
  const trackers::ToneModel<Rounded> design{Rounded(program.design.q1), Rounded(program.design.q2),
                                            Rounded(program.design.r), Rounded(program.design.epsilon)};
  const Rounded measurement(rigor::symmetric(program.largest_measurement));
  const auto whole_turn = Interval::from_bounds(0.0, (Interval(2.0) * rigor::pi()).upper());
  const auto variances = Interval::from_bounds(box.lower(2, 2).lower(), box.upper(2, 2).upper());
  const int regressions = pieces.regression * pieces.regression;
  std::vector<Turn> turns;
  turns.reserve(static_cast<std::size_t>(pieces.angles));
  for (int i = 0; i < pieces.angles; ++i) {
    turns.emplace_back(piece(whole_turn, i, pieces.angles));
  }
  StateDifference all;
  for (int part = 0; part < pieces.frequency_variance * regressions * pieces.amplitude; ++part) {
    const int of_regression = part % regressions;
    const int of_rest = part / regressions;
    Factors f =
        factors_of(box, piece(variances, of_rest % pieces.frequency_variance, pieces.frequency_variance));
    f.u1 = piece(f.u1, of_regression % pieces.regression, pieces.regression);
    f.u2 = piece(f.u2, of_regression / pieces.regression, pieces.regression);
    HeldStates states = box;
    states.z1 = piece(box.z1, of_rest / pieces.frequency_variance, pieces.amplitude);
    for (const Turn& turn : turns) {
      const Estimate before = turned(states, f, turn, program.largest_frequency);
      all = larger(all, difference_of(trackers::step(before, measurement, measurement, design).filtered));
    }
  }
  return all;
}

}  // namespace veritrack::quadrature
