// Verified fixed points of a closed loop X+ = G(X; p, d) with state X, one real parameter p, disturbance d.
//
// A closed loop here is any class with the numbers of its coordinates and the map over any scalar:
//     static constexpr int kStates, kNoises;   // the disturbance is (noise in R^kNoises, slew of p)
//     template <typename Scalar> Eigen::Matrix<Scalar, kStates, 1> operator()(
//         const Eigen::Matrix<Scalar, kStates, 1>& state, const Scalar& parameter,
//         const Eigen::Matrix<Scalar, kNoises + 1, 1>& disturbance) const;
// X*(p) is a fixed point of the undisturbed loop, d = 0.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::sets {

/// A column over any scalar.
template <typename Scalar, int Size>
using Column = Eigen::Matrix<Scalar, Size, 1>;

/// G, its Jacobian in the state and its derivative in the parameter.
template <typename Scalar, int N>
struct LoopLinearization {
  Column<Scalar, N> value;
  Eigen::Matrix<Scalar, N, N> jacobian;
  Column<Scalar, N> parameter_slope;
};

/// G(X; p, 0) linearized at a state (a point, or a box) and a parameter; exact up to rounding over double, an
/// enclosure over intervals (upward mode held by the caller).
template <typename Loop, typename Scalar>
[[nodiscard]] auto linearize_loop(const Loop& loop, const Column<Scalar, Loop::kStates>& state,
                                  const Scalar& parameter) {
  constexpr int kSize = Loop::kStates;
  using Variable = rigor::Dual<Scalar, kSize + 1>;
  Column<Variable, kSize> x;
  for (int i = 0; i < kSize; ++i) {
    x[i] = rigor::variable<kSize + 1>(state[i], i);
  }
  const Column<Variable, Loop::kNoises + 1> quiet =
      Column<Variable, Loop::kNoises + 1>::Constant(Variable(0.0));
  const Column<Variable, kSize> image = loop(x, rigor::variable<kSize + 1>(parameter, kSize), quiet);
  LoopLinearization<Scalar, kSize> result;
  for (int i = 0; i < kSize; ++i) {
    result.value[i] = image[i].value();
    for (int j = 0; j < kSize; ++j) {
      result.jacobian(i, j) = image[i].derivative(j);
    }
    result.parameter_slope[i] = image[i].derivative(kSize);
  }
  return result;
}

/// A fixed point and its slope dX*/dp, found in floating point: a proposal, no evidence.
template <int N>
struct FixedPointProposal {
  rigor::Vector<N> state;
  rigor::Vector<N> slope;
};

/// Newton's method in double from `start`; nothing when it does not settle.
template <typename Loop>
[[nodiscard]] std::optional<FixedPointProposal<Loop::kStates>> propose_fixed_point(
    const Loop& loop, const rigor::Vector<Loop::kStates>& start, double parameter) {
  constexpr int kSize = Loop::kStates;
  constexpr int kSteps = 60;
  const rigor::NearestRounding nearest;
  rigor::Vector<kSize> state = start;
  for (int i = 0; i < kSteps && state.allFinite(); ++i) {
    const auto local = linearize_loop<Loop, double>(loop, state, parameter);
    const rigor::Matrix<kSize> system = rigor::Matrix<kSize>::Identity() - local.jacobian;
    const Eigen::PartialPivLU<rigor::Matrix<kSize>> factors(system);
    const rigor::Vector<kSize> step = factors.solve(local.value - state);
    state += step;
    const bool settled = step.norm() <= 1e-14 * (1.0 + state.norm());
    if (settled && state.allFinite()) {
      const rigor::Vector<kSize> slope = factors.solve(local.parameter_slope);
      return slope.allFinite() ? std::optional(FixedPointProposal<kSize>{state, slope}) : std::nullopt;
    }
  }
  return std::nullopt;
}

/// A verified fixed point for every parameter p of an interval: exactly one in the box
/// center + (p - parameter_center) slope + uniqueness, and it lies in the same box with `tight` in the place
/// of `uniqueness`. As a function of p it is continuously differentiable.
template <int N>
struct FixedPointFamily {
  rigor::Interval parameter;
  double parameter_center = 0.0;
  rigor::Vector<N> center;
  rigor::Vector<N> slope;
  rigor::IntervalVector<N> uniqueness;
  rigor::IntervalVector<N> tight;

