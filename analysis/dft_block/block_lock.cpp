#include "analysis/dft_block/block_lock.hpp"

#include <array>
#include <cmath>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/norms.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_definiteness.hpp"
#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using Number = rigor::Dual<Interval, kStates>;

BlockProblem<Number> constants(const BlockProblem<Interval>& problem) {
  return {Number(problem.q1),     Number(problem.q2), Number(problem.q3), Number(problem.weight),
          Number(problem.offset), Number(problem.pi), problem.half_width};
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

/// A matrix S in which a step of this derivative contracts: sum of (J/m)'^k D^-2 (J/m)^k = S'S, D a size of
/// each state and m that share of the way from the spectral radius to 1. Proposed.
std::optional<rigor::Matrix<kStates>> propose_metric(const rigor::Matrix<kStates>& derivative,
                                                     const rigor::Vector<kStates>& centre, double share) {
  const rigor::NearestRounding nearest;
  const double largest = rigor::spectral_radius(derivative);
  if (!(largest < 1.0)) {
    return std::nullopt;
  }
  const double between = largest + share * (1.0 - largest);
  // Opaque, or the compiler may compute the products below before the mode is set: clang 14 does.
  const double first = rigor::detail::opaque(centre(3));
  const double second = rigor::detail::opaque(centre(6));
  const double third = rigor::detail::opaque(centre(8));
  rigor::Vector<kStates> size;
  size << std::sqrt(first), std::sqrt(second), std::sqrt(third), first, std::sqrt(first * second),
      std::sqrt(first * third), second, std::sqrt(second * third), third;
  rigor::Matrix<kStates> sum = size.cwiseInverse().cwiseAbs2().asDiagonal();
  rigor::Matrix<kStates> power = derivative / between;
  for (int k = 0; k < 20; ++k) {  // doubles the number of terms
    sum = (sum + power.transpose() * sum * power).eval();
    power = (power * power).eval();
  }
  const auto root = rigor::cholesky(sum);
  return root ? std::optional<rigor::Matrix<kStates>>(rigor::transposed(*root)) : std::nullopt;
}

/// The end of the run; empty when it does not end.
std::optional<rigor::Vector<kStates>> run_to_the_end(const BlockProblem<Interval>& problem,
                                                     rigor::Vector<kStates> state) {
  const rigor::NearestRounding nearest;
  const BlockProblem<double> doubles{
      midpoint(problem.q1),     midpoint(problem.q2),  midpoint(problem.q3), midpoint(problem.weight),
      midpoint(problem.offset), trackers::detail::kPi, problem.half_width};
  constexpr int kBlocks = 6'000;
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

/// At most the largest singular value of S DG S^-1 over the ball; `inverse` encloses S^-1.
std::optional<double> contraction_over(const BlockProblem<Interval>& problem, const LockProposal& proposal,
                                       const rigor::IntervalMatrix<kStates>& inverse) {
  rigor::IntervalVector<kStates> box;
  for (int i = 0; i < kStates; ++i) {
    box(i) = Interval(proposal.centre(i)) + Interval(proposal.radius) *
                                                length_of(inverse.row(i).transpose()) *
                                                Interval::from_bounds(-1.0, 1.0);
  }
  return rigor::norm_upper_bound(
      (rigor::to_interval(proposal.metric) * map_over(box, problem).derivative * inverse).eval());
}

bool has_covariance(const rigor::Vector<kStates>& state) {
  rigor::LowerTriangle<3> lower;
  constexpr std::array<std::array<int, 3>, 3> kPlaces{{{3, 4, 5}, {4, 6, 7}, {5, 7, 8}}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      lower[i][k] = Interval(state(kPlaces[i][k]));
    }
  }
  return state.allFinite() && rigor::certainly_positive_definite(lower);
}

}  // namespace

std::optional<BlockLock> verify_lock(const BlockProblem<Interval>& problem, const LockProposal& proposal) {
  const auto inverse = rigor::inverse(rigor::to_interval(proposal.metric));
  if (!inverse || !(proposal.radius > 0.0) || !std::isfinite(proposal.radius) || !(proposal.rate > 0.0) ||
      !(proposal.rate < 1.0) || !has_covariance(proposal.centre)) {
    return std::nullopt;
  }
  const Interval radius(proposal.radius);
  const Interval rate(proposal.rate);
  const rigor::IntervalVector<kStates> centre = rigor::to_interval(proposal.centre);
  rigor::IntervalVector<kStates> reach;
  for (int i = 0; i < kStates; ++i) {
    reach(i) = length_of(inverse->row(i).transpose());
  }
  const rigor::IntervalVector<kStates> box = centre + radius * reach * Interval::from_bounds(-1.0, 1.0);
  const std::optional<double> contraction = contraction_over(problem, proposal, *inverse);
  rigor::IntervalVector<kStates> step = map_over(centre, problem).value - centre;
  step(1) -= Interval(2.0) * rigor::pi() * Interval(proposal.turns);
  const Interval moved = length_of((rigor::to_interval(proposal.metric) * step).eval());
  if (!contraction || !rigor::certainly_less_equal(Interval(*contraction), rate) ||
      !rigor::certainly_less_equal(moved + rate * radius, radius)) {
    return std::nullopt;
  }
  // The fixed point is at most |G(s_0) - s_0| / (1 - kappa) away from s_0.
  const Interval away = moved / (Interval(1.0) - rate) * Interval::from_bounds(-1.0, 1.0);
  return BlockLock{proposal,
                   box(2),
                   box(1),
                   Interval(1.0) + box(0),
                   centre(2) + away * reach(2),
                   square(Interval(1.0) + centre(0) + away * reach(0))};
}

std::optional<BlockLock> find_lock(const BlockProblem<Interval>& problem,
                                   const rigor::Vector<kStates>& start) {
  const auto centre = run_to_the_end(problem, start);
  if (!centre) {
    return std::nullopt;
  }
  const MapOverBox there = map_over(rigor::to_interval(*centre), problem);
  const double turns = (midpoint(there.value(1)) - (*centre)(1)) / (2.0 * trackers::detail::kPi);
  constexpr double kMostTurns = 1000.0;
  if (!(std::fabs(turns) < kMostTurns)) {
    return std::nullopt;
  }
  std::optional<BlockLock> best;
  for (const double share : {0.1, 0.3, 0.6}) {
    LockProposal proposal;
    proposal.centre = *centre;
    proposal.turns = static_cast<int>(std::lround(turns));
    const auto metric = propose_metric(rigor::midpoint(there.derivative), *centre, share);
    const auto inverse = metric ? rigor::inverse(rigor::to_interval(*metric)) : std::nullopt;
    if (!inverse) {
      continue;
    }
    proposal.metric = *metric;
    for (proposal.radius = 1.0; proposal.radius > 1e-6; proposal.radius *= 0.85) {
      const auto contraction = contraction_over(problem, proposal, *inverse);
      if (!contraction || !(*contraction < 1.0)) {
        continue;
      }
      proposal.radius *= 0.8;  // room for the enclosures of other programs
      proposal.rate = 0.5 * (1.0 + *contraction);
      const auto found = verify_lock(problem, proposal);
      if (found && (!best || width(found->offset_error) > width(best->offset_error))) {
        best = found;
      }
      break;
    }
  }
  return best;
}

}  // namespace veritrack::dft_block
