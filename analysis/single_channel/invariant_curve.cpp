#include "analysis/single_channel/invariant_curve.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/norms.hpp"
#include "analysis/rigor/taylor_model.hpp"
#include "analysis/single_channel/curve_proposal.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::IntervalVector;
using rigor::Verdict;
using trackers::QuadratureEkfDesign;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Functions of the phase over a cell.
template <int Degree>
using OverCell = rigor::TaylorModel<1, Degree>;

template <typename Scalar>
QuadratureEkfDesign<Scalar> lifted(const QuadratureEkfDesign<Interval>& design) {
  const auto lift = [](const Interval& value) {
    if constexpr (requires(Scalar s) { s.derivative(0); }) {
      return Scalar(std::decay_t<decltype(std::declval<Scalar>().value())>(value));
    } else {
      return Scalar(value);
    }
  };
  return {lift(design.q1), lift(design.q2), lift(design.r), lift(design.epsilon)};
}

/// A part of the period with its coordinates.
struct Cell {
  Interval phase;
  rigor::Matrix<9> matrix;           ///< V
  IntervalMatrix<9> inverse;         ///< V^-1, enclosed
  std::vector<std::size_t> targets;  ///< the cells that meet this one moved on by omega, modulo pi
  std::array<double, 9> reach;       ///< |row of V|, upper bounds
};

struct Problem {
  QuadratureEkfDesign<Interval> design;
  Interval frequency;
  PhaseSeries curve;
  std::vector<Cell> cells;
  double expected_rate = 1.0;
};

/// Calls body(cell index) for every cell, in parallel, in the upward mode.
template <typename Body>
void for_each_cell(const Problem& problem, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, problem.cells.size()), [&](const auto& range) {
    const rigor::UpwardRounding upward;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      body(i);
    }
  });
}

/// The larger one; infinite unless both are numbers.
double larger(double a, double b) {
  if (a <= kInfinity && b <= kInfinity) {
    return std::max(a, b);
  }
  return kInfinity;
}

/// Cells that cover [0, pi], without coordinates.
std::vector<Interval> cover_of_period(std::size_t count) {
  constexpr double kAbovePi = 0x1.921fb54442d19p+1;
  std::vector<Interval> cover;
  cover.reserve(count);
  double start = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double end =
        i + 1 == count ? kAbovePi : kAbovePi * static_cast<double>(i + 1) / static_cast<double>(count);
    cover.push_back(Interval::from_bounds(start, end));
    start = end;
  }
  return cover;
}

/// The cells that may hold a phase of `from` + omega modulo pi, for omega in [0, pi]: left out are those that
/// certainly do not.
std::vector<std::size_t> targets_of(const std::vector<Interval>& cover, const Interval& from,
                                    const Interval& frequency) {
  std::vector<std::size_t> targets;
  for (std::size_t j = 0; j < cover.size(); ++j) {
    for (const double turns : {0.0, 1.0, 2.0}) {
      const Interval moved = from + frequency - Interval(turns) * rigor::pi();
      if (rigor::certainly_less(moved, cover[j]) || rigor::certainly_less(cover[j], moved)) {
        continue;
      }
      targets.push_back(j);
      break;
    }
  }
  return targets;
}

/// |x| from above; infinite when x is not finite.
double length(const IntervalVector<9>& x) {
  Interval sum(0.0);
  for (Eigen::Index i = 0; i < 9; ++i) {
    sum += rigor::square(x(i));
  }
  const Interval root = rigor::sqrt(sum);
  return rigor::is_finite(root) ? root.upper() : kInfinity;
}

/// Coordinates for `count` cells along the curve; nothing when a matrix could not be inverted.
std::optional<Problem> set_up(const QuadratureEkfDesign<Interval>& design, const Interval& frequency,
                              const PhaseSeries& curve, std::size_t count) {
  const QuadratureEkfDesign<double> nearest{midpoint(design.q1), midpoint(design.q2), midpoint(design.r),
                                            midpoint(design.epsilon)};
  const std::vector<Interval> cover = cover_of_period(count);
  std::vector<double> phases;
  phases.reserve(count);
  for (const Interval& phase : cover) {
    phases.push_back(midpoint(phase));
  }
  const auto coordinates = propose_coordinates(nearest, midpoint(frequency), curve, phases);
  if (!coordinates) {
    return std::nullopt;
  }
  Problem problem{design, frequency, curve, std::vector<Cell>(count), coordinates->rate};
  std::vector<char> inverted(count, 0);
  for_each_cell(problem, [&](std::size_t i) {
    Cell& cell = problem.cells[i];
    cell.phase = cover[i];
    cell.matrix = coordinates->matrices[i];
    cell.targets = targets_of(cover, cover[i], frequency);
    const IntervalMatrix<9> matrix = rigor::to_interval(cell.matrix);
    for (Eigen::Index row = 0; row < 9; ++row) {
      cell.reach[static_cast<std::size_t>(row)] = length(matrix.row(row).transpose());
    }
    if (const auto inverse = rigor::inverse(matrix)) {
      cell.inverse = *inverse;
      inverted[i] = 1;
    }
  });
  if (std::find(inverted.begin(), inverted.end(), 0) != inverted.end()) {
    return std::nullopt;
  }
  return problem;
}