  /// An enclosure of {X*(p) : p in `part`}, for a part of `parameter`. Needs the upward mode.
  [[nodiscard]] rigor::IntervalVector<N> at(const rigor::Interval& part) const {
    const rigor::Interval offset = part - rigor::Interval(parameter_center);
    return rigor::to_interval(center) + rigor::to_interval(slope) * offset + tight;
  }
  /// All of {X*(p)}. Needs the upward mode.
  [[nodiscard]] rigor::IntervalVector<N> box() const { return at(parameter); }
};

namespace detail {

/// A little more than x on every side, with 0 inside.
template <int N>
[[nodiscard]] rigor::IntervalVector<N> inflate(const rigor::IntervalVector<N>& x) {
  const rigor::Interval margin = rigor::symmetric(0x1p-70);
  const rigor::Interval factor = rigor::Interval::from_bounds(-0.1, 1.2);
  return x.unaryExpr([&](const rigor::Interval& entry) { return entry * factor + margin; });
}

/// Krawczyk's operator for e -> G(X(p) + e; p) - X(p) - e, X(p) = center + (p - p0) slope, at all p of an
/// interval.
template <typename Loop>
class KrawczykOperator {
 public:
  static constexpr int kSize = Loop::kStates;
  using Box = rigor::IntervalVector<kSize>;

  KrawczykOperator(const Loop& loop, const FixedPointProposal<kSize>& proposal,
                   const rigor::Interval& parameter)
      : loop_(loop), parameter_(parameter), offset_(parameter - rigor::Interval(midpoint(parameter))) {
    center_ = rigor::to_interval(proposal.state);
    slope_ = rigor::to_interval(proposal.slope);
    const rigor::Matrix<kSize> identity = rigor::Matrix<kSize>::Identity();
    {
      const rigor::NearestRounding nearest;
      const auto local = linearize_loop<Loop, double>(loop, proposal.state, midpoint(parameter));
      inverse_ = (local.jacobian - identity).inverse();
    }
    newton_step_ = -(rigor::to_interval(inverse_) * residual()).eval();
  }

  [[nodiscard]] bool usable() const { return inverse_.allFinite() && is_finite(newton_step_); }
  /// -C F(0, p), all p.
  [[nodiscard]] const Box& newton_step() const { return newton_step_; }

  /// K(E) = -C F(0, p) + (I - C F'(E, p)) E, all p. If K(E) lies in the interior of E then for every p there
  /// is exactly one zero in E, and it lies in K(E). Existence: e -> e - C F(e) maps E into K(E) (mean value
  /// theorem), so it has a fixed point (Brouwer). With A any mean of Jacobians over E, |I - C A| rad E <=
  /// rad K(E) < rad E entry by entry, so the spectral radius of I - C A is below 1 and C and A are
  /// nonsingular: the fixed point is a zero, and two zeros e, e' would have 0 = F(e) - F(e') = A (e - e').
  [[nodiscard]] Box operator()(const Box& error) const {
    const Box state = center_ + slope_ * offset_ + error;
    const auto local = linearize_loop<Loop, rigor::Interval>(loop_, state, parameter_);
    const rigor::IntervalMatrix<kSize> identity = rigor::IntervalMatrix<kSize>::Identity();
    const rigor::IntervalMatrix<kSize> contraction =
        identity - rigor::to_interval(inverse_) * (local.jacobian - identity);
    return newton_step_ + contraction * error;
  }

 private:
  /// F(0, p) for all p: at the middle, plus the mean value theorem in p.
  [[nodiscard]] Box residual() const {
    using rigor::Interval;
    const Interval middle(midpoint(parameter_));
    const Column<Interval, Loop::kNoises + 1> quiet =
        Column<Interval, Loop::kNoises + 1>::Constant(Interval(0.0));
    Box at_middle = loop_(Box(center_), middle, quiet) - center_;
    if (parameter_ == middle) {
      return at_middle;
    }
    const auto local = linearize_loop<Loop, Interval>(loop_, Box(center_ + slope_ * offset_), parameter_);
    const Box drift = local.jacobian * slope_ + local.parameter_slope - slope_;
    return at_middle + drift * offset_;
  }

  const Loop& loop_;
  rigor::Interval parameter_;
  rigor::Interval offset_;
  Box center_;
  Box slope_;
  rigor::Matrix<kSize> inverse_;
  Box newton_step_;
};

}  // namespace detail

