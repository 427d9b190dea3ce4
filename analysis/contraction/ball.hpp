// Contraction on a ball around the fixed points of a closed loop (fixed_point.hpp).
//
// Let X*(p) be a branch of fixed points over an interval of parameters, T an invertible matrix, |e|_T = |T
// e|, B = {|X - X*(p)|_T <= R}. Suppose that for all p of the branch, X in B, |v| <= V, |w| <= W
//     |G(X; p, 0) - X*(p)|_T <= kappa |X - X*(p)|_T,  kappa < 1,
//     |G(X; p, (v, w)) - G(X; p, 0)|_T <= L_v |v| + L_w |w|,   |dX*/dp|_T <= L*,
//     kappa R + L_v V + (L_w + L*) W <= R.
// Then for every noise |v(k)| <= V and every parameter sequence of the branch with |p(k+1) - p(k)| = |w(k)|
// <= W, a start in B(p(0)) stays in B(p(k)) for ever, and
//     |X(k) - X*(p(k))|_T <= kappa^k |X(0) - X*(p(0))|_T + U,   U = (L_v V + (L_w + L*) W) / (1 - kappa).
//
// The branch is cut into cells with constants of their own, except L*, which is taken over all of it. The
// last inequality is then needed cell by cell, U is the largest of the cells', and kappa too: while the level
// x = |X - X*|_T is above U, x(k+1) - U <= kappa (x(k) - U) whichever cell applies, and once below it stays
// below.
//
// kappa by Taylor at X*, with e = X - X*, A = DG(X*), B2 = D2G(X*) and D3 an enclosure of D3G over the ball's
// box:  G(X) - X* = A e + B2(e, e)/2 + D3(e, e, e)/6. In the metric, with u = T e / |T e| and rho = |T e| <=
// R, the quotient is |A u + rho/2 B2(u,u) + rho^2/6 D3(u,u,u)|, and |u (x) u| = |u (x) u (x) u| = 1: hence
//     kappa <= |A| + R/2 |B2| + R^2/6 |D3|, each the spectral norm of the N x N^k matrix.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/contraction/ball_derivatives.hpp"
#include "analysis/contraction/fixed_point.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/norms.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::contraction {

/// What is to be verified. All numbers are exact doubles.
template <int N>
struct BallProposal {
  rigor::Matrix<N> metric;  ///< T
  double radius = 0.0;      ///< R > 0
  double noise = 0.0;       ///< V >= 0
  double slew = 0.0;        ///< W >= 0, of the parameter per step
};

/// The upper bounds of one cell of the branch.
struct BallCell {
  rigor::Interval parameter;
  double linear = 0.0;       ///< |DG(X*)|
  double quadratic = 0.0;    ///< |D2G(X*)|
  double cubic = 0.0;        ///< |D3G| over the ball
  double rate = 0.0;         ///< kappa
  double noise_gain = 0.0;   ///< L_v
  double slew_gain = 0.0;    ///< L_w
  double branch_gain = 0.0;  ///< L*; zero where the parameter does not change (W = 0)
};

/// What was found, with what it takes to check it again.
template <int N>
struct BallCertificate {
  /// PROVED: the statement at the top of ball.hpp, with the bounds below. Otherwise UNDECIDED.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string reason;
  BallProposal<N> proposal;
  rigor::IntervalMatrix<N> inverse;  ///< encloses T^-1
  std::vector<BallCell> cells;
  double rate = 0.0;            ///< kappa, the largest of the cells
  double noise_gain = 0.0;      ///< L_v, the largest of the cells
  double slew_gain = 0.0;       ///< L_w + L*, the largest of the cells
  double ultimate_level = 0.0;  ///< U, the largest of the cells
  /// Which cell of the branch did not contract, when that is why it is UNDECIDED.
  std::optional<std::size_t> failed_cell;
};

namespace detail {

/// Bounds on |e_i| over {|T e| <= level}: level times the lengths of the rows of T^-1.
template <int N>
[[nodiscard]] rigor::IntervalVector<N> row_bounds(const rigor::IntervalMatrix<N>& inverse,
                                                  const rigor::Interval& level) {
  rigor::IntervalVector<N> bounds;
  for (int i = 0; i < N; ++i) {
    rigor::Interval sum(0.0);
    for (int j = 0; j < N; ++j) {
      sum += square(inverse(i, j));
    }
    bounds[i] = level * sqrt(sum);
  }
  return bounds;
}

/// dG/dd for d = (v, w), as it is at X* and d = 0, and how far it moves over the ball and the disturbances.
template <typename Loop>
struct DisturbanceDerivatives {
  static constexpr int kSize = Loop::kStates;
  static constexpr int kInputs = Loop::kNoises + 1;
  using Once = rigor::Dual<rigor::Interval, kSize + kInputs>;
  using Twice = rigor::Dual<Once, kInputs>;