/// rho of condition (a) for one cell and all its targets; infinite when it could not be bounded.
double residual(const Problem& problem, const Cell& cell) {
  using Model = OverCell<5>;
  const Model phase = Model::variable(cell.phase, 0);
  const Model omega(problem.frequency);
  const Model next_phase = phase + omega;
  const RotatingFrameState<Model> image = trackers::single_channel_map<Model>(
      problem.curve.at(phase), {next_phase, Model(0.0), Model(0.0), omega}, lifted<Model>(problem.design));
  const RotatingFrameState<Model> expected = problem.curve.at(next_phase);
  IntervalVector<9> difference;
  for (Eigen::Index i = 0; i < 9; ++i) {
    difference(i) = (image(i) - expected(i)).range();
  }
  double largest = 0.0;
  for (const std::size_t j : cell.targets) {
    largest = larger(largest, length(problem.cells[j].inverse * difference));
  }
  return largest;
}

/// kappa of condition (b) for one cell and all its targets, over the tube of that radius; infinite when it
/// could not be bounded.
double contraction(const Problem& problem, const Cell& cell, double tube_radius) {
  using Model = OverCell<3>;
  using Dual = rigor::Dual<Model, 9>;
  const Model phase = Model::variable(cell.phase, 0);
  const Model omega(problem.frequency);
  RotatingFrameState<Model> state = problem.curve.at(phase);
  for (Eigen::Index i = 0; i < 9; ++i) {
    const Interval reach = Interval(tube_radius) * Interval(cell.reach[static_cast<std::size_t>(i)]);
    state(i) = state(i).widened(reach.upper());
  }
  const auto map = [&](const auto& x) {
    return trackers::single_channel_map<Dual>(x, {Dual(phase + omega), Dual(0.0), Dual(0.0), Dual(omega)},
                                              lifted<Dual>(problem.design));
  };
  const auto jacobian = rigor::linearize(map, state).jacobian;
  // lazyProduct: Eigen's other products compare scalars, which models cannot be.
  using ModelMatrix = Eigen::Matrix<Model, 9, 9>;
  const ModelMatrix matrix = cell.matrix.unaryExpr([](double x) { return Model(x); });
  const ModelMatrix columns = jacobian.lazyProduct(matrix);
  double largest = 0.0;
  for (const std::size_t j : cell.targets) {
    const ModelMatrix inverse =
        problem.cells[j].inverse.unaryExpr([](const Interval& x) { return Model(x); });
    const ModelMatrix product = inverse.lazyProduct(columns);
    const IntervalMatrix<9> ranges = product.unaryExpr([](const Model& x) { return x.range(); });
    largest = larger(largest, rigor::norm_upper_bound(ranges).value_or(kInfinity));
  }
  return largest;
}

/// The largest of value(cell) over all cells.
template <typename Value>
double largest_over_cells(const Problem& problem, const Value& value) {
  std::vector<double> values(problem.cells.size(), kInfinity);
  for_each_cell(problem, [&](std::size_t i) { values[i] = value(problem.cells[i]); });
  double largest = 0.0;
  for (const double one : values) {
    largest = larger(largest, one);
  }
  return largest;
}