/// A fixed point near `proposal` (found at the midpoint of `parameter`), verified for every p in `parameter`
/// by Krawczyk's operator; nothing when that fails, in particular when something is not finite. Holds its own
/// rounding mode.
template <typename Loop>
[[nodiscard]] std::optional<FixedPointFamily<Loop::kStates>> verify_fixed_point(
    const Loop& loop, const FixedPointProposal<Loop::kStates>& proposal, const rigor::Interval& parameter) {
  constexpr int kSize = Loop::kStates;
  constexpr int kInflations = 12;
  constexpr int kRefinements = 3;
  const rigor::UpwardRounding upward;
  if (!is_finite(parameter) || !proposal.state.allFinite() || !proposal.slope.allFinite()) {
    return std::nullopt;
  }
  const detail::KrawczykOperator<Loop> krawczyk(loop, proposal, parameter);
  if (!krawczyk.usable()) {
    return std::nullopt;
  }
  rigor::IntervalVector<kSize> image = krawczyk.newton_step();
  for (int i = 0; i < kInflations && is_finite(image); ++i) {
    const rigor::IntervalVector<kSize> candidate = detail::inflate<kSize>(image);
    image = krawczyk(candidate);
    if (!is_finite(image) || !is_interior(image, candidate)) {
      continue;
    }
    rigor::IntervalVector<kSize> tight = image;
    for (int j = 0; j < kRefinements; ++j) {
      tight = intersection(rigor::IntervalVector<kSize>(krawczyk(tight)), tight);
    }
    if (!is_finite(tight)) {
      return std::nullopt;
    }
    return FixedPointFamily<kSize>{parameter,      midpoint(parameter), proposal.state,
                                   proposal.slope, candidate,           tight};
  }
  return std::nullopt;
}

/// The same, from an approximate fixed point that Newton's method improves first.
template <typename Loop>
[[nodiscard]] std::optional<FixedPointFamily<Loop::kStates>> verify_fixed_point(
    const Loop& loop, const rigor::Vector<Loop::kStates>& approximate, const rigor::Interval& parameter) {
  const auto proposal = propose_fixed_point(loop, approximate, midpoint(parameter));
  return proposal ? verify_fixed_point(loop, *proposal, parameter) : std::nullopt;
}

/// True when it is certain that `box`, slightly inflated, holds at most one fixed point at `parameter`, a
/// point, and that it holds one. Holds its own rounding mode.
template <typename Loop>
[[nodiscard]] bool holds_one_fixed_point(const Loop& loop, const rigor::IntervalVector<Loop::kStates>& box,
                                         const rigor::Interval& parameter) {
  constexpr int kSize = Loop::kStates;
  const rigor::UpwardRounding upward;
  if (!is_finite(box) || !is_finite(parameter)) {
    return false;
  }
  const rigor::Vector<kSize> center = midpoint(box);
  const detail::KrawczykOperator<Loop> krawczyk(loop, {center, rigor::Vector<kSize>::Zero()}, parameter);
  if (!krawczyk.usable()) {
    return false;
  }
  const rigor::IntervalVector<kSize> around = box - rigor::to_interval(center);
  rigor::IntervalVector<kSize> candidate = detail::inflate<kSize>(around);
  constexpr int kInflations = 8;
  for (int i = 0; i < kInflations; ++i) {
    const rigor::IntervalVector<kSize> image = krawczyk(candidate);
    if (!is_finite(image)) {
      return false;
    }
    if (is_interior(image, candidate)) {
      return true;
    }
    candidate = detail::inflate<kSize>(hull(candidate, image));
  }
  return false;
}

/// An enclosure of dX*/dp over the family: (I - dG/dX) dX*/dp = dG/dp. Nothing when it could not be verified.
/// Holds its own rounding mode.
template <typename Loop>
[[nodiscard]] std::optional<rigor::IntervalVector<Loop::kStates>> enclose_slope(
    const Loop& loop, const FixedPointFamily<Loop::kStates>& tube) {
  using Matrix = rigor::IntervalMatrix<Loop::kStates>;
  const rigor::UpwardRounding upward;
  const auto local = linearize_loop<Loop, rigor::Interval>(loop, tube.box(), tube.parameter);
  return rigor::solve(Matrix(Matrix::Identity() - local.jacobian), local.parameter_slope);
}

}  // namespace veritrack::sets