  rigor::IntervalMatrix<kSize, kInputs> first;
  /// d/d(X, d) of each column of dG/dd.
  std::array<rigor::IntervalMatrix<kSize, kSize + kInputs>, static_cast<std::size_t>(kInputs)> second;

  DisturbanceDerivatives(const Loop& loop, const rigor::IntervalVector<kSize>& center,
                         const rigor::IntervalVector<kSize>& ball, const rigor::Interval& parameter,
                         const rigor::IntervalVector<kInputs>& disturbance) {
    const rigor::IntervalVector<kInputs> quiet =
        rigor::IntervalVector<kInputs>::Constant(rigor::Interval(0.0));
    const Column<Twice, kSize> at_center = evaluate(loop, center, parameter, quiet);
    const Column<Twice, kSize> over_ball = evaluate(loop, ball, parameter, disturbance);
    for (int row = 0; row < kSize; ++row) {
      for (int input = 0; input < kInputs; ++input) {
        first(row, input) = at_center[row].derivative(input).value();
        for (int j = 0; j < kSize + kInputs; ++j) {
          second[static_cast<std::size_t>(input)](row, j) = over_ball[row].derivative(input).derivative(j);
        }
      }
    }
  }

 private:
  static Column<Twice, kSize> evaluate(const Loop& loop, const rigor::IntervalVector<kSize>& state,
                                       const rigor::Interval& parameter,
                                       const rigor::IntervalVector<kInputs>& disturbance) {
    Column<Twice, kSize> x;
    for (int i = 0; i < kSize; ++i) {
      x[i] = Twice(rigor::variable<kSize + kInputs>(state[i], i));
    }
    Column<Twice, kInputs> d;
    for (int i = 0; i < kInputs; ++i) {
      d[i] = rigor::variable<kInputs>(rigor::variable<kSize + kInputs>(disturbance[i], kSize + i), i);
    }
    return loop(x, Twice(Once(parameter)), d);
  }
};

/// An upper bound on |T dG/dd|, over the ball and the disturbances, for `count` inputs from `begin` on: at
/// the center, plus R times the norm of the bilinear map (d, u) -> D_X D_d G, plus |d| times that of D_d D_d
/// G.
template <typename Loop>
[[nodiscard]] std::optional<double> disturbance_gain(const DisturbanceDerivatives<Loop>& derivatives,
                                                     const rigor::IntervalMatrix<Loop::kStates>& metric,
                                                     const rigor::IntervalMatrix<Loop::kStates>& inverse,
                                                     Eigen::Index begin, Eigen::Index count, double radius,
                                                     const rigor::Interval& disturbance_size) {
  constexpr int kSize = Loop::kStates;
  constexpr int kInputs = Loop::kNoises + 1;
  if (count == 0) {
    return 0.0;
  }
  rigor::DynamicIntervalMatrix by_state(kSize, kSize * count);
  rigor::DynamicIntervalMatrix by_disturbance(kSize, kInputs * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& slope = derivatives.second[static_cast<std::size_t>(begin + k)];
    by_state.middleCols(kSize * k, kSize) = (metric * slope.template leftCols<kSize>()).eval() * inverse;
    by_disturbance.middleCols(kInputs * k, kInputs) = metric * slope.template rightCols<kInputs>();
  }
  const rigor::DynamicIntervalMatrix at_center = metric * derivatives.first.middleCols(begin, count);
  const auto center = rigor::norm_upper_bound(at_center);
  const auto state = rigor::norm_upper_bound(by_state);
  const auto disturbance = rigor::norm_upper_bound(by_disturbance);
  if (!center || !state || !disturbance) {
    return std::nullopt;
  }
  const rigor::Interval gain = rigor::Interval(*center) + rigor::Interval(radius) * rigor::Interval(*state) +
                               disturbance_size * rigor::Interval(*disturbance);
  return is_finite(gain) ? std::optional(gain.upper()) : std::nullopt;
}

/// kappa from the three norms.
[[nodiscard]] inline rigor::Interval taylor_rate(double linear, double quadratic, double cubic,
                                                 double radius) {
  using rigor::Interval;
  const Interval r(radius);
  return Interval(linear) + r * Interval(0.5) * Interval(quadratic) +
         square(r) * Interval(cubic) / Interval(6.0);
}

/// Upper bounds on |DG(X*(p))| and |D2G(X*(p))| in the metric, for all p of a part of a tube: at its middle,
/// plus half its width times the norm of the derivative along the branch. (Over the box of all X*(p) at once
/// the widths of the entries would add up.)
struct CenterBounds {
  double linear = 0.0;
  double quadratic = 0.0;
};

/// `slope` encloses dX*/dp over the part. Nothing when something is not finite.
template <typename Loop>
[[nodiscard]] std::optional<CenterBounds> bound_center(const Loop& loop,
                                                       const FixedPointTube<Loop::kStates>& tube,
                                                       const rigor::Interval& part,
                                                       const rigor::IntervalMatrix<Loop::kStates>& metric,
                                                       const rigor::IntervalMatrix<Loop::kStates>& inverse,
                                                       const rigor::IntervalVector<Loop::kStates>& slope) {
  constexpr int kSize = Loop::kStates;
  using rigor::Interval;
  const Interval middle(midpoint(part));
  const rigor::IntervalVector<kSize> center = tube.at(middle);
  const auto first_norm = [&](const rigor::IntervalMatrix<kSize>& first) {
    return rigor::norm_upper_bound(rigor::IntervalMatrix<kSize>((metric * first).eval() * inverse));
  };
  const auto second_norm = [&](const SecondDerivatives<kSize>& second) {
    return rigor::norm_upper_bound(unfolded<kSize>(second, metric, inverse));
  };
  const auto linear = first_norm(linearize_loop<Loop, Interval>(loop, center, middle).jacobian);
  const auto quadratic = second_norm(second_derivatives(loop, center, middle));
  if (!linear || !quadratic) {
    return std::nullopt;
  }
  if (part == middle) {
    return CenterBounds{*linear, *quadratic};
  }
  const DerivativeDrift<kSize> drift = derivative_drift(loop, tube.at(part), part, slope);
  const auto linear_drift = first_norm(drift.first);
  const auto quadratic_drift = second_norm(drift.second);
  if (!linear_drift || !quadratic_drift) {
    return std::nullopt;
  }
  const Interval reach(radius(part));
  const Interval linear_bound = Interval(*linear) + reach * Interval(*linear_drift);
  const Interval quadratic_bound = Interval(*quadratic) + reach * Interval(*quadratic_drift);
  if (!is_finite(linear_bound) || !is_finite(quadratic_bound)) {
    return std::nullopt;
  }
  return CenterBounds{linear_bound.upper(), quadratic_bound.upper()};
}

/// The bounds of one cell; nothing when one of them is not finite.
template <typename Loop>
[[nodiscard]] std::optional<BallCell> bound_cell(const Loop& loop, const FixedPointTube<Loop::kStates>& tube,
                                                 const rigor::Interval& part,
                                                 const BallProposal<Loop::kStates>& proposal,
                                                 const rigor::IntervalMatrix<Loop::kStates>& inverse) {
  constexpr int kSize = Loop::kStates;
  constexpr int kInputs = Loop::kNoises + 1;
  using rigor::Interval;
  const rigor::IntervalMatrix<kSize> metric = rigor::to_interval(proposal.metric);
  const rigor::IntervalVector<kSize> center = tube.at(part);
  const rigor::IntervalVector<kSize> reach = row_bounds<kSize>(inverse, Interval(proposal.radius));
  rigor::IntervalVector<kSize> ball = center;
  for (int i = 0; i < kSize; ++i) {
    ball[i] += rigor::symmetric(reach[i].upper());
  }
  const auto local = linearize_loop<Loop, Interval>(loop, center, part);
  const auto slope =
      rigor::solve(rigor::IntervalMatrix<kSize>(rigor::IntervalMatrix<kSize>::Identity() - local.jacobian),
                   local.parameter_slope);
  if (!slope) {
    return std::nullopt;
  }
  const auto at_center = bound_center(loop, tube, part, metric, inverse, *slope);
  const auto cubic =
      rigor::norm_upper_bound(unfolded<kSize>(third_derivatives(loop, ball, part), metric, inverse));
  if (!at_center || !cubic) {
    return std::nullopt;
  }
  const Interval rate = taylor_rate(at_center->linear, at_center->quadratic, *cubic, proposal.radius);

  rigor::IntervalVector<kInputs> disturbance;
  disturbance.fill(rigor::symmetric(proposal.noise));
  disturbance[kInputs - 1] = rigor::symmetric(proposal.slew);
  const Interval size = sqrt(square(Interval(proposal.noise)) + square(Interval(proposal.slew)));
  const DisturbanceDerivatives<Loop> derivatives(loop, center, ball, part, disturbance);
  const auto noise_gain =
      disturbance_gain(derivatives, metric, inverse, 0, Loop::kNoises, proposal.radius, size);
  const auto slew_gain =
      disturbance_gain(derivatives, metric, inverse, Loop::kNoises, 1, proposal.radius, size);
  if (!is_finite(rate) || !noise_gain || !slew_gain) {
    return std::nullopt;
  }
  BallCell cell{part,         at_center->linear, at_center->quadratic, *cubic,
                rate.upper(), *noise_gain,       *slew_gain,           0.0};
  if (proposal.slew > 0.0) {
    const auto branch_gain = rigor::norm_upper_bound((metric * *slope).eval());
    if (!branch_gain) {
      return std::nullopt;
    }
    cell.branch_gain = *branch_gain;
  }
  return cell;
}

/// A double for a sentence; the certificate's numbers are elsewhere.
[[nodiscard]] inline std::string about(double value) {
  return rigor::to_decimal(value, 4, rigor::Direction::up);
}

/// Bounds over a part of a tube, split as long as its own contraction is not certain; false, with a reason in
/// the certificate, when that does not help.
template <typename Loop>
[[nodiscard]] bool bound_tube(const Loop& loop, const FixedPointTube<Loop::kStates>& tube,
                              const rigor::Interval& part, int depth,
                              BallCertificate<Loop::kStates>& certificate) {
  using rigor::Interval;
  constexpr int kDeepest = 3;
  const BallProposal<Loop::kStates>& proposal = certificate.proposal;
  const auto cell = bound_cell(loop, tube, part, proposal, certificate.inverse);
  bool contracts = false;
  if (cell) {
    // Without L*, which is known only in the end.
    const Interval reached =
        Interval(cell->rate) * Interval(proposal.radius) +
        Interval(cell->noise_gain) * Interval(proposal.noise) +
        (Interval(cell->slew_gain) + Interval(cell->branch_gain)) * Interval(proposal.slew);
    contracts = rigor::decide_less(Interval(cell->rate), Interval(1.0)) == rigor::Verdict::proved &&
                rigor::decide_less_equal(reached, Interval(proposal.radius)) == rigor::Verdict::proved;
    if (contracts) {
      certificate.cells.push_back(*cell);
      return true;
    }
  }
  const double middle = midpoint(part);
  const bool splits = depth < kDeepest && part.lower() < middle && middle < part.upper();
  if (splits) {
    return bound_tube(loop, tube, Interval::from_bounds(part.lower(), middle), depth + 1, certificate) &&
           bound_tube(loop, tube, Interval::from_bounds(middle, part.upper()), depth + 1, certificate);
  }
  const std::string place = "near the parameter " + about(middle);
  if (!cell) {
    certificate.reason = place + " the map could not be enclosed over the ball: its box is too large";
  } else if (!(cell->rate < 1.0)) {
    certificate.reason =
        place + " the contraction rate is bounded by " + about(cell->rate) + " only, which is not below 1";
  } else {
    certificate.reason = place + " the disturbances may carry a state out of the ball of radius " +
                         about(proposal.radius) + ": contraction rate " + about(cell->rate) +
                         ", noise gain " + about(cell->noise_gain) + ", slew gain " + about(cell->slew_gain) +
                         " and " + about(cell->branch_gain) + " for the fixed point itself";
  }
  return false;
}

}  // namespace detail

