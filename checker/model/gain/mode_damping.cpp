#include "checker/model/gain/mode_damping.hpp"

#include <cmath>
#include <numbers>

namespace veritrack::checker {

namespace {

/// The curve z(w) = exp((-decay + j) w) of the eigenvalues with this damping ratio, 0 <= w <= pi. Together
/// with its mirror image it goes once around 0 and all eigenvalues with more damping.
class DampingCurve {
 public:
  explicit DampingCurve(const Ball& damping)
      : decay_(damping / sqrt(one - square(damping))), speed_(sqrt(one + square(decay_))) {}

  [[nodiscard]] ComplexBall at(const Ball& angle) const { return exponential(-(decay_ * angle), angle); }
  /// How far the curve between two angles is at most from where it is between them.
  [[nodiscard]] Ball reach(const Ball& from, const Ball& to) const {
    return speed_ * exp(-(decay_ * from)) * (to - from) * half;
  }

 private:
  Ball decay_, speed_;
};

/// The angle by which y is further than x, where that is less than half a turn.
Ball angle_between(const ComplexBall& x, const ComplexBall& y) {
  const ComplexBall ratio = y * ComplexBall{x.real, -x.imaginary};
  return value_of_arb(arb_atan2, ratio.imaginary, ratio.real);
}

/// The same with exact coefficients: one polynomial of those in the balls.
std::vector<Ball> middle_of(const std::vector<Ball>& polynomial) {
  std::vector<Ball> middle;
  middle.reserve(polynomial.size());
  for (const Ball& coefficient : polynomial) {
    middle.push_back(coefficient.middle());
  }
  return middle;
}

/// By how much the argument of the polynomial in the middle of the balls changes along the curve, where no
/// polynomial in them is 0 on it.
std::optional<Ball> change_of_argument(const std::vector<Ball>& polynomial, const DampingCurve& curve) {
  constexpr long kMostArcs = 100'000;
  constexpr double kFinest = 0x1p-48;  // of the place
  const std::vector<Ball> middle = middle_of(polynomial);
  double from = 0.0;
  double step = 0.25;
  ComplexBall value = values_in_disc(middle, curve.at(zero), zero).centre;
  Ball change;
  for (long arc = 0; arc < kMostArcs && step > kFinest * from; ++arc) {
    const bool is_last = from + step > std::numbers::pi;
    const Ball start(from);
    const Ball end = is_last ? pi() : Ball(from + step);
    const ValuesInDisc all =
        values_in_disc(polynomial, curve.at((start + end) * half), curve.reach(start, end));
    if (!certainly_less(two * all.spread, length(all.centre))) {
      step *= 0.5;
      continue;
    }
    // Values on the arc are within 30 degrees of the one in its middle.
    const ComplexBall next = values_in_disc(middle, curve.at(end), zero).centre;
    change += angle_between(value, next);
    if (is_last) {
      return change;
    }
    value = next;
    from += step;
    step *= 2.0;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> modes_damped_more_than(const BallRows& matrix, const Ball& damping) {
  if (matrix.empty() || !certainly_positive(damping) || !certainly_less(damping, one)) {
    return std::nullopt;
  }
  const std::optional<Ball> change =
      change_of_argument(characteristic_polynomial(matrix), DampingCurve(damping));
  if (!change || !change->finite()) {
    return std::nullopt;
  }
  // Half a turn for each zero inside: the curve and its mirror image make a whole one.
  const Ball halves = *change / pi();
  const double nearest = std::round(halves.near());
  const bool is_known = nearest >= 0.0 && nearest <= static_cast<double>(matrix.size()) &&
                        certainly_less(abs(halves - Ball(nearest)), Ball(0.25));
  return is_known ? std::optional(static_cast<std::size_t>(nearest)) : std::nullopt;
}

}  // namespace veritrack::checker
