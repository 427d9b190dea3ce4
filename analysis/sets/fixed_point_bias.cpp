#include "analysis/sets/fixed_point_bias.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/definiteness.hpp"
#include "analysis/sets/kalman_filter_result.hpp"

namespace veritrack::sets {

namespace {

using rigor::Interval;
using rigor::Verdict;
using State = rigor::IntervalVector<QuadraturePolarLoop::kStates>;

/// An approximate solution of the filter's Riccati equation at frequency error 0, by iteration from r I.
rigor::Vector<6> propose_covariance(const LockedCovarianceLoop<QuadraturePolarLoop>& loop) {
  constexpr int kIterations = 20000;
  const rigor::NearestRounding nearest;
  const double r = midpoint(loop.loop.design.r);
  rigor::Vector<6> covariance;
  covariance << r, 0.0, 0.0, r, 0.0, midpoint(loop.loop.design.q2);
  const Column<double, 1> quiet = Column<double, 1>::Zero();
  for (int i = 0; i < kIterations; ++i) {
    const rigor::Vector<6> next = loop(covariance, 0.0, quiet);
    const double change = (next - covariance).norm();
    covariance = next;
    const bool settled = change <= 1e-15 * covariance.norm();
    if (settled) {
      break;
    }
  }
  return covariance;
}

bool covariance_is_positive_definite(const State& state) {
  rigor::IntervalMatrix<3> p;
  p << state[3], state[4], state[5], state[4], state[6], state[7], state[5], state[7], state[8];
  return rigor::is_positive_definite(p) == Verdict::proved;
}

/// An enclosure of the fixed point without error at omega = 0. That the error is zero there is part of what
/// is verified: G takes the box (0, P) to a state whose first three entries are exactly zero. And it is the
/// filter's: P is positive definite, of which the Riccati equation has only one.
std::optional<State> verify_origin(const QuadraturePolarLoop& loop) {
  const LockedCovarianceLoop<QuadraturePolarLoop> covariance_loop{loop};
  const auto covariance =
      verify_fixed_point(covariance_loop, propose_covariance(covariance_loop), Interval(0.0));
  if (!covariance) {
    return std::nullopt;
  }
  const State origin = LockedCovarianceLoop<QuadraturePolarLoop>::without_error<Interval>(covariance->box());
  const Column<Interval, 3> quiet = Column<Interval, 3>::Constant(Interval(0.0));
  const State image = loop(origin, Interval(0.0), quiet);
  for (int i = 0; i < 3; ++i) {
    const bool exact = image[i] == Interval(0.0);
    if (!exact) {
      return std::nullopt;
    }
  }
  if (!covariance_is_positive_definite(origin)) {
    return std::nullopt;
  }
  return origin;
}

/// Follows the branch from 0 through `first` to `last` (both on the same side of 0, `last` the farther one)
/// and keeps the cells beyond `first`. The frequency reached.
double follow_side(const QuadraturePolarLoop& loop, const State& origin, double first, double last,
                   const BranchSteps& steps, std::vector<BranchCell>& kept) {
  State start = origin;
  if (first != 0.0) {
    const auto approach = follow_branch(loop, origin, 0.0, first, steps);
    if (!approach.complete) {
      return approach.reached;
    }
    start = approach.cells.back().at(Interval(first));
  }
  if (first == last) {
    // A band of one frequency: a cell of zero width, joined like any other.
    const auto point = verify_fixed_point(loop, rigor::Vector<9>(midpoint(start)), Interval(first));
    if (point && holds_one_fixed_point(loop, State(hull(start, point->box())), Interval(first))) {
      kept.push_back(*point);
    }
    return last;
  }
  auto branch = follow_branch(loop, start, first, last, steps);
  std::move(branch.cells.begin(), branch.cells.end(), std::back_inserter(kept));
  return branch.reached;
}

void end_at(double reached, const char* side, LockBranch& branch) {
  const rigor::Direction toward_zero = reached > 0.0 ? rigor::Direction::down : rigor::Direction::up;
  branch.ends_at = reached;
  branch.reason = std::string("the lock branch, continued from frequency 0, is verified only up to ") +
                  rigor::to_decimal(reached, 6, toward_zero) + " rad/sample, and the band's " + side +
                  " end lies beyond: the steady state may cease to exist there";
}

}  // namespace

LockBranch verify_lock_branch(const trackers::ToneModel<Interval>& design, const Interval& band,
                              const BranchSteps& steps) {
  const rigor::UpwardRounding upward;
  LockBranch branch;
  branch.band = band;
  if (!is_finite(band) || !is_finite(design.q1) || !is_finite(design.q2) || !is_finite(design.r) ||
      !is_finite(design.epsilon)) {
    branch.reason = "a design value or the frequency band is not finite";
    return branch;
  }
  const QuadraturePolarLoop loop{design};
  const std::optional<State> origin = verify_origin(loop);
  if (!origin) {
    branch.reason =
        design.q1 == Interval(0.0)
            ? "with q1 = 0 the amplitude is an uncontrollable mode on the unit circle at frequency 0, from "
              "where the lock branch is continued, so that there is no isolated steady state to start with "
              "(a leak remedies this only at other frequencies); any q1 > 0 remedies this"
            : "no isolated positive definite steady-state covariance could be verified at frequency 0";
    return branch;
  }
  const double low = band.lower();
  const double high = band.upper();
  // Without a leak omega has no effect, and one cell covers every frequency.
  BranchSteps taken = steps;
  if (design.without_leak()) {
    taken.largest = std::max(std::fabs(low), std::fabs(high)) + 1.0;
  }
  double reached_low = 0.0;
  double reached_high = 0.0;
  if (low < 0.0) {
    reached_low = follow_side(loop, *origin, std::min(high, 0.0), low, taken, branch.cells);
    std::reverse(branch.cells.begin(), branch.cells.end());
  }
  if (high > 0.0 || (low == 0.0 && high == 0.0)) {
    reached_high = follow_side(loop, *origin, std::max(low, 0.0), high, taken, branch.cells);
  }
  branch.verified = Interval::from_bounds(reached_low, reached_high);
  if (reached_low > low) {
    end_at(reached_low, "lower", branch);
    return branch;
  }
  if (reached_high < high) {
    end_at(reached_high, "upper", branch);
    return branch;
  }
  if (branch.cells.empty()) {
    branch.reason = "no cell of the band could be verified";
    return branch;
  }
  for (const BranchCell& cell : branch.cells) {
    if (!covariance_is_positive_definite(cell.box())) {
      branch.reason = "the steady-state covariance near " +
                      rigor::to_decimal(cell.parameter_center, 6, rigor::Direction::down) +
                      " rad/sample could not be shown to be positive definite";
      return branch;
    }
  }
  branch.verdict = Verdict::proved;
  branch.reason = "verified by Krawczyk's operator in " + std::to_string(branch.cells.size()) +
                  " adjoining cells, continued from the exact estimate at frequency 0";
  return branch;
}

SteadyStateError steady_state_error(const BranchCell& cell) {
  const State state = cell.box();
  return {cell.parameter, state[2], state[1], state[0]};
}

theorems::Quantity frequency_bias(const LockBranch& branch) {
  const rigor::UpwardRounding upward;
  theorems::Quantity quantity = quantities::bias_frequency();
  quantity.formula = "\\hat x_3 - \\omega \\text{ at the fixed point } X^*(\\omega) = G(X^*(\\omega))";
  quantity.source = "Krawczyk, on the lock branch continued from \\omega = 0";
  if (branch.verdict != Verdict::proved || branch.cells.empty()) {
    quantity.not_applicable = branch.reason;
    return quantity;
  }
  quantity.not_applicable.reset();
  quantity.value = steady_state_error(branch.cells.front()).frequency_error;
  for (const BranchCell& cell : branch.cells) {
    quantity.value = hull(quantity.value, steady_state_error(cell).frequency_error);
  }
  return quantity;
}

}  // namespace veritrack::sets