/// What the verified curve says of the frequency error, within `distance` of the series.
void read_off(const Problem& problem, SteadyStateBias& bias) {
  using Model = OverCell<5>;
  const bool no_leak = problem.design.epsilon == Interval(0.0);
  double lowest = kInfinity;
  double lowest_seen = kInfinity;
  double highest = -kInfinity;
  double highest_seen = -kInfinity;
  double largest_error = 0.0;
  bool locked = true;
  for (const Cell& cell : problem.cells) {
    const auto error = [&](Eigen::Index row) {
      return rigor::symmetric(
          (Interval(bias.distance) * Interval(cell.reach[static_cast<std::size_t>(row)])).upper());
    };
    const RotatingFrameState<Model> state = problem.curve.at(Model::variable(cell.phase, 0));
    const Interval range = state(trackers::kFrequencyError).range() + error(trackers::kFrequencyError);
    const Interval somewhere = Interval(state(trackers::kFrequencyError).constant()) +
                               rigor::symmetric(state(trackers::kFrequencyError).remainder()) +
                               error(trackers::kFrequencyError);
    lowest = std::min(lowest, range.lower());
    highest = std::max(highest, range.upper());
    lowest_seen = std::min(lowest_seen, somewhere.upper());
    highest_seen = std::max(highest_seen, somewhere.lower());
    largest_error = larger(largest_error, error(trackers::kFrequencyError).upper());
    locked = locked && rigor::certainly_positive(Interval(1.0) + state(trackers::kDeltaInPhase).range() +
                                                 error(trackers::kDeltaInPhase));
    if (!rigor::is_finite(range) || !rigor::is_finite(somewhere)) {
      bias.reason = "the frequency error could not be bounded";
      return;
    }
  }
  if (!locked) {
    bias.reason =
        "a steady state is verified, but on it the tracker is not shown to be within a quarter turn of the "
        "signal";
    return;
  }
  if (no_leak) {
    bias.mean_bias = bias.min_error = bias.max_error = Interval(0.0);
  } else {
    bias.mean_bias =
        Interval(problem.curve.mean(trackers::kFrequencyError)) + rigor::symmetric(largest_error);
    bias.min_error = Interval::from_bounds(lowest, lowest_seen);
    bias.max_error = Interval::from_bounds(highest_seen, highest);
  }
  bias.verdict = Verdict::proved;
  bias.reason = "an invariant curve is verified, and every start near it converges to it";
}

enum class Attempt { succeeded, wants_smaller_cells, hopeless };

/// Conditions (a) to (c) on `problem`: succeeded when they hold. Says in `bias` how far it came.
Attempt verify(const Problem& problem, SteadyStateBias& bias) {
  const double rho = largest_over_cells(problem, [&](const Cell& cell) { return residual(problem, cell); });
  if (!std::isfinite(rho)) {
    bias.reason = "the proposed curve could not be shown to be nearly invariant";
    return Attempt::wants_smaller_cells;
  }
  // Any radius will do that (c) allows; twice the distance that the expected rate leads to leaves room.
  const double tube_radius = 2.0 * rho / (1.0 - problem.expected_rate);
  const double kappa =
      largest_over_cells(problem, [&](const Cell& cell) { return contraction(problem, cell, tube_radius); });
  const Interval rate(kappa);
  const Interval radius(tube_radius);
  if (!rigor::certainly_less(rate, Interval(1.0))) {
    bias.reason = "the map could not be shown to contract along the steady state";
    constexpr double kBeyondHope = 3.0;  // the rest is due to the width of the cells only when it is small
    return kappa < kBeyondHope ? Attempt::wants_smaller_cells : Attempt::hopeless;
  }
  if (!rigor::certainly_less_equal(rate * radius + Interval(rho), radius)) {
    bias.reason = "the tube about the proposed curve is not mapped into itself";
    return Attempt::wants_smaller_cells;
  }
  const Interval distance = Interval(rho) / (Interval(1.0) - rate);
  if (!rigor::is_finite(distance)) {
    bias.reason = "the distance of the steady state from the proposed curve could not be bounded";
    return Attempt::hopeless;
  }
  bias.rate = kappa;
  bias.distance = distance.upper();
  return Attempt::succeeded;
}

}  // namespace

SteadyStateBias steady_state_bias(const QuadratureEkfDesign<Interval>& design, const Interval& frequency) {
  const rigor::UpwardRounding upward;
  SteadyStateBias bias;
  bias.frequency = frequency;
  if (!rigor::certainly_less_equal(Interval(0.0), frequency) ||
      !rigor::certainly_less_equal(frequency, Interval(rigor::pi().upper()))) {
    bias.reason = "the frequency is not within [0, pi] rad/sample";
    return bias;
  }
  const auto curve = propose_invariant_curve(
      {midpoint(design.q1), midpoint(design.q2), midpoint(design.r), midpoint(design.epsilon)},
      midpoint(frequency));
  if (!curve) {
    bias.reason = "the simulated tracker does not settle";
    return bias;
  }
  for (const std::size_t count : {128U, 512U, 1536U}) {
    const auto problem = set_up(design, frequency, *curve, count);
    if (!problem) {
      bias.reason = "the simulated tracker has no exponentially stable steady state";
      return bias;
    }
    const Attempt attempt = verify(*problem, bias);
    if (attempt == Attempt::succeeded) {
      read_off(*problem, bias);
    }
    if (attempt != Attempt::wants_smaller_cells) {
      return bias;
    }
  }
  return bias;
}

}  // namespace veritrack::single_channel
