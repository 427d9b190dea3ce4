#include "analysis/dft_block/block_lock.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/norms.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using Number = rigor::Dual<Interval, kStates>;

BlockProblem<Number> constants(const BlockProblem<Interval>& problem) {
  return {Number(problem.q1),     Number(problem.q2), Number(problem.q3), Number(problem.r),
          Number(problem.offset), Number(problem.pi), problem.half};
}

/// G and its derivatives over a box.
struct MapOverBox {
  rigor::IntervalVector<kStates> value;
  rigor::IntervalMatrix<kStates> derivative;
};

MapOverBox map_over(const rigor::IntervalVector<kStates>& box, const BlockProblem<Interval>& problem) {
  BlockState<Number> state;
  for (int i = 0; i < kStates; ++i) {
    state(i) = rigor::variable<kStates>(box(i), i);
  }
  const BlockState<Number> next = block_map(state, constants(problem));
  MapOverBox result;
  for (int i = 0; i < kStates; ++i) {
    result.value(i) = next(i).value();
    for (int j = 0; j < kStates; ++j) {
      result.derivative(i, j) = next(i).derivative(j);
    }
  }
  return result;
}

Interval length_of(const rigor::IntervalVector<kStates>& vector) {
  Interval sum(0.0);
  for (int i = 0; i < kStates; ++i) {
    sum += square(vector(i));
  }
  return sqrt(sum);
}

/// A matrix S in which a step of this derivative contracts by little more than its spectral radius. Proposed.
std::optional<rigor::Matrix<kStates>> propose_metric(const rigor::Matrix<kStates>& derivative) {
  const rigor::NearestRounding nearest;
  const double largest = derivative.eigenvalues().cwiseAbs().maxCoeff();
  if (!(largest < 1.0)) {
    return std::nullopt;
  }
  // X = sum of (J/m)'^k Q (J/m)^k, m between the spectral radius and 1.
  const double between = std::sqrt(largest);
  rigor::Vector<kStates> scale;
  scale << 0.1, 0.1, 0.05, 0.01, 0.01, 0.01, 0.05, 0.02, 0.01;
  rigor::Matrix<kStates> sum = scale.cwiseInverse().cwiseAbs2().asDiagonal();
  rigor::Matrix<kStates> power = derivative / between;
  for (int k = 0; k < 20; ++k) {  // doubles the number of terms
    sum = (sum + power.transpose() * sum * power).eval();
    power = (power * power).eval();
  }
  const Eigen::LLT<rigor::Matrix<kStates>> root(sum);
  if (root.info() != Eigen::Success || !sum.allFinite()) {
    return std::nullopt;
  }
  return rigor::Matrix<kStates>(root.matrixU());
}

/// Where the run ends; none when it does not.
std::optional<rigor::Vector<kStates>> run_to_the_end(const BlockProblem<Interval>& problem,
                                                     rigor::Vector<kStates> state) {
  const rigor::NearestRounding nearest;
  const BlockProblem<double> doubles{midpoint(problem.q1), midpoint(problem.q2),     midpoint(problem.q3),
                                     midpoint(problem.r),  midpoint(problem.offset), trackers::detail::kPi,
                                     problem.half};
  constexpr int kBlocks = 20'000;
  constexpr double kStill = 1e-13;
  constexpr double kTurn = 2.0 * trackers::detail::kPi;
  for (int k = 0; k < kBlocks; ++k) {
    rigor::Vector<kStates> next = block_map<double>(state, doubles);
    next(1) = std::remainder(next(1), kTurn);
    if (!next.allFinite()) {
      return std::nullopt;
    }
    const bool is_still = (next - state).cwiseAbs().maxCoeff() < kStill;
    state = next;
    if (is_still) {
      return state;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<BlockLock> verify_lock(const BlockProblem<Interval>& problem, const LockProposal& proposal) {
  const auto inverse = rigor::inverse(rigor::to_interval(proposal.metric));
  if (!inverse || !(proposal.radius > 0.0) || !std::isfinite(proposal.radius)) {
    return std::nullopt;
  }
  const Interval radius(proposal.radius);
  const rigor::IntervalVector<kStates> centre = rigor::to_interval(proposal.centre);
  rigor::IntervalVector<kStates> box;
  rigor::IntervalVector<kStates> reach;
  for (int i = 0; i < kStates; ++i) {
    reach(i) = length_of(inverse->row(i).transpose());
    box(i) = centre(i) + radius * reach(i) * Interval::from_bounds(-1.0, 1.0);
  }
  const rigor::IntervalMatrix<kStates> metric = rigor::to_interval(proposal.metric);
  const std::optional<double> contraction =
      rigor::norm_upper_bound((metric * map_over(box, problem).derivative * *inverse).eval());
  rigor::IntervalVector<kStates> step = map_over(centre, problem).value - centre;
  step(1) -= Interval(2.0) * rigor::pi() * Interval(proposal.turns);
  const Interval moved = length_of((metric * step).eval());
  if (!contraction || !rigor::certainly_less(Interval(*contraction), Interval(1.0)) ||
      !rigor::certainly_less_equal(moved + Interval(*contraction) * radius, radius)) {
    return std::nullopt;
  }
  // The fixed point is at most |G(s_0) - s_0| / (1 - kappa) away from s_0.
  const Interval away = moved / (Interval(1.0) - Interval(*contraction)) * Interval::from_bounds(-1.0, 1.0);
  return BlockLock{proposal, *contraction, box(2), centre(2) + away * reach(2),
                   square(centre(0) + away * reach(0))};
}

std::optional<BlockLock> find_lock(const BlockProblem<Interval>& problem,
                                   const rigor::Vector<kStates>& start) {
  const auto centre = run_to_the_end(problem, start);
  if (!centre) {
    return std::nullopt;
  }
  const MapOverBox there = map_over(rigor::to_interval(*centre), problem);
  const auto metric = propose_metric(rigor::midpoint(there.derivative));
  const double turns = (midpoint(there.value(1)) - (*centre)(1)) / (2.0 * trackers::detail::kPi);
  constexpr double kMostTurns = 1000.0;
  if (!metric || !(std::fabs(turns) < kMostTurns)) {
    return std::nullopt;
  }
  for (double radius = 1.0; radius > 1e-6; radius *= 0.7) {
    if (auto found = verify_lock(problem, {*centre, *metric, radius, static_cast<int>(std::lround(turns))})) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::dft_block