/// Verifies the statement at the top of this file over a branch: neighbouring cells (follow_branch), or a
/// single one. Never throws for numbers, however bad: they are UNDECIDED. Holds its own rounding mode.
template <typename Loop>
[[nodiscard]] BallCertificate<Loop::kStates> verify_ball(
    const Loop& loop, const std::vector<FixedPointTube<Loop::kStates>>& branch,
    const BallProposal<Loop::kStates>& proposal) {
  using rigor::Interval;
  const rigor::UpwardRounding upward;
  BallCertificate<Loop::kStates> certificate;
  certificate.proposal = proposal;
  const bool usable = proposal.metric.allFinite() && std::isfinite(proposal.radius) &&
                      proposal.radius > 0.0 && std::isfinite(proposal.noise) && proposal.noise >= 0.0 &&
                      std::isfinite(proposal.slew) && proposal.slew >= 0.0;
  if (!usable || branch.empty()) {
    certificate.reason =
        "the metric, the radius or the disturbances proposed are no numbers that can be used";
    return certificate;
  }
  const auto inverse = rigor::inverse(rigor::to_interval(proposal.metric));
  if (!inverse) {
    certificate.reason = "the metric proposed could not be shown to be invertible";
    return certificate;
  }
  certificate.inverse = *inverse;
  double branch_gain = 0.0;
  for (std::size_t i = 0; i < branch.size(); ++i) {
    if (!detail::bound_tube(loop, branch[i], branch[i].parameter, 0, certificate)) {
      certificate.failed_cell = i;
      return certificate;
    }
  }
  for (const BallCell& cell : certificate.cells) {
    branch_gain = std::max(branch_gain, cell.branch_gain);
  }
  for (const BallCell& cell : certificate.cells) {
    const Interval slew_gain = Interval(cell.slew_gain) + Interval(branch_gain);
    const Interval push =
        Interval(cell.noise_gain) * Interval(proposal.noise) + slew_gain * Interval(proposal.slew);
    const Interval reached = Interval(cell.rate) * Interval(proposal.radius) + push;
    if (rigor::decide_less_equal(reached, Interval(proposal.radius)) != rigor::Verdict::proved) {
      certificate.reason = "near the parameter " + detail::about(midpoint(cell.parameter)) +
                           " the disturbances may carry a state from the ball of radius " +
                           detail::about(proposal.radius) + " to " + detail::about(reached.upper()) +
                           ": contraction rate " + detail::about(cell.rate) + ", noise gain " +
                           detail::about(cell.noise_gain) + ", slew gain " + detail::about(slew_gain.upper());
      return certificate;
    }
    const Interval level = push / (Interval(1.0) - Interval(cell.rate));
    if (!is_finite(level)) {
      certificate.reason =
          "the bounds near the parameter " + detail::about(midpoint(cell.parameter)) + " are not finite";
      return certificate;
    }
    certificate.rate = std::max(certificate.rate, cell.rate);
    certificate.noise_gain = std::max(certificate.noise_gain, cell.noise_gain);
    certificate.slew_gain = std::max(certificate.slew_gain, slew_gain.upper());
    certificate.ultimate_level = std::max(certificate.ultimate_level, level.upper());
  }
  certificate.verdict = rigor::Verdict::proved;
  certificate.reason = "contraction rate " + detail::about(certificate.rate) + " on the ball, in " +
                       std::to_string(certificate.cells.size()) + " cells";
  return certificate;
}

