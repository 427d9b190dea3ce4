#include "analysis/single_channel/tube_verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/norms.hpp"
#include "analysis/rigor/taylor_model.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::IntervalVector;
using trackers::ToneModel;

constexpr double kNotBounded = std::numeric_limits<double>::infinity();

/// Functions of the phase over a cell, and, with two variables, of the frequency over its interval.
template <int Variables, int Degree>
using OverCell = rigor::TaylorModel<Variables, Degree>;

/// The frequency: a variable of its own when there are two.
template <typename Model, int Variables>
Model frequency_of(const InvariantTube& tube) {
  if constexpr (Variables == 2) {
    return Model::variable(tube.frequency, 1);
  } else {
    return Model(tube.frequency);
  }
}

template <typename Scalar>
ToneModel<Scalar> lifted(const ToneModel<Interval>& design) {
  const auto lift = [](const Interval& value) {
    if constexpr (requires(Scalar s) { s.derivative(0); }) {
      return Scalar(std::decay_t<decltype(std::declval<Scalar>().value())>(value));
    } else {
      return Scalar(value);
    }
  };
  return {lift(design.q1), lift(design.q2), lift(design.r), lift(design.epsilon)};
}

/// The larger one; infinite unless both are numbers.
double larger(double a, double b) {
  if (a <= kNotBounded && b <= kNotBounded) {
    return std::max(a, b);
  }
  return kNotBounded;
}

/// rho of condition (a) for one cell and all its targets; infinite when it could not be bounded.
template <int Variables>
double residual(const InvariantTube& tube, const CurveCell& cell) {
  using Model = OverCell<Variables, Variables == 1 ? 5 : 4>;
  const Model phase = Model::variable(cell.phase, 0);
  const Model omega = frequency_of<Model, Variables>(tube);
  const Model next_phase = phase + omega;
  const RotatingFrameState<Model> image = trackers::single_channel_map<Model>(
      tube.curve.at(phase, omega), {next_phase, Model(0.0), Model(0.0), omega}, lifted<Model>(tube.design));
  const RotatingFrameState<Model> expected = tube.curve.at(next_phase, omega);
  IntervalVector<9> difference;
  for (Eigen::Index i = 0; i < 9; ++i) {
    difference(i) = (image(i) - expected(i)).range();
  }
  double largest = 0.0;
  for (const std::size_t j : cell.targets) {
    largest = larger(largest, length(tube.cells[j].inverse * difference));
  }
  return largest;
}

/// kappa of condition (b) for one cell and all its targets, over the tube of that radius; infinite when it
/// could not be bounded.
template <int Variables>
double contraction(const InvariantTube& tube, const CurveCell& cell, double tube_radius) {
  using Model = OverCell<Variables, Variables == 1 ? 3 : 2>;
  using Dual = rigor::Dual<Model, 9>;
  const Model phase = Model::variable(cell.phase, 0);
  const Model omega = frequency_of<Model, Variables>(tube);
  RotatingFrameState<Model> state = tube.curve.at(phase, omega);
  for (Eigen::Index i = 0; i < 9; ++i) {
    const Interval reach = Interval(tube_radius) * Interval(cell.reach[static_cast<std::size_t>(i)]);
    state(i) = state(i).widened(reach.upper());
  }
  const auto map = [&](const auto& x) {
    return trackers::single_channel_map<Dual>(x, {Dual(phase + omega), Dual(0.0), Dual(0.0), Dual(omega)},
                                              lifted<Dual>(tube.design));
  };
  const auto jacobian = rigor::linearize(map, state).jacobian;
  // lazyProduct: Eigen's other products compare scalars, which models cannot be.
  using ModelMatrix = Eigen::Matrix<Model, 9, 9>;
  const ModelMatrix matrix = cell.matrix.unaryExpr([](double x) { return Model(x); });
  const ModelMatrix columns = jacobian.lazyProduct(matrix);
  double largest = 0.0;
  for (const std::size_t j : cell.targets) {
    const ModelMatrix inverse = tube.cells[j].inverse.unaryExpr([](const Interval& x) { return Model(x); });
    const ModelMatrix product = inverse.lazyProduct(columns);
    const IntervalMatrix<9> ranges = product.unaryExpr([](const Model& x) { return x.range(); });
    largest = larger(largest, rigor::norm_upper_bound(ranges).value_or(kNotBounded));
  }
  return largest;
}

/// The largest of value(cell) over all cells.
template <typename Value>
double largest_over_cells(const InvariantTube& tube, const Value& value) {
  std::vector<double> values(tube.cells.size(), kNotBounded);
  for_each_cell(tube, [&](std::size_t i) { values[i] = value(tube.cells[i]); });
  double largest = 0.0;
  for (const double one : values) {
    largest = larger(largest, one);
  }
  return largest;
}

/// Conditions (a) to (c).
template <int Variables>
TubeVerification verify(const InvariantTube& tube) {
  const auto failed = [](TubeAttempt attempt, const char* reason) {
    return TubeVerification{attempt, reason, 1.0, 0.0};
  };
  const double rho =
      largest_over_cells(tube, [&](const CurveCell& cell) { return residual<Variables>(tube, cell); });
  if (!std::isfinite(rho)) {
    return failed(TubeAttempt::wants_smaller_cells,
                  "the proposed curve could not be shown to be nearly invariant");
  }
  // Any radius that (c) allows is valid; twice the distance that follows from a rate leaves a margin. The
  // expected rate is that of vanishing cells; the second round has seen these.
  double seen_rate = tube.expected_rate;
  for (int round = 0; round < 2; ++round) {
    const double tube_radius = 2.0 * rho / (1.0 - seen_rate);
    const double kappa = largest_over_cells(
        tube, [&](const CurveCell& cell) { return contraction<Variables>(tube, cell, tube_radius); });
    const Interval rate(kappa);
    const Interval radius(tube_radius);
    // cannot bind (rate): with a rate of 1 or more no radius covers the rest and the distance is not finite.
    if (!rigor::certainly_less(rate, Interval(1.0))) {
      constexpr double kBeyondHope =
          100.0;  // the rest is due to the width of the cells only when it is small
      return failed(kappa < kBeyondHope ? TubeAttempt::wants_smaller_cells : TubeAttempt::hopeless,
                    "the map could not be shown to contract along the steady state");
    }
    const Interval distance = Interval(rho) / (Interval(1.0) - rate);
    if (rigor::certainly_less_equal(rate * radius + Interval(rho), radius) && rigor::is_finite(distance)) {
      return {TubeAttempt::succeeded, {}, kappa, distance.upper()};
    }
    seen_rate = kappa;
  }
  return failed(TubeAttempt::wants_smaller_cells,
                "the tube about the proposed curve is not mapped into itself");
}

}  // namespace

TubeVerification verify_tube(const InvariantTube& tube) {
  const rigor::UpwardRounding upward;
  return tube.curve.terms.size() > 1 ? verify<2>(tube) : verify<1>(tube);
}

}  // namespace veritrack::single_channel