/// The largest noise V at which a PROVED certificate's own bounds keep the ball invariant with slew W, were
/// the gains those of `certificate`: a proposal, since the gains may grow with V; verify_ball decides.
template <int N>
[[nodiscard]] double propose_largest_noise(const BallCertificate<N>& certificate, double slew) {
  const double room = (1.0 - certificate.rate) * certificate.proposal.radius - certificate.slew_gain * slew;
  return std::max(0.0, room / certificate.noise_gain * (1.0 - 1e-9));
}

/// As propose_largest_noise, for the slew.
template <int N>
[[nodiscard]] double propose_largest_slew(const BallCertificate<N>& certificate, double noise) {
  const double room = (1.0 - certificate.rate) * certificate.proposal.radius - certificate.noise_gain * noise;
  return std::max(0.0, room / certificate.slew_gain * (1.0 - 1e-9));
}

/// Bounds on |X_i - X*_i| over {|X - X*|_T <= level}. Empty unless the certificate is PROVED. Holds its own
/// rounding mode.
template <int N>
[[nodiscard]] rigor::IntervalVector<N> state_bounds(const BallCertificate<N>& certificate,
                                                    const rigor::Interval& level) {
  const rigor::UpwardRounding upward;
  if (certificate.verdict != rigor::Verdict::proved) {
    return rigor::IntervalVector<N>();
  }
  return detail::row_bounds<N>(certificate.inverse, level);
}

/// |X - X*(p)|_T for all X of `states` and p of `part`, a part of the tube's parameters: the start lies in
/// the ball when this is certainly at most R. Needs the upward mode.
template <int N>
[[nodiscard]] rigor::Interval distance(const rigor::Matrix<N>& metric, const FixedPointTube<N>& tube,
                                       const rigor::Interval& part, const rigor::IntervalVector<N>& states) {
  const rigor::IntervalVector<N> offset = rigor::to_interval(metric) * (states - tube.at(part)).eval();
  rigor::Interval sum(0.0);
  for (int i = 0; i < N; ++i) {
    sum += square(offset[i]);
  }
  return sqrt(sum);
}

}  // namespace veritrack::contraction
